// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "natural_order.h"

#include <algorithm>

namespace pcl_flashreg::program {
namespace {

bool
isDigit(char c)
{
  return c >= '0' && c <= '9';
}

/** \brief Takes the digits, or the one other letter, off the front of a name. */
std::string_view
takePiece(std::string_view& name)
{
  std::size_t size = 1;
  if (isDigit(name[0]))
    while (size < name.size() && isDigit(name[size]))
      ++size;
  const std::string_view piece = name.substr(0, size);
  name.remove_prefix(size);
  return piece;
}

std::string_view
withoutZeros(std::string_view number)
{
  return number.substr(std::min(number.find_first_not_of('0'), number.size()));
}

/** \brief Less than, equal to or greater than 0, as the pieces are. */
int
compare(std::string_view a, std::string_view b)
{
  if (!isDigit(a[0]) || !isDigit(b[0]))
    return a.compare(b);
  a = withoutZeros(a);
  b = withoutZeros(b);
  // Of any number of digits: the longer number is the larger one.
  if (a.size() != b.size())
    return a.size() < b.size() ? -1 : 1;
  return a.compare(b);
}

} // namespace

bool
naturallyBefore(std::string_view a, std::string_view b)
{
  std::string_view rest_a = a, rest_b = b;
  while (!rest_a.empty() && !rest_b.empty()) {
    const int order = compare(takePiece(rest_a), takePiece(rest_b));
    if (order != 0)
      return order < 0;
  }
  if (rest_a.empty() != rest_b.empty())
    return rest_a.empty();
  return a < b;
}

} // namespace pcl_flashreg::program
