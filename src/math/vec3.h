// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/host_device.h"

namespace pcl_flashreg {

/** \brief Three doubles. */
struct Vec3 {
  double x, y, z;
};

PCL_FLASHREG_HD inline Vec3
operator+(const Vec3& a, const Vec3& b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

PCL_FLASHREG_HD inline Vec3
operator-(const Vec3& a, const Vec3& b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

PCL_FLASHREG_HD inline Vec3
operator*(double s, const Vec3& a)
{
  return {s * a.x, s * a.y, s * a.z};
}

PCL_FLASHREG_HD inline double
dot(const Vec3& a, const Vec3& b)
{
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

PCL_FLASHREG_HD inline Vec3
cross(const Vec3& a, const Vec3& b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

} // namespace pcl_flashreg
