// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Hot loops of normals and point feature histograms, written once over a type V as those
// of simd_kernels.h; the same rules hold. V offers besides: gather(base, indices),
// select(mask, a, b), sqrt, abs, both(mask, mask), firstLanes(n), compress(mask, first,
// values, indices, out), storeTruncated(bins, values).
//
// No product and sum is contracted here, and sums run in NEIGHBOR_BLOCK lanes: these
// results are final, and the same for every V.

#include "simd/simd_kernels.h"
#include "math/pair_features.h"

namespace pcl_flashreg {
namespace cpu {
namespace {

template <typename V>
std::size_t
collectNeighborsSimd(const SurfaceArrays& points,
                     const PointRun* runs,
                     std::size_t run_count,
                     const float query[3],
                     float squared_radius,
                     std::uint32_t* indices,
                     float* squared_distances)
{
  using Float = typename V::Float;
  const Float qx = V::broadcast(query[0]);
  const Float qy = V::broadcast(query[1]);
  const Float qz = V::broadcast(query[2]);
  const Float limit = V::broadcast(squared_radius);
  std::size_t count = 0;
  for (std::size_t run = 0; run < run_count; ++run)
    for (std::size_t i = runs[run].begin; i < runs[run].end; i += V::WIDTH) {
      const Float dx = load<V>(points.x + i) - qx;
      const Float dy = load<V>(points.y + i) - qy;
      const Float dz = load<V>(points.z + i) - qz;
      const Float squared = (dx * dx + dy * dy) + dz * dz;
      auto near = V::less(squared, limit);
      if (runs[run].end - i < V::WIDTH)
        near = V::both(near, V::firstLanes(runs[run].end - i));
      count += V::compress(near,
                           static_cast<std::uint32_t>(i),
                           squared,
                           indices + count,
                           squared_distances + count);
    }
  return count;
}

template <typename V>
void
momentSumsSimd(const SurfaceArrays& points,
               const float query[3],
               const std::uint32_t* indices,
               std::size_t count,
               float sums[9])
{
  using Float = typename V::Float;
  const Float qx = V::broadcast(query[0]);
  const Float qy = V::broadcast(query[1]);
  const Float qz = V::broadcast(query[2]);
  alignas(64) float lanes[9][NEIGHBOR_BLOCK];
  for (std::size_t lane = 0; lane < NEIGHBOR_BLOCK; lane += V::WIDTH) {
    Float sum[9];
    for (Float& s : sum)
      s = V::broadcast(0.0f);
    for (std::size_t n = lane; n < count; n += NEIGHBOR_BLOCK) {
      const Float dx = V::gather(points.x, indices + n) - qx;
      const Float dy = V::gather(points.y, indices + n) - qy;
      const Float dz = V::gather(points.z, indices + n) - qz;
      sum[0] += dx;
      sum[1] += dy;
      sum[2] += dz;
      sum[3] += dx * dx;
      sum[4] += dx * dy;
      sum[5] += dx * dz;
      sum[6] += dy * dy;
      sum[7] += dy * dz;
      sum[8] += dz * dz;
    }
    for (std::size_t k = 0; k < 9; ++k)
      store<V>(lanes[k] + lane, sum[k]);
  }
  for (std::size_t k = 0; k < 9; ++k) {
    for (std::size_t half = NEIGHBOR_BLOCK / 2; half > 0; half /= 2)
      for (std::size_t lane = 0; lane < half; ++lane)
        lanes[k][lane] += lanes[k][lane + half];
    sums[k] = lanes[k][0];
  }
}

/** \brief isLargerAngle() for V::WIDTH pairs. */
template <typename V>
typename V::Mask
largerAngles(typename V::Float a, typename V::Float b)
{
  const auto close = V::less(V::abs(a - b), V::broadcast(NEARLY_EQUAL_COSINES));
  if (V::bits(close) == 0)
    return V::less(a, b);
  float first[V::WIDTH], second[V::WIDTH], larger[V::WIDTH];
  store<V>(first, a);
  store<V>(second, b);
  for (std::size_t lane = 0; lane < V::WIDTH; ++lane)
    larger[lane] = isLargerAngle(first[lane], second[lane]) ? 1.0f : 0.0f;
  return V::less(V::broadcast(0.0f), load<V>(larger));
}

/** \brief Puts halfTurn() where isHalfTurn() says so. */
template <typename V>
typename V::Float
settleHalfTurns(typename V::Float turn_y,
                typename V::Float cosine,
                const typename V::Float v[3],
                typename V::Float v_length,
                const typename V::Float u[3],
                const typename V::Float t[3])
{
  const auto tiny = V::both(V::less(V::abs(turn_y), V::broadcast(NEARLY_HALF_TURN)),
                            V::less(cosine, V::broadcast(0.0f)));
  const std::uint32_t lanes = V::bits(tiny);
  if (lanes == 0)
    return turn_y;
  float turns[V::WIDTH], lengths[V::WIDTH], all[3][3][V::WIDTH];
  store<V>(turns, turn_y);
  store<V>(lengths, v_length);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    store<V>(all[0][axis], v[axis]);
    store<V>(all[1][axis], u[axis]);
    store<V>(all[2][axis], t[axis]);
  }
  for (std::size_t lane = 0; lane < V::WIDTH; ++lane) {
    if (!(lanes >> lane & 1))
      continue;
    float of_lane[3][3];
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        of_lane[k][axis] = all[k][axis][lane];
    turns[lane] = halfTurn(of_lane[0], lengths[lane], of_lane[1], of_lane[2]);
  }
  return load<V>(turns);
}

/** \brief pairBins() for V::WIDTH pairs; lanes that make no pair get bin FPFH_BINS in all
 * three. */
template <typename V>
void
pairBinsSimd(const SurfaceArrays& points,
             const OrientedPoint& query,
             const std::uint32_t* indices,
             std::int32_t* alpha_turn_bins,
             std::int32_t* alpha_bins,
             std::int32_t* phi_bins)
{
  using Float = typename V::Float;
  const Float zero = V::broadcast(0.0f);
  const Float pnx = V::broadcast(query.nx);
  const Float pny = V::broadcast(query.ny);
  const Float pnz = V::broadcast(query.nz);
  const Float qnx = V::gather(points.nx, indices);
  const Float qny = V::gather(points.ny, indices);
  const Float qnz = V::gather(points.nz, indices);
  Float dx = V::gather(points.x, indices) - V::broadcast(query.x);
  Float dy = V::gather(points.y, indices) - V::broadcast(query.y);
  Float dz = V::gather(points.z, indices) - V::broadcast(query.z);

  const auto dot = [](Float ax, Float ay, Float az, Float bx, Float by, Float bz) {
    // Last to first, so that GCC keeps more of the constants in registers.
    const Float y = ay * by, z = az * bz;
    return (ax * bx + z) + y;
  };
  const Float length = V::sqrt(dot(dx, dy, dz, dx, dy, dz));
  const Float along_p = dot(pnx, pny, pnz, dx, dy, dz) / length;
  const Float along_q = dot(qnx, qny, qnz, dx, dy, dz) / length;
  const Float cosine = dot(pnx, pny, pnz, qnx, qny, qnz);
  const auto swap = largerAngles<V>(V::abs(along_p), V::abs(along_q));
  const Float ux = V::select(swap, qnx, pnx), tx = V::select(swap, pnx, qnx);
  const Float uy = V::select(swap, qny, pny), ty = V::select(swap, pny, qny);
  const Float uz = V::select(swap, qnz, pnz), tz = V::select(swap, pnz, qnz);
  dx = V::select(swap, zero - dx, dx);
  dy = V::select(swap, zero - dy, dy);
  dz = V::select(swap, zero - dz, dz);
  const Float phi = V::select(swap, zero - along_q, along_p);
  const Float along_t = V::select(swap, zero - along_p, along_q);

  const Float vx = dy * uz - dz * uy;
  const Float vy = dz * ux - dx * uz;
  const Float vz = dx * uy - dy * ux;
  const Float v_length = V::sqrt(dot(vx, vy, vz, vx, vy, vz));
  const Float v[3] = {vx, vy, vz}, u[3] = {ux, uy, uz}, t[3] = {tx, ty, tz};
  const Float turn =
      settleHalfTurns<V>(along_t - phi * cosine, cosine, v, v_length, u, t);
  const Float turn_y = turn * length;
  const Float turn_x = cosine * v_length;
  const Float alpha = dot(vx, vy, vz, tx, ty, tz) / v_length;
  const auto valid = V::both(V::both(V::less(zero, length), V::less(zero, v_length)),
                             V::less(V::broadcast(-2.0f), alpha));

  constexpr float COSINES[5] = {PCL_FLASHREG_SECTOR_COSINES};
  constexpr float SINES[5] = {PCL_FLASHREG_SECTOR_SINES};
  const Float upper_y = V::abs(turn_y);
  const Float one = V::broadcast(1.0f), five = V::broadcast(5.0f);
  Float sectors = zero;
  for (int k = 0; k < 5; ++k) {
    const Float side =
        upper_y * V::broadcast(COSINES[k]) - turn_x * V::broadcast(SINES[k]);
    sectors += V::select(V::less(zero, side), one, zero);
  }
  const Float turn_bin =
      V::select(V::less(turn_y, zero), five - sectors, five + sectors);
  const Float half_bins = V::broadcast(5.5f), last = V::broadcast(10.0f);
  const auto binOf = [&](Float value) {
    const Float bin = value * half_bins + half_bins;
    return V::select(
        V::less(bin, zero), zero, V::select(V::less(last, bin), last, bin));
  };
  const Float none = V::broadcast(static_cast<float>(FPFH_BINS));
  V::storeTruncated(alpha_turn_bins, V::select(valid, turn_bin, none));
  V::storeTruncated(alpha_bins, V::select(valid, binOf(alpha), none));
  V::storeTruncated(phi_bins, V::select(valid, binOf(phi), none));
}

template <typename V>
void
pairHistogramSimd(const SurfaceArrays& points,
                  std::uint32_t query,
                  const std::uint32_t* indices,
                  std::size_t count,
                  std::uint32_t* histogram)
{
  const OrientedPoint oriented{points.x[query],
                               points.y[query],
                               points.z[query],
                               points.nx[query],
                               points.ny[query],
                               points.nz[query]};
  // Two of each, so that a bin that is hit twice in a row need not wait for itself.
  std::uint32_t counts[2][3][FPFH_BINS + 1] = {};
  alignas(64) std::int32_t bins[3][NEIGHBOR_BLOCK];
  for (std::size_t n = 0; n < count; n += NEIGHBOR_BLOCK) {
    for (std::size_t lane = 0; lane < NEIGHBOR_BLOCK; lane += V::WIDTH)
      pairBinsSimd<V>(points,
                      oriented,
                      indices + n + lane,
                      bins[0] + lane,
                      bins[1] + lane,
                      bins[2] + lane);
    for (std::size_t lane = 0; lane < NEIGHBOR_BLOCK; ++lane)
      for (std::size_t angle = 0; angle < 3; ++angle)
        ++counts[lane % 2][angle][bins[angle][lane]];
  }
  for (std::size_t angle = 0; angle < 3; ++angle)
    for (std::size_t bin = 0; bin < HISTOGRAM_BINS; ++bin)
      histogram[angle * HISTOGRAM_BINS + bin] +=
          counts[0][angle][bin] + counts[1][angle][bin];
}

template <typename V>
void
weightedRowSumSimd(const float* rows,
                   const std::uint32_t* indices,
                   const float* weights,
                   std::size_t count,
                   float* sum)
{
  using Float = typename V::Float;
  // No more registers at a time than every instruction set has.
  constexpr std::size_t ALL = HISTOGRAM_STRIDE / V::WIDTH;
  constexpr std::size_t REGISTERS = ALL < 12 ? ALL : 12;
  for (std::size_t first = 0; first < HISTOGRAM_STRIDE; first += REGISTERS * V::WIDTH) {
    Float sums[REGISTERS];
    for (Float& s : sums)
      s = V::broadcast(0.0f);
    for (std::size_t n = 0; n < count; ++n) {
      const Float weight = V::broadcast(weights[n]);
      const float* row = rows + indices[n] * HISTOGRAM_STRIDE + first;
      for (std::size_t k = 0; k < REGISTERS; ++k)
        sums[k] += weight * loadAligned<V>(row + k * V::WIDTH);
    }
    for (std::size_t k = 0; k < REGISTERS; ++k)
      store<V>(sum + first + k * V::WIDTH, sums[k]);
  }
}

} // namespace
} // namespace cpu
} // namespace pcl_flashreg
