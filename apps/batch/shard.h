// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <string>

namespace pcl_flashreg::batch {

/** \brief Part `index` of `count`, from 1. */
struct Shard {
  std::size_t index = 1, count = 1;
};

/** \brief Reads what --shard takes: i/n.
 * \throws program::UsageError if it is not that */
Shard
parseShard(const std::string& text);

} // namespace pcl_flashreg::batch
