// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "ply.h"

#include <array>
#include <cstring>
#include <utility>

namespace pcl_flashreg::io {
namespace {

constexpr std::array<std::pair<const char*, const char*>, 3> kNormals = {
    {{"nx", "normal_x"}, {"ny", "normal_y"}, {"nz", "normal_z"}}};

// PCL packs a colour into four bytes 0xAARRGGBB: blue lies first in memory.
constexpr std::array<const char*, 4> kChannels = {"blue", "green", "red", "alpha"};
constexpr std::array<const char*, 4> kPlyOrder = {"red", "green", "blue", "alpha"};

bool
isByte(const Cloud& cloud, const char* name)
{
  const Field* field = cloud.find(name);
  return field != nullptr && field->type == ScalarType::Uint8 && field->count == 1;
}

bool
isChannel(const std::string& name, std::size_t channels)
{
  for (std::size_t c = 0; c < channels; ++c)
    if (name == kChannels[c])
      return true;
  return false;
}

void
renameNormals(Cloud& cloud, bool to_pcl)
{
  for (const auto& [ply, pcl] : kNormals) {
    const char* from = to_pcl ? ply : pcl;
    const char* to = to_pcl ? pcl : ply;
    if (cloud.find(to) == nullptr)
      for (Field& field : cloud.fields)
        if (field.name == from)
          field.name = to;
  }
}

} // namespace

Cloud
toPclFields(Cloud cloud)
{
  renameNormals(cloud, true);
  if (!isByte(cloud, "red") || !isByte(cloud, "green") || !isByte(cloud, "blue"))
    return cloud;
  const bool alpha = isByte(cloud, "alpha");
  const char* const packed_name = alpha ? "rgba" : "rgb";
  if (cloud.find(packed_name) != nullptr)
    return cloud;
  std::vector<Field> fields;
  for (const Field& field : cloud.fields) {
    if (field.name == "red")
      fields.push_back(
          {packed_name, alpha ? ScalarType::Uint32 : ScalarType::Float32, 1, 0});
    else if (!isChannel(field.name, alpha ? 4 : 3))
      fields.push_back(field);
  }
  Cloud packed = withFields(cloud, fields);
  const Field& to = *packed.find(packed_name);
  for (std::size_t c = 0; c < (alpha ? 4u : 3u); ++c) {
    const Field& from = *cloud.find(kChannels[c]);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      packed.point(i)[to.offset + c] = cloud.point(i)[from.offset];
  }
  return packed;
}

Cloud
toPlyFields(Cloud cloud)
{
  renameNormals(cloud, false);
  const bool alpha = cloud.find("rgba") != nullptr;
  const Field* packed = cloud.find(alpha ? "rgba" : "rgb");
  if (packed == nullptr || packed->byteSize() != 4 || packed->count != 1 ||
      cloud.find("red") || cloud.find("green") || cloud.find("blue") ||
      cloud.find("alpha"))
    return cloud;
  const std::size_t channels = alpha ? 4 : 3;
  std::vector<Field> fields;
  for (const Field& field : cloud.fields) {
    if (field.name != packed->name)
      fields.push_back(field);
    else
      for (std::size_t c = 0; c < channels; ++c)
        fields.push_back({kPlyOrder[c], ScalarType::Uint8, 1, 0});
  }
  Cloud split = withFields(cloud, fields);
  for (std::size_t c = 0; c < channels; ++c) {
    const Field& to = *split.find(kChannels[c]);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      split.point(i)[to.offset] = cloud.point(i)[packed->offset + c];
  }
  return split;
}

} // namespace pcl_flashreg::io
