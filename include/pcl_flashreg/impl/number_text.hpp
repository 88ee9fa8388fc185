// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace pcl_flashreg {
namespace detail {

/** \brief A number for messages: with a decimal point and nothing between thousands,
 * whatever locale the program has set. std::to_string() does that of integers only. */
template <typename Number>
std::string
toText(Number value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

} // namespace detail
} // namespace pcl_flashreg
