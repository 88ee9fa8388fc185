// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "parts.h"

#include "../../io/error.h"

#include <filesystem>
#include <set>

namespace pcl_flashreg::evaluate {
namespace {

namespace fs = std::filesystem;

/** \brief All parts that lie beside a file of results, of any number of ranks. */
std::vector<std::string>
partsOf(const std::string& csv)
{
  std::vector<std::string> parts;
  const fs::path path = fs::absolute(csv);
  const std::string prefix = path.filename().string() + ".rank";
  if (!fs::is_directory(path.parent_path()))
    return parts; // writing the file will say so
  for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path())) {
    const std::string name = entry.path().filename().string();
    const bool is_part =
        name.rfind(prefix, 0) == 0 && name.size() > prefix.size() &&
        name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
    if (is_part)
      parts.push_back(entry.path().string());
  }
  return parts;
}

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

std::string
partPath(const std::string& csv, std::size_t rank)
{
  return csv + ".rank" + std::to_string(rank);
}

Results
readWithParts(const std::string& csv, const Config& config)
{
  std::vector<std::string> files = partsOf(csv);
  if (fs::exists(csv))
    files.push_back(csv);
  Results all{config, {}};
  std::set<std::size_t> pairs;
  for (const std::string& file : files) {
    const Results some = readResults(file);
    const std::string changed = difference(some.config, config);
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
  for (const std::string& part : partsOf(csv)) {
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
    const std::string changed = difference(all.config, some.config);
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
