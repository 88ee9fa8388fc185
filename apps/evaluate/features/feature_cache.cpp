// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "feature_cache.h"

#include "../../io/error.h"
#include "../../io/file.h"
#include "front_end.h"
#include "hash.h"

#include <array>
#include <cstring>
#include <filesystem>

namespace pcl_flashreg::evaluate {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t DIMENSION = 33;
constexpr std::array<char, 8> MAGIC = {'f', 'p', 'f', 'h', '3', '3', ' ', '1'};

template <typename Value>
void
append(std::string& bytes, const Value& value)
{
  static_assert(std::is_trivially_copyable_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(Value));
}

/** \brief Takes a value off the front; false if there are not enough bytes. */
template <typename Value>
bool
take(std::string_view& bytes, Value& value)
{
  if (bytes.size() < sizeof(Value))
    return false;
  std::memcpy(&value, bytes.data(), sizeof(Value));
  bytes.remove_prefix(sizeof(Value));
  return true;
}

std::string
pack(const DescribedCloud& cloud)
{
  std::string bytes;
  append(bytes, MAGIC);
  append(bytes, static_cast<std::uint64_t>(cloud.keypoints.points->size()));
  append(bytes, cloud.features_ms);
  for (int axis = 0; axis < 3; ++axis)
    append(bytes, cloud.shift[axis]);
  for (int axis = 0; axis < 3; ++axis)
    append(bytes, cloud.viewpoint[axis]);
  for (std::size_t i = 0; i < cloud.keypoints.points->size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      append(bytes, (*cloud.keypoints.points)[i].data[axis]);
    for (int axis = 0; axis < 3; ++axis)
      append(bytes, (*cloud.keypoints.normals)[i].normal[axis]);
    for (const float value : (*cloud.keypoints.features)[i].histogram)
      append(bytes, value);
  }
  append(bytes, hashOf(bytes));
  return bytes;
}

/** \brief The reverse; nothing if the bytes are not what pack() made. */
std::optional<DescribedCloud>
unpack(std::string_view bytes)
{
  std::uint64_t checksum = 0, size = 0;
  std::array<char, 8> magic{};
  if (bytes.size() < sizeof(checksum))
    return std::nullopt;
  std::string_view end = bytes.substr(bytes.size() - sizeof(checksum));
  bytes.remove_suffix(sizeof(checksum));
  if (!take(end, checksum) || checksum != hashOf(bytes) || !take(bytes, magic) ||
      magic != MAGIC || !take(bytes, size))
    return std::nullopt;

  DescribedCloud cloud;
  cloud.keypoints.points.reset(new pcl::PointCloud<pcl::PointXYZ>);
  cloud.keypoints.normals.reset(new pcl::PointCloud<pcl::Normal>);
  cloud.keypoints.features.reset(new pcl::PointCloud<pcl::FPFHSignature33>);
  bool complete = take(bytes, cloud.features_ms);
  for (int axis = 0; axis < 3; ++axis)
    complete = complete && take(bytes, cloud.shift[axis]);
  for (int axis = 0; axis < 3; ++axis)
    complete = complete && take(bytes, cloud.viewpoint[axis]);
  if (!complete || bytes.size() != size * (3 + 3 + DIMENSION) * sizeof(float))
    return std::nullopt;
  cloud.keypoints.points->resize(size);
  cloud.keypoints.normals->resize(size);
  cloud.keypoints.features->resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      take(bytes, (*cloud.keypoints.points)[i].data[axis]);
    for (int axis = 0; axis < 3; ++axis)
      take(bytes, (*cloud.keypoints.normals)[i].normal[axis]);
    for (float& value : (*cloud.keypoints.features)[i].histogram)
      take(bytes, value);
  }
  return cloud;
}

} // namespace

FeatureCache::FeatureCache(std::string folder, double leaf) : folder_(std::move(folder))
{
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!fs::is_directory(folder_))
    throw io::InputError(folder_ + ": cannot be made: " + error.message());
  std::string settings = frontEndFingerprint();
  append(settings, leaf);
  settings_ = toHex(hashOf(settings));
}

std::string
FeatureCache::keyOf(const std::string& cloud_path) const
{
  return toHex(hashOf(io::readFile(cloud_path))) + "-" + settings_ + ".fpfh";
}

std::optional<DescribedCloud>
FeatureCache::load(const std::string& key) const
{
  const std::string path = folder_ + "/" + key;
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) == 0)
    return std::nullopt;
  return unpack(io::readFile(path));
}

void
FeatureCache::save(const std::string& key, const DescribedCloud& cloud) const
{
  io::writeFile(folder_ + "/" + key, pack(cloud));
}

} // namespace pcl_flashreg::evaluate
