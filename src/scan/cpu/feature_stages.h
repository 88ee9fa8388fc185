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
#include <pcl_flashreg/impl/equal_rows.hpp>

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
  /** \brief Numbers of the keypoints whose normals were computed; of one of them where it is,
   * its normal, and what turns it. */
  std::vector<std::uint32_t>
  computedNormals() const;
  Eigen::Vector3f
  pointAt(std::uint32_t keypoint) const;
  Eigen::Vector3f
  normalAt(std::uint32_t keypoint) const;
  void
  turnNormal(std::uint32_t keypoint);
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

  /** \brief Fills places_. */
  void
  findPlaces();

  /** \brief Calls visit(i, neighbors) for one point of the grid at every place where there
   * are any that were not removed: what equals it has the same neighbours. */
  template <typename Visit>
  void
  forEachPlace(double radius, const Visit& visit);

  /** \brief Calls visit(j) for the point that forEachPlace() visits, and for those that
   * equal it. */
  template <typename Visit>
  void
  forEachAt(std::size_t i, const Visit& visit) const;

  void
  shareHistogram(std::size_t i, AlignedBuffer<float>& histograms) const;

  const Kernels& kernels_;
  ThreadPool& pool_;

  VoxelGrid voxel_grid_;
  /** \brief 0 where every point is a keypoint. */
  double voxel_size_ = 0;
  /** \brief n x 3, in the order of the voxels. */
  std::vector<float> keypoints_;
  NeighborGrid grid_;
  /** \brief Points of the grid, where every point is a keypoint; centroids of voxels
   * differ. */
  detail::EqualRows equal_;
  /** \brief Points that are visited. */
  std::vector<std::size_t> places_;
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
FeatureStages::forEachAt(std::size_t i, const Visit& visit) const
{
  visit(i);
  for (std::uint32_t j = equal_.next(static_cast<std::uint32_t>(i));
       j != detail::EqualRows::NONE;
       j = equal_.next(j))
    if (!grid_.isRemoved(j))
      visit(std::size_t{j});
}

template <typename Visit>
void
FeatureStages::forEachPlace(double radius, const Visit& visit)
{
  constexpr std::size_t TASK = 64;
  const auto squared_radius = static_cast<float>(radius * radius);
  findPlaces();
  neighbors_.resize(pool_.size());
  const std::size_t tasks = (places_.size() + TASK - 1) / TASK;
  pool_.forEach(tasks, [&](std::size_t task, std::size_t thread) {
    Neighbors& around = neighbors_[thread];
    around.indices.resize(grid_.capacity());
    around.squared_distances.resize(grid_.capacity());
    const std::size_t end = std::min(places_.size(), (task + 1) * TASK);
    for (std::size_t p = task * TASK; p < end; ++p) {
      around.count = grid_.collect(kernels_,
                                   places_[p],
                                   squared_radius,
                                   around.indices.data(),
                                   around.squared_distances.data());
      visit(places_[p], around);
    }
  });
}

} // namespace cpu
} // namespace pcl_flashreg
