// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "error.h"

#include <string>

namespace pcl_flashreg::io {

/** \brief The bytes of a file or a pipe.
 * \throws InputError if it is missing, a directory, a device, unreadable or empty
 */
std::string
readFile(const std::string& path);

/** \brief Puts bytes into a file so that a failure leaves what was there before.
 *
 * They go to a temporary name beside it, which is then renamed. Devices and pipes are
 * written to directly.
 * \throws InputError if that fails
 */
void
writeFile(const std::string& path, const std::string& bytes);

/** \brief Runs a parser of bytes on a file and puts its path in front of an InputError.
 */
template <typename Parser>
auto
parseFile(const std::string& path, Parser&& parser)
{
  const std::string bytes = readFile(path);
  try {
    return parser(bytes);
  }
  catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

/** \brief Lower-case extension with its dot, e.g. ".pcd"; empty if there is none. */
std::string
extensionOf(const std::string& path);

} // namespace pcl_flashreg::io
