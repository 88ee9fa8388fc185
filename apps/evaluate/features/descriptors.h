// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/pair_registration.h>

#include <map>
#include <string>

namespace pcl_flashreg::evaluate {

/** \brief What keypoints are described by. */
enum class Descriptors {
  /** \brief FPFH of the front end's own. */
  Native,
  /** \brief pcl::FPFHEstimation, as a caller's own descriptors. */
  PclFpfh,
  /** \brief pcl::SHOTEstimation, likewise: 352 values. */
  Shot
};

/** \brief By the names that the command line knows. */
extern const std::map<std::string, Descriptors> DESCRIPTORS;

/** \brief A scan of the same keypoints and normals with descriptors that PCL computes, within
 * five times the spacing.
 * \param[in] descriptors not Native
 */
Scan
describeAnew(const Scan& surface, Descriptors descriptors, PairRegistration& maker);

} // namespace pcl_flashreg::evaluate
