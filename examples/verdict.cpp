// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Everything that a result says of how far to trust it: here, of two scans along a smooth
// corridor, in which one may slide along the other.

#include <pcl_flashreg/pair_registration.h>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace pcl_flashreg;

/** \brief Walls, floor and ceiling of a corridor along x, 2 m wide and 2.5 m high. */
static std::vector<float>
corridor(float from, float to)
{
  std::vector<float> xyz;
  const auto add = [&](float x, float y, float z) { xyz.insert(xyz.end(), {x, y, z}); };
  for (float x = from; x < to; x += 0.04f)
    for (float u = 0; u < 1; u += 0.02f) {
      add(x, -1 + 2 * u, 0), add(x, -1 + 2 * u, 2.5f);
      add(x, -1, 2.5f * u), add(x, 1, 2.5f * u);
    }
  return xyz;
}

int
main()
{
  const std::vector<float> a = corridor(-6, 6), b = corridor(-4, 8);
  ScanInput<float> source, target;
  source.points = {a.data(), a.size() / 3};
  target.points = {b.data(), b.size() / 3};
  PairOptions options;
  options.resolution = 0.1;
  const Result result = PairRegistration().align(source, target, options).pose;
  std::printf("%s: confidence %.2f, %.0f %% of the points match\n",
              result.converged ? "trusted" : "not trusted",
              result.confidence,
              100 * result.evidence.agreement.matched);
  for (const FreeMotion& motion : result.free_motions)
    std::printf("may %s (%.2f %.2f %.2f), from %.1f to %.1f\n",
                motion.kind == FreeMotion::Kind::Slide ? "slide along" : "turn about",
                motion.direction.x(),
                motion.direction.y(),
                motion.direction.z(),
                motion.backward,
                motion.forward);
  std::printf("%zu poses differ; along x the information is %.3g, across %.3g\n",
              result.hypotheses.size(),
              result.information(3, 3),
              result.information(4, 4));
  return result.converged ? 1 : 0; // trusting it would be the mistake
}
