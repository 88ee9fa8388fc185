// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

namespace pcl_flashreg {
namespace cuda {

/** \brief For tests and measurements: how the kernels are launched. Results do not depend
 * on it. */
struct Options {
  /** \brief Steps that wait for each other share a kernel, with barriers over the whole
   * grid, where the device can: bounded stage 2 with stage 3, and stage 7. */
  bool fused = true;
  /** \brief Marks in the stream for the time of every stage; without them, StageTimings
   * has the total alone. */
  bool stage_timings = true;
  /** \brief Mean degree of the first-order graph that the exact form of stage 2 has room
   * for at first. A denser graph costs a second attempt, once; memory for this one costs
   * less than the bit matrix at the usual sizes. */
  unsigned expected_degree = 128;
  /** \brief Every problem is the first one: its points are copied in with the first call
   * and stay, as those do that another step on the device has left there. */
  bool resident_points = false;
  /** \brief What memory is kept for: the bit matrix, the lists of stage 2, the poses that
   * stage 7 refines side by side. A comparison that does these stages in another way runs
   * without. */
  bool bits = true, lists = true, candidates = true;
};

} // namespace cuda
} // namespace pcl_flashreg
