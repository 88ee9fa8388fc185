// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace pcl_flashreg {

/** \throws std::invalid_argument with name, value and range, unless the value fits */
template <typename Value>
void
require(bool fits, const char* name, Value value, const std::string& range)
{
  if (fits)
    return;
  std::ostringstream message;
  message << name << " = " << value << " is out of range: " << range;
  throw std::invalid_argument(message.str());
}

} // namespace pcl_flashreg
