// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/pair_registration.h>

#include <string>

namespace pcl_flashreg::evaluate {

/** \brief Reads six columns, or two files of three where the path holds "{src,dst}".
 * \throws io::InputError with the file, and the line where there is one
 */
Correspondences
readCorrespondences(const std::string& path);

} // namespace pcl_flashreg::evaluate
