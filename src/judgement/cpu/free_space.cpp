// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/free_space.h"

#include "math/cube_image.h"

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
  return static_cast<std::size_t>(cubePixelOf(cubePlaceOf(ray), edge_));
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
  constexpr float unseen = std::numeric_limits<float>::infinity();
  std::vector<float> own(FACES * edge * edge, unseen);
  for (std::size_t i = 0; i < points.size(); ++i) {
    float& range = own[pixelOf(points[i] - viewpoint)];
    range = std::min(range, ranges[i]);
  }
  leastAround(own, edge_, nearest_);
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i] == unseen)
      nearest_[i] = 0;
}

} // namespace pcl_flashreg
