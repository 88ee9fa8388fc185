// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/impl/number_text.hpp>

#include <stdexcept>
#include <string>

namespace pcl_flashreg {

/** \throws std::invalid_argument with name, value and range, unless the value fits */
template <typename Value>
void
require(bool fits, const char* name, Value value, const std::string& range)
{
  if (!fits)
    throw std::invalid_argument(std::string(name) + " = " + detail::toText(value) +
                                " is out of range: " + range);
}

} // namespace pcl_flashreg
