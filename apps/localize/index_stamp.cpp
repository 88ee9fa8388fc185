// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "index_stamp.h"

#include "../batch/front_end.h"
#include "../io/file.h"
#include "../io/hash.h"
#include "../program/json.h"

#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;

namespace pcl_flashreg::localize {
namespace {

using program::Json;

std::string
absolute(const std::string& path)
{
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(path), error).string();
}

std::string
checksumOf(const std::string& path)
{
  return io::toHex(io::hashOf(io::readFile(path)));
}

std::string
beginningOf(const std::string& index)
{
  std::string bytes(4096, '\0');
  std::ifstream file(index, std::ios::binary);
  file.read(&bytes[0], static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return io::toHex(io::hashOf(bytes));
}

std::int64_t
timeOf(const std::string& path)
{
  return static_cast<std::int64_t>(
      fs::last_write_time(path).time_since_epoch().count());
}

} // namespace

std::string
stampPathOf(const std::string& index)
{
  return index + ".json";
}

IndexStamp
stampOf(const std::string& map,
        const std::string& index,
        double leaf,
        std::size_t bin_fields)
{
  return {absolute(map),
          fs::file_size(map),
          timeOf(map),
          checksumOf(map),
          leaf,
          bin_fields,
          batch::frontEndFingerprint(),
          beginningOf(index)};
}

void
writeStamp(const IndexStamp& stamp, const std::string& index)
{
  const Json json = {{"map", stamp.map},
                     {"bytes", stamp.size},
                     {"modified", stamp.modified},
                     {"checksum", stamp.checksum},
                     {"leaf", stamp.leaf},
                     {"bin_fields", stamp.bin_fields},
                     {"front_end", stamp.front_end},
                     {"index", stamp.index}};
  io::writeFile(stampPathOf(index), program::textOf(json));
}

std::optional<IndexStamp>
readStamp(const std::string& index)
{
  try {
    const Json json = Json::parse(io::readFile(stampPathOf(index)));
    const IndexStamp stamp = {json.at("map"),
                              json.at("bytes"),
                              json.at("modified"),
                              json.at("checksum"),
                              json.at("leaf"),
                              json.at("bin_fields"),
                              json.at("front_end"),
                              json.at("index")};
    if (stamp.index == beginningOf(index))
      return stamp;
  }
  catch (const io::InputError&) {
  }
  catch (const Json::exception&) {
  }
  return std::nullopt;
}

bool
isOf(const IndexStamp& stamp, const std::string& map, std::size_t bin_fields)
{
  if (stamp.bin_fields != bin_fields || stamp.size != fs::file_size(map))
    return false;
  return (stamp.map == absolute(map) && stamp.modified == timeOf(map)) ||
         stamp.checksum == checksumOf(map);
}

} // namespace pcl_flashreg::localize
