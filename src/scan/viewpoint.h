// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "scan/cpu/visibility.h"
#include "support/thread_pool.h"

#include <Eigen/Core>

namespace pcl_flashreg {

/** \brief Keypoints that findViewpoint() wants at most. */
constexpr std::size_t VIEWPOINT_ELEMENTS = 2000;

/** \brief Where a cloud was seen from. */
struct FoundViewpoint {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();
  /** \brief Whether it is the place that was stated. */
  bool is_stated = true;
  /** \brief Whether nearly all of the cloud was seen from there. */
  bool sees_all = true;
};

/** \brief Decides by the points whether a sensor stood where it is said to have, and finds a
 * better place where it did not.
 *
 * Files say (0, 0, 0) where nobody said anything; and of points that somebody moved, cut or
 * merged, what their file says no longer holds. A stated place that explains the points
 * nearly as well as the best one found does hold: a hand-held sensor moves while it looks,
 * so that no place explains all that it saw.
 * The same on any number of threads.
 * \param[in] stated in the frame of the elements
 * \param[in] possible whether the stated place is to be considered
 */
FoundViewpoint
findViewpoint(const cpu::Visibility& visibility,
              const Eigen::Vector3f& stated,
              bool possible,
              ThreadPool& pool);

} // namespace pcl_flashreg
