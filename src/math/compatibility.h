// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/host_device.h"

#include <cmath>

namespace pcl_flashreg {

/** \brief A correspondence, centred: source and target point. */
struct PointPair {
  float sx, sy, sz;
  float tx, ty, tz;
};

/** \brief Euclidean length, Eq. (dis), rounded once an operation, in this order.
 *
 * This and compatible() define the first-order graph to the last bit: whoever evaluates
 * them must round every operation to IEEE single precision and must not contract a
 * product and a sum into one operation.
 */
PCL_FLASHREG_HD inline float
exactLength(float dx, float dy, float dz)
{
  return sqrtf((dx * dx + dy * dy) + dz * dz);
}

/** \brief The edge test, Eq. (fog), for two different correspondences. False if a
 * coordinate is not a number.
 * \param[in] length_tolerance tau
 * \param[in] min_length_sum r
 */
PCL_FLASHREG_HD inline bool
compatible(const PointPair& a,
           const PointPair& b,
           float length_tolerance,
           float min_length_sum)
{
  const float source_length = exactLength(a.sx - b.sx, a.sy - b.sy, a.sz - b.sz);
  const float target_length = exactLength(a.tx - b.tx, a.ty - b.ty, a.tz - b.tz);
  return fabsf(source_length - target_length) < length_tolerance &&
         source_length + target_length > min_length_sum;
}

/** \brief What an upright motion asks of an edge besides compatible(): the difference in
 * height is kept, but for the tolerance and what the largest tilt makes of the source's
 * distance. Rounded once an operation, too.
 * \param[in] rise_a, rise_b how much higher the target point of either is than its source
 * point, each above the centre of its side
 * \param[in] squared_slope see Upright
 */
PCL_FLASHREG_HD inline bool
keepsHeight(const PointPair& a,
            const PointPair& b,
            float rise_a,
            float rise_b,
            float length_tolerance,
            float squared_slope)
{
  const float dx = a.sx - b.sx, dy = a.sy - b.sy, dz = a.sz - b.sz;
  const float squared_length = (dx * dx + dy * dy) + dz * dz;
  const float excess = fabsf(rise_a - rise_b) - length_tolerance;
  return excess < 0 || excess * excess < squared_slope * squared_length;
}

} // namespace pcl_flashreg
