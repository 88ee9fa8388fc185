// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>
#include <vector>

namespace pcl_flashreg::program {

/** \brief Whether two paths lead to one file, or would if it were there. */
bool
isSameFile(const std::string& a, const std::string& b);

/** \brief Paths to write to must be no input, differ from each other, be no folder, and lie
 * in folders that are there. Empty ones, and "-", are passed over.
 * \throws UsageError if that is not so
 */
void
checkOutputPaths(const std::vector<std::string>& outputs,
                 const std::vector<std::string>& inputs);

} // namespace pcl_flashreg::program
