// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/free_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_flashreg {
namespace {

/** \brief Side of a pixel in spacings, at the median range. */
constexpr float PIXEL = 1.5f;

constexpr int MIN_EDGE = 4, MAX_EDGE = 256, FACES = 6;

} // namespace

std::size_t
FreeSpace::pixelOf(const Eigen::Vector3f& ray) const
{
  Eigen::Index axis = 0;
  const float largest = ray.cwiseAbs().maxCoeff(&axis);
  if (!(largest > 0))
    return 0;
  const int face = 2 * static_cast<int>(axis) + (ray[axis] > 0 ? 0 : 1);
  const auto column = [&](Eigen::Index a) {
    const float along = 0.5f * (ray[a] / largest + 1) * static_cast<float>(edge_);
    // What overflows is no number here: it is put into the first column.
    const int pixel = along > 0 ? static_cast<int>(along) : 0;
    return std::min(edge_ - 1, pixel);
  };
  return (static_cast<std::size_t>(face) * edge_ + column(axis == 0 ? 1 : 0)) * edge_ +
         column(axis == 2 ? 1 : 2);
}

void
FreeSpace::build(const Array<Eigen::Vector3f>& points,
                 const Eigen::Vector3f& viewpoint,
                 float spacing)
{
  clear();
  if (points.empty() || !viewpoint.allFinite())
    return;
  viewpoint_ = viewpoint;
  std::vector<float> ranges;
  for (const Eigen::Vector3f& point : points)
    ranges.push_back((point - viewpoint).norm());
  std::vector<float> sorted = ranges;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  // A face is two units wide at a distance of one.
  edge_ = static_cast<int>(std::max<float>(
      MIN_EDGE, std::min<float>(MAX_EDGE, 2 * *middle / (PIXEL * spacing))));

  const auto edge = static_cast<std::size_t>(edge_);
  nearest_.assign(FACES * edge * edge, 0);
  constexpr float unseen = std::numeric_limits<float>::infinity();
  std::vector<float> own(nearest_.size(), unseen);
  for (std::size_t i = 0; i < points.size(); ++i) {
    float& range = own[pixelOf(points[i] - viewpoint)];
    range = std::min(range, ranges[i]);
  }
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i] == unseen)
      continue;
    const std::size_t face = i - i % (edge * edge);
    const std::size_t row = i % (edge * edge) / edge, column = i % edge;
    float least = own[i];
    for (std::size_t r = std::max<std::size_t>(1, row) - 1;
         r <= std::min(edge - 1, row + 1);
         ++r)
      for (std::size_t c = std::max<std::size_t>(1, column) - 1;
           c <= std::min(edge - 1, column + 1);
           ++c)
        least = std::min(least, own[face + r * edge + c]);
    nearest_[i] = least;
  }
}

} // namespace pcl_flashreg
