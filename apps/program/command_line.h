// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "program.h"

#include <CLI/CLI.hpp>

#include <string>

namespace pcl_flashreg::program {

/** \brief Takes the options over into what they were declared for.
 * \return whether there is anything left to do: help or the version was asked for, and
 * printed, if not
 * \throws UsageError with one line that says what is wrong
 */
inline bool
parse(CLI::App& app, int argc, const char* const* argv)
{
  try {
    app.parse(argc, argv);
    return true;
  }
  catch (const CLI::Success& request) {
    app.exit(request);
    return false;
  }
  catch (const CLI::ParseError& error) {
    throw UsageError(error.what() + std::string(" (--help lists the options)"));
  }
}

} // namespace pcl_flashreg::program
