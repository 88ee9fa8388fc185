// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan/cpu/voxel_grid.h"

#include "scan/points.h"

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief Points that are added up in one go. */
constexpr std::size_t PIECE = 8192;

} // namespace

void
VoxelTable::clear()
{
  voxels_.clear();
  std::fill(slots_.begin(), slots_.end(), 0);
}

std::size_t
VoxelTable::slotOf(std::uint64_t key) const
{
  // Fibonacci hashing: successive keys are spread over the table.
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = (key * 0x9E3779B97F4A7C15ull >> 20) & mask;
  while (slots_[slot] != 0 && voxels_[slots_[slot] - 1].key != key)
    slot = (slot + 1) & mask;
  return slot;
}

void
VoxelTable::grow()
{
  slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), 0);
  for (std::size_t v = 0; v < voxels_.size(); ++v)
    slots_[slotOf(voxels_[v].key)] = static_cast<std::uint32_t>(v + 1);
}

void
VoxelTable::add(const VoxelSum& part)
{
  if (2 * (voxels_.size() + 1) > slots_.size())
    grow();
  std::uint32_t& slot = slots_[slotOf(part.key)];
  if (slot == 0) {
    voxels_.push_back(part);
    slot = static_cast<std::uint32_t>(voxels_.size());
    return;
  }
  VoxelSum& voxel = voxels_[slot - 1];
  voxel.x += part.x;
  voxel.y += part.y;
  voxel.z += part.z;
  voxel.count += part.count;
}

void
VoxelGrid::run(const PointView& points,
               const Bounds& bounds,
               float voxel_size,
               ThreadPool& pool,
               std::vector<float>& centroids)
{
  const std::size_t count = countOf(points);
  const auto point = [&points](std::size_t i) { return pointOf(points, i); };
  numbering_.emplace(VoxelFloor{1.0f / voxel_size}, bounds, count, point);
  const CellNumbering<VoxelFloor>& numbering = *numbering_;

  const std::size_t piece_count = (count + PIECE - 1) / PIECE;
  pieces_.resize(std::min(pool.size(), piece_count));
  table_.clear();
  // As many pieces at a time as there are threads: what they hold stays small.
  for (std::size_t first = 0; first < piece_count; first += pieces_.size()) {
    const std::size_t taken = std::min(pieces_.size(), piece_count - first);
    pool.forEach(taken, [&](std::size_t t, std::size_t) {
      VoxelTable& piece = pieces_[t];
      piece.clear();
      const std::size_t begin = (first + t) * PIECE;
      for (std::size_t i = begin; i < std::min(begin + PIECE, count); ++i) {
        const float* p = point(i);
        if (isFinite(p))
          piece.add({numbering.key(p), p[0], p[1], p[2], 1});
      }
    });
    for (std::size_t t = 0; t < taken; ++t)
      for (const VoxelSum& voxel : pieces_[t].voxels())
        table_.add(voxel);
  }

  const std::vector<VoxelSum>& voxels = table_.voxels();
  order_.resize(voxels.size());
  for (std::size_t v = 0; v < voxels.size(); ++v)
    order_[v] = {voxels[v].key, static_cast<std::uint32_t>(v)};
  radixSort(order_, numbering.bits());
  centroids.clear();
  centroids.reserve(3 * voxels.size());
  for (const KeyedIndex& item : order_) {
    const VoxelSum& voxel = voxels[item.index];
    for (const double sum : {voxel.x, voxel.y, voxel.z})
      centroids.push_back(static_cast<float>(sum / voxel.count));
  }
}

std::vector<Vec3>
VoxelGrid::sumNormals(const PointView& points, const GivenNormals& normals) const
{
  std::vector<std::uint32_t> row_of(order_.size());
  for (std::size_t row = 0; row < order_.size(); ++row)
    row_of[order_[row].index] = static_cast<std::uint32_t>(row);
  std::vector<Vec3> sums(order_.size(), Vec3{0, 0, 0});
  for (std::size_t i = 0; i < countOf(points); ++i) {
    const float* point = pointOf(points, i);
    const float* normal = normals.of(indexOf(points, i));
    if (!isFinite(point) || !isFinite(normal))
      continue;
    Vec3& sum = sums[row_of[table_.find(numbering_->key(point))]];
    const Vec3 n{normal[0], normal[1], normal[2]};
    // Where nobody has turned the normals, neighbours may look opposite ways.
    sum = dot(sum, n) < 0 ? sum - n : sum + n;
  }
  return sums;
}

} // namespace cpu
} // namespace pcl_flashreg
