// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pairs_file.h"

#include "../batch/front_end.h"
#include "../io/file.h"
#include "relation_row.h"

#include <pcl_flashreg/estimator.h>

#include <algorithm>
#include <map>
#include <optional>

namespace pcl_flashreg::map {
namespace {

using batch::Config;

/** \brief Settings that readers of a file need. */
bool
isConfig(const Config& config)
{
  const auto is_scan = [](const Config& scan) {
    return scan.is_array() && scan.size() == 2 && scan[0].is_string() &&
           scan[1].is_string();
  };
  return config.is_object() && config.contains("leaf") && config["leaf"].is_number() &&
         config.contains("scans") && config["scans"].is_array() &&
         std::all_of(config["scans"].begin(), config["scans"].end(), is_scan);
}

Config
parseConfig(std::string_view line)
{
  const auto config =
      Config::parse(line.substr(std::min<std::size_t>(2, line.size())), nullptr, false);
  if (line.substr(0, 2) != "# " || !isConfig(config))
    throw io::InputError("line 1: is not the configuration of a map's pairs");
  return config;
}

PairsFile
parsePairs(const std::string& bytes)
{
  PairsFile pairs;
  io::LineReader lines(batch::wholeLines(bytes));
  std::string_view line;
  lines.next(line);
  pairs.config = parseConfig(line);
  const std::size_t scans = pairs.config["scans"].size();
  batch::readRows(lines, relationColumns(), [&](const batch::Cells& cells) {
    pairs.relations.push_back(relationFromCells(cells));
    const ScanRelation& relation = pairs.relations.back();
    if (relation.target == relation.source ||
        std::max(relation.target, relation.source) >= scans)
      throw io::InputError("is no pair of " + std::to_string(scans) + " scans");
  });
  return pairs;
}

/** \brief The scan of a configuration that has that content, or name. */
std::optional<std::size_t>
find(const Config& scans, std::size_t by, const Config& value)
{
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (scans[i][by] == value)
      return i;
  return std::nullopt;
}

constexpr std::size_t NAME = 0, CHECKSUM = 1;

std::string
differenceOfScans(const Config& before, const Config& now, bool growing)
{
  for (const Config& scan : before)
    if (!find(now, CHECKSUM, scan[CHECKSUM]))
      return scan[NAME].get<std::string>() + (find(now, NAME, scan[NAME])
                                                  ? " has changed since"
                                                  : " is not among the scans now");
  for (const Config& scan : now)
    if (!growing && !find(before, CHECKSUM, scan[CHECKSUM]))
      return scan[NAME].get<std::string>() + " is new (--add takes new scans in)";
  return "";
}

void
checkSame(const std::string& path,
          const Config& before,
          const Config& now,
          bool growing)
{
  Config settings_before = before, settings_now = now;
  settings_before.erase("scans");
  settings_now.erase("scans");
  const std::string settings = batch::difference(settings_before, settings_now);
  if (!settings.empty())
    throw io::InputError(path + ": was made with other settings: " + settings);
  const std::string scans = differenceOfScans(before["scans"], now["scans"], growing);
  if (!scans.empty())
    throw io::InputError(path + ": was made of other scans: " + scans);
}

} // namespace

Config
pairsConfig(const Options& options, const ScanSet& scans)
{
  Config config;
  config["program"] = std::string("pcl_flashreg_map ") + version();
  config["leaf"] = scans.resolution;
  config["viewpoints"] = options.viewpoint_known;
  if (options.bin_fields != 0)
    config["bin_fields"] = options.bin_fields;
  if (options.motion.motion == MotionModel::Upright)
    config["upright"] = {{"gravity", options.motion.source_gravity},
                         {"max_tilt", options.motion.max_tilt}};
  config["front_end"] = batch::frontEndFingerprint();
  config["scans"] = Config::array();
  for (std::size_t i = 0; i < scans.files.size(); ++i)
    config["scans"].push_back({scans.files[i].name, scans.checksums[i]});
  return config;
}

PairsFile
readPairs(const std::string& path)
{
  return io::parseFile(path, parsePairs);
}

void
writePairs(const std::string& path, const PairsFile& pairs)
{
  // A name need not be valid UTF-8.
  std::string text =
      "# " + pairs.config.dump(-1, ' ', false, Config::error_handler_t::replace) +
      '\n' + io::joinCsv(relationColumns()) + '\n';
  for (const ScanRelation& relation : pairs.relations)
    text += io::joinCsv(relationCells(relation)) + '\n';
  io::writeFile(path, text);
}

std::vector<ScanRelation>
knownRelations(const std::string& path, const Config& now, bool growing)
{
  PairsFile file = readPairs(path);
  checkSame(path, file.config, now, growing);
  std::vector<std::size_t> numbers;
  for (const Config& scan : file.config["scans"])
    numbers.push_back(*find(now["scans"], CHECKSUM, scan[CHECKSUM]));
  for (ScanRelation& relation : file.relations) {
    relation.target = numbers[relation.target];
    relation.source = numbers[relation.source];
  }
  return std::move(file.relations);
}

PairsAppender::PairsAppender(const std::string& path)
    : path_(path), file_(path, std::ios::app)
{
  if (!file_)
    throw io::InputError(path + ": cannot be written");
}

void
PairsAppender::append(const ScanRelation& relation)
{
  file_ << io::joinCsv(relationCells(relation)) << '\n';
  file_.flush();
  if (!file_)
    throw io::InputError(path_ + ": cannot be written");
}

} // namespace pcl_flashreg::map
