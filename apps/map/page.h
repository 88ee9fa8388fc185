// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/multiview_registration.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pcl_flashreg::map {

/** \brief What a page is made from. */
struct PageInput {
  /** \brief Of the scans, one each. */
  const std::vector<std::string>& names;
  const MultiviewResult& result;
  /** \brief Pairs of scans that were registered. */
  std::size_t pairs = 0;
  double resolution = 0;
  /** \brief What the user asked for, as typed, an option each. */
  std::vector<std::string> options;
  /** \brief What took how long, in milliseconds; the total last. */
  std::vector<std::pair<std::string, double>> times;
};

/** \brief What was done and how far the outcome can be trusted, on about one page: Markdown
 * that can be read as it is. Lengths are in the unit of the scans, angles in degrees. */
std::string
formatPage(const PageInput& input);

} // namespace pcl_flashreg::map
