// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace pcl_flashreg::align {

/** \brief Six digits at most, whatever the user's language. */
inline std::string
shortNumber(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

} // namespace pcl_flashreg::align
