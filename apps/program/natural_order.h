// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string_view>

namespace pcl_flashreg::program {

/** \brief Whether a name comes before another where numbers in it count as numbers: scan_2
 * before scan_10. Names that differ in leading zeros alone are told apart, too. */
bool
naturallyBefore(std::string_view a, std::string_view b);

} // namespace pcl_flashreg::program
