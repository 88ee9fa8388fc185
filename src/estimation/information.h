// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/problem.h"

#include <pcl_flashreg/result.h>

#include <vector>

namespace pcl_flashreg {

/** \brief Result::information of a pose, from the rows of the problem that agree with it.
 * \param[in] pose in the centred frames
 * \param[in] target_centre origin of the centred target frame in the target frame
 * \param[in] inlier_distance sets the floor of the residuals' standard deviation, at a
 * thousandth of it: exact data must not yield an infinite certainty
 */
InformationMatrix
informationMatrix(const Problem& problem,
                  const Pose& pose,
                  const std::vector<int>& inliers,
                  const Vec3& target_centre,
                  double inlier_distance);

/** \brief Takes out what is claimed to be known along a motion that is free, in the same
 * frame. */
void
forget(const FreeMotion& motion, InformationMatrix& information);

} // namespace pcl_flashreg
