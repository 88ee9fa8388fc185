// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What programs tell people of scans and of registrations, in the same words.

#include <pcl_flashreg/result.h>
#include <pcl_flashreg/scan.h>

#include <string>

namespace pcl_flashreg::program {

/** \brief "(1 2.5 -3)", with as few digits as make the same numbers. */
std::string
vectorText(const Eigen::Vector3d& v);

/** \brief That a stated viewpoint is not believed, and what is used in its place; empty
 * if it is, or if there is no scan. */
std::string
viewpointDoubt(const Scan& scan, const Eigen::Vector3d& stated);

/** \brief That all points lie in one plane; empty if not. */
std::string
flatnessDoubt(const Scan& scan);

/** \brief What a pose lacks that every pose needs; empty if that is not known. */
std::string
wantOf(const Evidence& evidence);

} // namespace pcl_flashreg::program
