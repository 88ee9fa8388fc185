// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace pcl_flashreg::io {

/** \brief A file, or the bytes of one, are not what was expected. The message is one
 * line that says what is wrong; readers of files put the path in front of it. */
class InputError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief The error that a line of a text is, from 1. */
inline InputError
errorAtLine(std::size_t line, const std::string& message)
{
  return InputError("line " + std::to_string(line) + ": " + message);
}

} // namespace pcl_flashreg::io
