// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cloud_io.h"

#include "error.h"
#include "file.h"
#include "pcd.h"
#include "ply.h"
#include "raw_bin.h"

namespace pcl_flashreg::io {
namespace {

constexpr const char* kPositionNames[] = {"x", "y", "z"};
constexpr const char* kNormalNames[] = {"normal_x", "normal_y", "normal_z"};

bool
startsWith(const std::string& bytes, const char* beginning)
{
  return bytes.rfind(beginning, 0) == 0;
}

/** \brief The blank tells a PLY file from a float32 that begins with the same bytes. */
bool
beginsAsPly(const std::string& bytes)
{
  return startsWith(bytes, "ply\n") || startsWith(bytes, "ply\r") ||
         startsWith(bytes, "ply ");
}

Cloud
parseCloud(const std::string& extension,
           const std::string& bytes,
           std::size_t raw_row_length)
{
  if (beginsAsPly(bytes))
    return parsePly(bytes);
  if (startsWith(bytes, "# .PCD") || startsWith(bytes, "VERSION"))
    return parsePcd(bytes);
  if (extension == ".pcd")
    return parsePcd(bytes);
  if (extension == ".ply")
    return parsePly(bytes);
  if (extension == ".bin")
    return parseRawBin(bytes, raw_row_length);
  throw InputError(
      "is not a point cloud that can be read: expected .pcd, .ply or a raw "
      ".bin (KITTI's, nuScenes')");
}

/** \brief Changes the type of the position fields for which choose() says another one.
 */
template <typename Choose>
void
changePositionTypes(Cloud& cloud, Choose&& choose)
{
  std::vector<Field> fields = cloud.fields;
  bool changed = false;
  for (Field& field : fields)
    for (const char* name : kPositionNames)
      if (field.name == name && choose(field.type) != field.type) {
        field.type = choose(field.type);
        changed = true;
      }
  if (changed)
    cloud = withFields(cloud, fields);
}

/** \brief Replaces the three fields, as a vector, of every point; nothing if one of
 * them is missing. */
template <typename Function>
void
mapVectors(Cloud& cloud, const char* const (&names)[3], Function&& function)
{
  const Field* const fields[] = {
      cloud.find(names[0]), cloud.find(names[1]), cloud.find(names[2])};
  if (!fields[0] || !fields[1] || !fields[2])
    return;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::uint8_t* point = cloud.point(i);
    Eigen::Vector3d v;
    for (int axis = 0; axis < 3; ++axis)
      v[axis] = loadValue(point, *fields[axis]);
    v = function(v);
    for (int axis = 0; axis < 3; ++axis)
      storeValue(point, *fields[axis], v[axis]);
  }
}

} // namespace

Cloud
readCloud(const std::string& path, std::size_t raw_row_length)
{
  Cloud cloud = parseFile(path, [&](const std::string& bytes) {
    return parseCloud(extensionOf(path), bytes, raw_row_length);
  });
  if (cloud.size() == 0)
    throw InputError(path + ": holds no points");
  return cloud;
}

bool
isReadableCloudPath(const std::string& path)
{
  return isWritableCloudPath(path) || extensionOf(path) == ".bin";
}

bool
isWritableCloudPath(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".pcd" || extension == ".ply";
}

void
writeCloud(const std::string& path, const Cloud& cloud)
{
  std::string bytes;
  try {
    bytes = extensionOf(path) == ".ply" ? formatPly(cloud) : formatPcd(cloud);
  }
  catch (const InputError& error) {
    throw InputError(path + ": cannot be written: " + error.what());
  }
  writeFile(path, bytes);
}

void
transformCloud(Cloud& cloud, const RigidTransform& T_new_old)
{
  changePositionTypes(cloud, [](ScalarType type) {
    if (isFloat(type))
      return type;
    return sizeOf(type) <= 2 ? ScalarType::Float32 : ScalarType::Float64;
  });
  const auto moved = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return T_new_old.rotation * p + T_new_old.translation;
  };
  mapVectors(cloud, kPositionNames, moved);
  mapVectors(cloud, kNormalNames, [&](const Eigen::Vector3d& n) -> Eigen::Vector3d {
    return T_new_old.rotation * n;
  });
  auto& [x, y, z, qw, qx, qy, qz] = cloud.viewpoint;
  const Eigen::Vector3d position = moved({x, y, z});
  const auto orientation =
      Eigen::Quaterniond(T_new_old.rotation) * Eigen::Quaterniond(qw, qx, qy, qz);
  cloud.viewpoint = {position.x(),
                     position.y(),
                     position.z(),
                     orientation.w(),
                     orientation.x(),
                     orientation.y(),
                     orientation.z()};
}

void
promoteCoordinates(Cloud& cloud)
{
  changePositionTypes(cloud, [](ScalarType) { return ScalarType::Float64; });
}

} // namespace pcl_flashreg::io
