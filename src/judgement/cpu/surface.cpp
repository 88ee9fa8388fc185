// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/surface.h"

#include "judgement/cpu/z_order.h"
#include "support/radix_sort.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace pcl_flashreg {

void
Surface::putInOrder(float spacing)
{
  if (points.empty())
    return;
  /** \brief Of the cells, in spacings: the smallest part of a scan that matters. */
  constexpr float SIDE = 4;
  key_corner = points.front();
  Eigen::Vector3f high = key_corner;
  for (const Eigen::Vector3f& point : points) {
    key_corner = key_corner.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  // No more cells an axis than a key has room for.
  constexpr float MOST = (1 << Z_ORDER_BITS) - 1;
  key_side = std::max(SIDE * spacing, (high - key_corner).maxCoeff() / MOST);
  std::vector<KeyedIndex> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Array3i cell =
        ((points[i] - key_corner) / key_side).array().min(MOST).cast<int>();
    order[i] = {zOrderKey(cell), static_cast<std::uint32_t>(i)};
  }
  radixSort(order, 3 * Z_ORDER_BITS);
  std::vector<Eigen::Vector3f> sorted_points, sorted_normals;
  std::vector<std::uint64_t> sorted_keys;
  for (const KeyedIndex& item : order) {
    sorted_points.push_back(points[item.index]);
    sorted_normals.push_back(normals[item.index]);
    sorted_keys.push_back(item.key);
  }
  points = std::move(sorted_points);
  normals = std::move(sorted_normals);
  keys = std::move(sorted_keys);
}

template <typename Scalar>
void
Surface::build(const CloudView<Scalar>& cloud,
               const Vec3& centre,
               float spacing,
               bool in_order)
{
  std::vector<Eigen::Vector3f>& finite_points = points.own();
  std::vector<Eigen::Vector3f>& their_normals = normals.own();
  finite_points.clear();
  their_normals.clear();
  keys = std::vector<std::uint64_t>();
  const Eigen::Vector3d origin(centre.x, centre.y, centre.z);
  for (std::size_t i = 0; i < cloud.size; ++i) {
    using Row = Eigen::Matrix<Scalar, 3, 1>;
    const Eigen::Vector3d point =
        Eigen::Map<const Row>(cloud.xyz + 3 * i).template cast<double>() - origin;
    const Eigen::Map<const Eigen::Vector3f> normal(cloud.normals + 3 * i);
    if (!point.allFinite() || !normal.allFinite())
      continue;
    finite_points.push_back(point.template cast<float>());
    their_normals.push_back(normal);
  }
  points.seal();
  normals.seal();
  if (in_order)
    putInOrder(spacing);
  nearest.build(points, spacing);
  lookFrom(cloud.viewpoint, centre, spacing);
  has_sides = cloud.normals_oriented && !free_space.known() && !in_order;
  constexpr float AROUND = 3;
  const Array<Eigen::Vector3f> none;
  around.build(has_sides ? points : none, AROUND * spacing);
}

void
Surface::lookFrom(const std::optional<Eigen::Vector3d>& viewpoint,
                  const Vec3& centre,
                  float spacing)
{
  const Eigen::Vector3d origin(centre.x, centre.y, centre.z);
  if (viewpoint)
    free_space.build(points, (*viewpoint - origin).cast<float>(), spacing);
  else
    free_space.clear();
}

template <typename Scalar>
Vec3
middleOf(const CloudView<Scalar>& cloud)
{
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Scalar* const p = cloud.xyz + 3 * i;
    const Eigen::Vector3d point(p[0], p[1], p[2]);
    if (point.allFinite())
      box.extend(point);
  }
  if (box.isEmpty())
    return {0, 0, 0};
  const Eigen::Vector3d middle = 0.5 * (box.min() + box.max());
  return {middle.x(), middle.y(), middle.z()};
}

template Vec3
middleOf(const CloudView<float>&);
template Vec3
middleOf(const CloudView<double>&);

template void
Surface::build(const CloudView<float>&, const Vec3&, float, bool);
template void
Surface::build(const CloudView<double>&, const Vec3&, float, bool);

} // namespace pcl_flashreg
