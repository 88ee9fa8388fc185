// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>

namespace pcl_flashreg::program {

/** \brief Loads a module from beside the program (in the build tree), or from where it is
 * installed, for as long as the program runs.
 * \return its function of that name
 * \throws std::runtime_error if the module is not where the program looks for it */
void*
loadFunction(const std::string& module, const char* function);

} // namespace pcl_flashreg::program
