// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>

namespace pcl_flashreg::batch {

/** \brief What the front end makes of a small made cloud, as a hash: two builds with the
 * same fingerprint compute the same features, and one whose voxel grid, normals or
 * descriptors changed has another, with no version number to remember. */
std::string
frontEndFingerprint();

} // namespace pcl_flashreg::batch
