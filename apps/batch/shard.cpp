// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "shard.h"

#include "../io/text.h"
#include "../program/program.h"

namespace pcl_flashreg::batch {

Shard
parseShard(const std::string& text)
{
  const std::size_t slash = text.find('/');
  Shard shard;
  if (slash == std::string::npos ||
      !io::parseUnsigned(text.substr(0, slash), shard.index) ||
      !io::parseUnsigned(text.substr(slash + 1), shard.count) || shard.index < 1 ||
      shard.index > shard.count)
    throw program::UsageError("--shard: expected i/n with i from 1 to n, found '" +
                              text + "'");
  return shard;
}

} // namespace pcl_flashreg::batch
