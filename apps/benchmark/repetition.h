// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/impl/stopwatch.hpp>

namespace pcl_flashreg::benchmark {

/** \brief How often a call is repeated: up to `runs` times, and no longer than `seconds`
 * where FEWEST_RUNS take less. A call of a hundred milliseconds needs no two hundred runs. */
struct Repetition {
  static constexpr int FEWEST_RUNS = 10;

  int runs = 200;
  double seconds = 2;

  bool
  isOver(int done, const detail::Stopwatch& stopwatch) const
  {
    return done >= runs ||
           (done >= FEWEST_RUNS && stopwatch.milliseconds() > 1e3 * seconds);
  }
};

} // namespace pcl_flashreg::benchmark
