// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/aligned_buffer.h"
#include "scan/cpu/neighbor_grid.h"
#include "scan/cpu/visibility.h"
#include "scan/cpu/voxel_grid.h"
#include "scan/scan_pipeline.h"
#include "simd/kernels.h"
#include "support/thread_pool.h"

#include <pcl_flashreg/feature_extractor.h>

#include <vector>

namespace pcl_flashreg {
namespace cpu {

/** \brief The steps from a cloud to its descriptors on the CPU, and the memory between
 * them. Every member function named after a step stands in the file of that name. */
class FeatureStages {
public:
  FeatureStages(const Kernels& kernels, ThreadPool& pool)
      : kernels_(kernels), pool_(pool)
  {
  }

  /** \brief Fills keypoints(). */
  void
  voxelGrid(const PointView& points, double voxel_size);
  /** \brief Sorts the keypoints, for radii up to this one. */
  void
  neighborGrid(double radius);
  /** \brief Normals of the keypoints, the mean of those given in a voxel, or else
   * computed, of either sign; keypoints that have none leave the grid. */
  void
  normals(const PointView& points, const GivenNormals& given, double radius);
  /** \brief At most so many keypoints with their normals, spread over all of the surface:
   * what tells where it was seen from.
   * \param[in] spacing distance of neighbouring keypoints, > 0 */
  Visibility
  visibility(std::size_t most, double spacing) const;
  /** \brief Turns computed normals towards a place, and given ones if asked to. */
  void
  turnNormals(const Eigen::Vector3f& viewpoint, bool given_too);
  /** \brief Whether there are normals that nobody gave. */
  bool
  hasComputedNormals() const;
  /** \brief Simplified point feature histograms. */
  void
  pointHistograms(double radius);
  /** \brief FPFH; keypoints that have no pair leave the grid. */
  void
  featureHistograms(double radius);
  /** \brief In the order of the keypoints, those that have left the grid left out, or
   * kept with a normal that is not finite; with descriptors, if those were computed. */
  DescribedCloud
  takeResult(ScanContent content, bool every_keypoint);

private:
  /** \brief Of any length, in the order of the keypoints; empty where none are given. */
  std::vector<Vec3>
  sumNormals(const PointView& points, const GivenNormals& given) const;

  /** \brief A point's neighbours, in memory of the thread. */
  struct Neighbors {
    AlignedBuffer<std::uint32_t> indices;
    AlignedBuffer<float> squared_distances;
    std::size_t count = 0;
  };

  /** \brief Calls visit(i, neighbors) for every point of the grid that was not removed. */
  template <typename Visit>
  void
  forEachPoint(double radius, const Visit& visit);

  const Kernels& kernels_;
  ThreadPool& pool_;

  VoxelGrid voxel_grid_;
  /** \brief 0 where every point is a keypoint. */
  double voxel_size_ = 0;
  /** \brief n x 3, in the order of the voxels. */
  std::vector<float> keypoints_;
  NeighborGrid grid_;
  std::vector<Neighbors> neighbors_;
  /** \brief In the order of the grid, as the rest. */
  std::vector<float> curvatures_;
  enum class NormalSource : char { None, Given, Computed };
  std::vector<NormalSource> normal_sources_;
  /** \brief Rows of HISTOGRAM_STRIDE. */
  AlignedBuffer<float> point_histograms_, feature_histograms_;
};

/** \brief Makes the number of neighbours a multiple of NEIGHBOR_BLOCK by repeating a point.
 * \return that number
 */
inline std::size_t
padNeighbors(std::uint32_t* indices, std::size_t count, std::uint32_t with)
{
  while (count % NEIGHBOR_BLOCK != 0)
    indices[count++] = with;
  return count;
}

template <typename Visit>
void
FeatureStages::forEachPoint(double radius, const Visit& visit)
{
  constexpr std::size_t TASK = 64;
  const auto squared_radius = static_cast<float>(radius * radius);
  neighbors_.resize(pool_.size());
  const std::size_t tasks = (grid_.size() + TASK - 1) / TASK;
  pool_.forEach(tasks, [&](std::size_t task, std::size_t thread) {
    Neighbors& around = neighbors_[thread];
    around.indices.resize(grid_.capacity());
    around.squared_distances.resize(grid_.capacity());
    const std::size_t end = std::min(grid_.size(), (task + 1) * TASK);
    for (std::size_t i = task * TASK; i < end; ++i) {
      if (grid_.isRemoved(i))
        continue;
      around.count = grid_.collect(kernels_,
                                   i,
                                   squared_radius,
                                   around.indices.data(),
                                   around.squared_distances.data());
      visit(i, around);
    }
  });
}

} // namespace cpu
} // namespace pcl_flashreg
