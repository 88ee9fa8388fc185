// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "parts.h"

#include "../../batch/parts.h"
#include "../../io/error.h"

#include <filesystem>
#include <set>

namespace pcl_flashreg::evaluate {
namespace {

namespace fs = std::filesystem;

/** \brief Adds the records of pairs that are not there yet. */
void
add(const Results& from, std::set<std::size_t>& pairs, Results& to)
{
  std::set<std::size_t> added;
  for (const Record& record : from.records)
    if (pairs.count(record.pair) == 0) {
      to.records.push_back(record);
      added.insert(record.pair);
    }
  pairs.insert(added.begin(), added.end());
}

} // namespace

Results
readWithParts(const std::string& csv, const Config& config)
{
  std::vector<std::string> files = batch::partsOf(csv, RANK);
  if (fs::exists(csv))
    files.push_back(csv);
  Results all{config, {}};
  std::set<std::size_t> pairs;
  for (const std::string& file : files) {
    const Results some = readResults(file);
    const std::string changed = batch::difference(some.config, config);
    if (!changed.empty())
      throw io::InputError(file + ": was made with other settings: " + changed);
    add(some, pairs, all);
  }
  sortRecords(config, all.records);
  return all;
}

void
removeParts(const std::string& csv)
{
  for (const std::string& part : batch::partsOf(csv, RANK)) {
    fs::remove(timesPath(part));
    fs::remove(part);
  }
}

Results
mergeShards(const std::vector<std::string>& files)
{
  Results all;
  std::set<std::size_t> pairs;
  for (const std::string& file : files) {
    Results some = readResults(file);
    some.config.erase("shard");
    if (&file == &files.front())
      all.config = some.config;
    const std::string changed = batch::difference(all.config, some.config);
    if (!changed.empty())
      throw io::InputError(file + ": was made with other settings than " +
                           files.front() + ": " + changed);
    const std::size_t before = all.records.size();
    add(some, pairs, all);
    if (all.records.size() != before + some.records.size())
      throw io::InputError(file + ": has pairs that another file has, too");
  }
  const auto total = all.config["pairs"].get<std::size_t>();
  for (std::size_t pair = 0; pair < total; ++pair)
    if (pairs.count(pair) == 0)
      throw io::InputError(std::to_string(total - pairs.size()) + " of " +
                           std::to_string(total) +
                           " pairs are in no file, first pair " + std::to_string(pair) +
                           ": finish the shards with --resume");
  sortRecords(all.config, all.records);
  return all;
}

} // namespace pcl_flashreg::evaluate
