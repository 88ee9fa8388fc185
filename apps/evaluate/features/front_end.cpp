// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "front_end.h"

#include "hash.h"

#include <pcl_flashreg/pair_registration.h>

#include <vector>

namespace pcl_flashreg::evaluate {
namespace {

/** \brief A wavy sheet and a wall: 2000 points with edges, bends and flat parts. */
std::vector<float>
madeCloud()
{
  std::vector<float> xyz;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 25; ++j) {
      const float x = 0.03f * static_cast<float>(i), y = 0.04f * static_cast<float>(j);
      xyz.insert(xyz.end(), {x, y, 2.0f + 0.25f * x * (x - 1.0f) + 0.125f * y * y});
      xyz.insert(xyz.end(), {x, 1.0f, 2.0f + y});
    }
  return xyz;
}

} // namespace

std::string
frontEndFingerprint()
{
  const std::vector<float> xyz = madeCloud();
  ScanInput<float> input;
  input.points.data = xyz.data();
  input.points.size = xyz.size() / 3;
  const Scan scan = PairRegistration(BackendKind::Cpu, 1).makeScan(input, 0.1);
  const FeatureView features = scan.features();
  std::string bytes;
  const auto append = [&bytes](const float* values, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(float));
  };
  for (std::size_t i = 0; i < scan.size(); ++i) {
    append(scan.points() + 3 * i, 3);
    append(features.data + i * features.stride, features.dimension);
  }
  return toHex(hashOf(bytes));
}

} // namespace pcl_flashreg::evaluate
