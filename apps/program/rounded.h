// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <iomanip>
#include <locale>
#include <sstream>
#include <string>

namespace pcl_flashreg::program {

/** \brief A stream whose numbers do not depend on the user's language. */
inline std::ostringstream
plainStream(int decimals)
{
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream << std::fixed << std::setprecision(decimals);
  return stream;
}

/** \brief A number with so many decimals, for people. */
inline std::string
rounded(double value, int decimals)
{
  auto stream = plainStream(decimals);
  stream << value;
  return stream.str();
}

} // namespace pcl_flashreg::program
