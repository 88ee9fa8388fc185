// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "feature_cache.h"

#include "../../io/error.h"
#include "../../io/file.h"
#include "../../batch/front_end.h"
#include "../../io/hash.h"

#include <cstring>
#include <filesystem>

namespace pcl_flashreg::evaluate {
namespace {

namespace fs = std::filesystem;

/** \brief The time that it took, then the scan. */
std::string
pack(const StoredScan& stored)
{
  std::string bytes(sizeof(stored.features_ms), '\0');
  std::memcpy(bytes.data(), &stored.features_ms, sizeof(stored.features_ms));
  return bytes + stored.scan.serialize();
}

/** \brief The reverse; nothing if the bytes are not what pack() made. */
std::optional<StoredScan>
unpack(std::string_view bytes)
{
  StoredScan stored;
  if (bytes.size() < sizeof(stored.features_ms))
    return std::nullopt;
  std::memcpy(&stored.features_ms, bytes.data(), sizeof(stored.features_ms));
  bytes.remove_prefix(sizeof(stored.features_ms));
  try {
    stored.scan = Scan::deserialize(bytes);
  }
  catch (const ScanFileError&) {
    return std::nullopt;
  }
  return stored;
}

} // namespace

FeatureCache::FeatureCache(std::string folder,
                           double leaf,
                           Descriptors descriptors,
                           std::size_t bin_fields)
    : folder_(std::move(folder)), bin_fields_(bin_fields)
{
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!fs::is_directory(folder_))
    throw io::InputError(folder_ + ": cannot be made: " + error.message());
  std::string settings = batch::frontEndFingerprint();
  settings.append(reinterpret_cast<const char*>(&leaf), sizeof(leaf));
  settings.push_back(static_cast<char>(descriptors));
  settings_ = io::toHex(io::hashOf(settings));
}

std::string
FeatureCache::keyOf(const std::string& cloud_path, ScanContent content) const
{
  const char* kind = content == ScanContent::Surface ? ".surface" : ".fpfh";
  const bool raw = io::extensionOf(cloud_path) == ".bin";
  return io::toHex(io::hashOf(io::readFile(cloud_path))) + "-" + settings_ +
         (raw ? "-" + std::to_string(bin_fields_) : "") + kind;
}

std::optional<StoredScan>
FeatureCache::load(const std::string& key) const
{
  const std::string path = folder_ + "/" + key;
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) == 0)
    return std::nullopt;
  return unpack(io::readFile(path));
}

void
FeatureCache::save(const std::string& key, const StoredScan& scan) const
{
  io::writeFile(folder_ + "/" + key, pack(scan));
}

} // namespace pcl_flashreg::evaluate
