// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <sstream>
#include <string>

namespace pcl_flashreg::program {

/** \brief Breaks a help text into lines that fit beside the names of the options. */
inline std::string
wrapped(const std::string& text)
{
  constexpr std::size_t width = 58;
  std::string result;
  std::size_t line = 0;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (line > 0 && line + 1 + word.size() > width) {
      result += '\n';
      line = 0;
    }
    else if (line > 0) {
      result += ' ';
      ++line;
    }
    result += word;
    line += word.size();
  }
  return result;
}

} // namespace pcl_flashreg::program
