// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Fast Point Feature Histograms as pcl::FPFHEstimation defines them: each point's own
// histogram of its pairs with its neighbours, then the sum of the neighbours' histograms,
// weighted by the inverse of their squared distance.

#include "scan/cpu/feature_stages.h"

#include <algorithm>

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief Scales each third of a histogram to a sum of 100.
 * \return false if there is nothing in it
 */
bool
normalizeThirds(float* histogram)
{
  bool any = false;
  for (std::size_t third = 0; third < 3; ++third) {
    float* bins = histogram + third * HISTOGRAM_BINS;
    float sum = 0;
    for (std::size_t bin = 0; bin < HISTOGRAM_BINS; ++bin)
      sum += bins[bin];
    if (!(sum > 0))
      continue;
    any = true;
    const float scale = 100.0f / sum;
    for (std::size_t bin = 0; bin < HISTOGRAM_BINS; ++bin)
      bins[bin] *= scale;
  }
  return any;
}

} // namespace

/** \brief Gives the points that equal point i its histogram: their normals are computed, and
 * so the same as well. */
void
FeatureStages::shareHistogram(std::size_t i, AlignedBuffer<float>& histograms) const
{
  forEachAt(i, [&](std::size_t j) {
    if (j != i)
      std::copy_n(histograms.begin() + i * HISTOGRAM_STRIDE,
                  HISTOGRAM_STRIDE,
                  histograms.begin() + j * HISTOGRAM_STRIDE);
  });
}

void
FeatureStages::pointHistograms(double radius)
{
  point_histograms_.resize(grid_.size() * HISTOGRAM_STRIDE);
  std::fill(point_histograms_.begin(), point_histograms_.end(), 0.0f);
  forEachPlace(radius, [&](std::size_t i, Neighbors& around) {
    const std::size_t padded = padNeighbors(
        around.indices.data(), around.count, static_cast<std::uint32_t>(i));
    std::uint32_t counts[FPFH_BINS] = {};
    kernels_.pairHistogram(grid_.arrays(),
                           static_cast<std::uint32_t>(i),
                           around.indices.data(),
                           padded,
                           counts);
    // The point itself is one of the neighbours.
    const float share =
        around.count > 1 ? 100.0f / static_cast<float>(around.count - 1) : 0.0f;
    float* histogram = point_histograms_.data() + i * HISTOGRAM_STRIDE;
    for (std::size_t bin = 0; bin < FPFH_BINS; ++bin)
      histogram[bin] = share * static_cast<float>(counts[bin]);
    shareHistogram(i, point_histograms_);
  });
}

void
FeatureStages::featureHistograms(double radius)
{
  feature_histograms_.resize(grid_.size() * HISTOGRAM_STRIDE);
  std::vector<char> has_pairs(grid_.size(), 0);
  forEachPlace(radius, [&](std::size_t i, Neighbors& around) {
    // Weights take the place of the distances; the point itself, and whatever coincides
    // with it, has none.
    std::size_t count = 0;
    for (std::size_t n = 0; n < around.count; ++n)
      if (around.squared_distances[n] > 0) {
        around.indices[count] = around.indices[n];
        around.squared_distances[count++] = 1.0f / around.squared_distances[n];
      }
    float* histogram = feature_histograms_.data() + i * HISTOGRAM_STRIDE;
    kernels_.weightedRowSum(point_histograms_.data(),
                            around.indices.data(),
                            around.squared_distances.data(),
                            count,
                            histogram);
    const bool any = normalizeThirds(histogram);
    forEachAt(i, [&](std::size_t j) { has_pairs[j] = any ? 1 : 0; });
    shareHistogram(i, feature_histograms_);
  });
  for (std::size_t i = 0; i < grid_.size(); ++i)
    if (!has_pairs[i])
      grid_.remove(i);
}

} // namespace cpu
} // namespace pcl_flashreg
