// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/host_device.h"
#include "math/residual.h"
#include "math/vec3.h"

namespace pcl_flashreg {

/** \brief T_target_source: target = r * source + t. */
struct Pose {
  /** \brief Rotation, row-major. */
  double r[9];
  double t[3];
};

PCL_FLASHREG_HD inline Vec3
rotate(const double r[9], const Vec3& p)
{
  return {(r[0] * p.x + r[1] * p.y) + r[2] * p.z,
          (r[3] * p.x + r[4] * p.y) + r[5] * p.z,
          (r[6] * p.x + r[7] * p.y) + r[8] * p.z};
}

PCL_FLASHREG_HD inline Vec3
transform(const Pose& T, const Vec3& p)
{
  const Vec3 q = rotate(T.r, p);
  return {q.x + T.t[0], q.y + T.t[1], q.z + T.t[2]};
}

/** \brief Sets the translation so that it takes the one point onto the other. */
PCL_FLASHREG_HD inline void
setTranslation(Pose& T, const Vec3& source, const Vec3& target)
{
  const Vec3 rotated = rotate(T.r, source);
  T.t[0] = target.x - rotated.x;
  T.t[1] = target.y - rotated.y;
  T.t[2] = target.z - rotated.z;
}

PCL_FLASHREG_HD inline PoseF
toSingle(const Pose& T)
{
  PoseF F;
  for (int i = 0; i < 9; ++i)
    F.r[i] = static_cast<float>(T.r[i]);
  for (int i = 0; i < 3; ++i)
    F.t[i] = static_cast<float>(T.t[i]);
  return F;
}

} // namespace pcl_flashreg
