// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "merged_cloud.h"

#include "../io/cloud_io.h"
#include "../io/error.h"
#include "../io/pcl_cloud.h"

#include <pcl_flashreg/impl/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace pcl_flashreg::map {
namespace {

using io::Cloud;
using io::Field;
using io::ScalarType;

bool
isCoordinate(const Field& field)
{
  return field.name == "x" || field.name == "y" || field.name == "z";
}

/** \brief PCL packs colours into four bytes, of one type or the other. */
bool
isPackedColor(const Field& field)
{
  return (field.name == "rgb" || field.name == "rgba") && field.byteSize() == 4;
}

/** \brief Whether single precision would lose digits of the file's. */
bool
hasFineCoordinates(const Cloud& cloud)
{
  return std::any_of(cloud.fields.begin(), cloud.fields.end(), [](const Field& field) {
    const std::size_t single = io::isFloat(field.type) ? 4 : 2;
    return isCoordinate(field) && io::sizeOf(field.type) > single;
  });
}

/** \brief The fields that both have, in the order of the first; of a type that holds the
 * values of both. */
std::vector<Field>
commonFields(const Cloud& a, const Cloud& b)
{
  std::vector<Field> common;
  for (const Field& field : a.fields) {
    const Field* other = b.find(field.name);
    if (other == nullptr || other->count != field.count)
      continue;
    common.push_back(field);
    if (other->type != field.type && !isPackedColor(field))
      common.back().type = ScalarType::Float64;
  }
  return common;
}

bool
sameLayout(const std::vector<Field>& a, const std::vector<Field>& b)
{
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const Field& x, const Field& y) {
        return x.name == y.name && x.type == y.type && x.count == y.count;
      });
}

void
convert(Cloud& cloud, const std::vector<Field>& fields)
{
  // A colour keeps its bytes, not its value as a number.
  for (Field& field : cloud.fields)
    for (const Field& wanted : fields)
      if (field.name == wanted.name && isPackedColor(field) && isPackedColor(wanted))
        field.type = wanted.type;
  if (!sameLayout(cloud.fields, fields))
    cloud = io::withFields(cloud, fields);
}

/** \brief Points as they come in, of which one a voxel is kept. */
class Merger {
public:
  explicit Merger(double leaf) : leaf_(leaf), slots_(1024, NONE) {}

  void
  add(Cloud cloud, const RigidTransform& T_map_scan)
  {
    fine_ = fine_ || hasFineCoordinates(cloud);
    io::promoteCoordinates(cloud);
    io::transformCloud(cloud, T_map_scan);
    if (kept_.fields.empty()) {
      for (const Field& field : cloud.fields)
        kept_.addField(field.name, field.type, field.count);
    }
    else {
      const std::vector<Field> common = commonFields(kept_, cloud);
      convert(kept_, common);
      convert(cloud, common);
    }
    offsets_ = {
        kept_.find("x")->offset, kept_.find("y")->offset, kept_.find("z")->offset};
    const Eigen::Matrix3Xd xyz = io::coordinates(cloud);
    for (Eigen::Index i = 0; i < xyz.cols(); ++i)
      if (xyz.col(i).allFinite())
        addPoint(cloud.point(static_cast<std::size_t>(i)), xyz.col(i));
  }

  /** \brief The cloud, with coordinates no longer than they need to be. */
  Cloud
  take()
  {
    if (!fine_ && !io::needsDoublePrecision(io::coordinates(kept_))) {
      std::vector<Field> fields = kept_.fields;
      for (Field& field : fields)
        if (isCoordinate(field))
          field.type = ScalarType::Float32;
      convert(kept_, fields);
    }
    return std::move(kept_);
  }

private:
  static constexpr std::size_t NONE = std::numeric_limits<std::size_t>::max();

  /** \brief Whole numbers; as doubles they have no range to leave. */
  Eigen::Vector3d
  voxelOf(const Eigen::Vector3d& point) const
  {
    // The sum makes -0 a 0, whose bits differ.
    return (point / leaf_).array().floor() + 0.0;
  }

  double
  distanceFromMiddle(const Eigen::Vector3d& point) const
  {
    const Eigen::Vector3d within = point / leaf_ - voxelOf(point);
    return (within - Eigen::Vector3d::Constant(0.5)).norm();
  }

  /** \brief Coordinates are doubles here: exactly those that the point came with. */
  Eigen::Vector3d
  keptPoint(std::size_t i) const
  {
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis)
      std::memcpy(&point[axis],
                  kept_.point(i) + offsets_[static_cast<std::size_t>(axis)],
                  sizeof(double));
    return point;
  }

  /** \brief Where the number of that voxel's point is, or belongs. */
  std::size_t&
  slotOf(const Eigen::Vector3d& voxel)
  {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      std::uint64_t bits;
      std::memcpy(&bits, &voxel[axis], sizeof(bits));
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15ull;
      hash ^= hash >> 32;
    }
    std::size_t slot = hash & (slots_.size() - 1);
    while (slots_[slot] != NONE && voxelOf(keptPoint(slots_[slot])) != voxel)
      slot = (slot + 1) & (slots_.size() - 1);
    return slots_[slot];
  }

  void
  addPoint(const std::uint8_t* bytes, const Eigen::Vector3d& point)
  {
    if (2 * kept_.width >= slots_.size()) {
      slots_.assign(2 * slots_.size(), NONE);
      for (std::size_t i = 0; i < kept_.width; ++i)
        slotOf(voxelOf(keptPoint(i))) = i;
    }
    std::size_t& number = slotOf(voxelOf(point));
    if (number == NONE) {
      number = kept_.width++;
      kept_.data.insert(kept_.data.end(), bytes, bytes + kept_.point_size);
    }
    else if (distanceFromMiddle(point) < distanceFromMiddle(keptPoint(number))) {
      std::copy(bytes, bytes + kept_.point_size, kept_.point(number));
    }
  }

  double leaf_;
  Cloud kept_;
  /** \brief Of x, y and z in a point that is kept. */
  std::array<std::size_t, 3> offsets_{};
  bool fine_ = false;
  /** \brief An open hash table; as many as a power of two. Voxels are not stored: they are
   * those of the points. */
  std::vector<std::size_t> slots_;
};

} // namespace

std::size_t
writeMergedCloud(const std::vector<MapInput>& scans,
                 double leaf,
                 const std::string& output,
                 std::size_t raw_row_length)
{
  if (!(leaf > 0 && std::isfinite(leaf)))
    throw std::invalid_argument("the leaf of the merged cloud is " +
                                detail::toText(leaf) + ", it must be > 0 and finite");
  Merger merger(leaf);
  for (const MapInput& scan : scans)
    merger.add(io::readCloud(scan.path, raw_row_length), scan.T_map_scan);
  const Cloud cloud = merger.take();
  if (cloud.size() == 0)
    throw io::InputError(output + ": no scan has a point with finite coordinates");
  io::writeCloud(output, cloud);
  return cloud.size();
}

} // namespace pcl_flashreg::map
