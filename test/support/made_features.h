// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/made_correspondences.h"

#include <pcl_flashreg/feature_matching.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace pcl_flashreg {
namespace made {

struct Features {
  std::vector<float> values;
  std::size_t dimension, stride;

  FeatureView
  view() const
  {
    return {values.data(), values.size() / stride, dimension, stride};
  }
};

/** \brief Descriptors that don't resemble each other; a fifth of the values is zero. */
inline Features
scattered(std::size_t size,
          std::size_t dimension,
          std::size_t stride,
          std::uint64_t seed)
{
  Random random(seed);
  Features features{{}, dimension, stride};
  for (std::size_t i = 0; i < size * stride; ++i) {
    const double value = random.uniform(-20, 80);
    features.values.push_back(value < 0 ? 0.0f : static_cast<float>(value));
  }
  return features;
}

/** \brief Descriptors on a plane, the same for every seed, but for some noise; what is
 * measured of real surfaces is alike. */
inline Features
onSurface(std::size_t size, std::size_t dimension, double noise, std::uint64_t seed)
{
  Random random(seed);
  Features features{{}, dimension, dimension};
  for (std::size_t i = 0; i < size; ++i) {
    const double u = random.uniform(-50, 50), v = random.uniform(-50, 50);
    for (std::size_t d = 0; d < dimension; ++d)
      features.values.push_back(static_cast<float>(
          u * std::sin(1.0 + d) + v * std::cos(2.0 * d) + noise * random.normal()));
  }
  return features;
}

/** \brief Descriptors of a few kinds, in no order; the kinds are the same for every seed,
 * and many are as far from each other as others are. */
inline Features
ofFewKinds(std::size_t size, std::size_t dimension, int kinds, std::uint64_t seed)
{
  Random random(seed);
  Features features{{}, dimension, dimension + 1};
  for (std::size_t i = 0; i < size; ++i) {
    const auto kind = static_cast<int>(random.uniform(0, kinds));
    for (std::size_t d = 0; d <= dimension; ++d)
      // What lies between two descriptors is not part of them.
      features.values.push_back(
          static_cast<float>(d < dimension ? (kind >> d % 8) % 2 : i));
  }
  return features;
}

/** \brief Every value times a factor, plus an offset. */
inline Features
moved(Features features, double factor, double offset)
{
  for (float& value : features.values)
    value = static_cast<float>(factor * value + offset);
  return features;
}

} // namespace made
} // namespace pcl_flashreg
