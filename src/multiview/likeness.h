// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/thread_pool.h"

#include <pcl_flashreg/multiview_registration.h>

#include <Eigen/Core>

namespace pcl_flashreg {

/** \brief How much scans are alike by their descriptors, whatever their poses: what pairs are
 * tried first.
 *
 * A scan is described by how its descriptors lie about a few centres that are common to all
 * scans (VLAD: Jegou, Douze, Schmid and Perez, Aggregating local descriptors into a compact
 * image representation, CVPR 2010; with normalized parts after Arandjelovic and Zisserman,
 * All about VLAD, CVPR 2013); two are as alike as these point the same way. */
class Likeness {
public:
  /** \brief Asks for every scan twice, so that no two need be in memory. Scans without
   * descriptors are like none. */
  Likeness(std::size_t count,
           const MultiviewRegistration::ScanSource& scans,
           ThreadPool& pool);

  /** \brief From -1 to 1. */
  float
  operator()(std::size_t a, std::size_t b) const
  {
    return signatures_.col(static_cast<Eigen::Index>(a))
        .dot(signatures_.col(static_cast<Eigen::Index>(b)));
  }

  /** \brief The other scans, those first that are most alike. */
  std::vector<std::size_t>
  ranked(std::size_t scan) const;

private:
  /** \brief A column a scan, of length 1. */
  Eigen::MatrixXf signatures_;
};

} // namespace pcl_flashreg
