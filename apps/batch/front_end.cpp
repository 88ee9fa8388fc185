// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "front_end.h"

#include "../io/hash.h"

#include <pcl_flashreg/pair_registration.h>

#include <vector>

namespace pcl_flashreg::batch {
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
  std::vector<float> xyz = madeCloud();
  // Beams without a return, and a stray.
  xyz.insert(xyz.end(), 3 * 200, 0.0f);
  xyz.insert(xyz.end(), {1e5f, 0, 0});
  ScanInput<float> input;
  input.points.data = xyz.data();
  input.points.size = xyz.size() / 3;
  input.viewpoint_known = true;
  PairRegistration registration(BackendKind::Cpu, 1);
  std::string bytes = registration.makeScan(input, 0.1).serialize();
  // Places that the points were seen from, or nearly, or not at all.
  for (const double x : {0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 20.0}) {
    input.viewpoint = {x, 1.3 - x, 1.9 + 0.2 * x};
    bytes += registration.makeScan(input, 0.03, ScanContent::Surface).serialize();
  }
  return io::toHex(io::hashOf(bytes));
}

} // namespace pcl_flashreg::batch
