// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <chrono>

namespace pcl_flashreg {

/** \brief Splits the wall-clock time of one call among its stages. */
class StageClock {
public:
  explicit StageClock(StageTimings& timings_ms)
      : timings_ms_(timings_ms), start_(Clock::now()), last_(start_)
  {
  }

  /** \brief Books the time since the last call under this stage. */
  void
  finish(double StageTimings::*stage)
  {
    const Clock::time_point now = Clock::now();
    timings_ms_.*stage += milliseconds(now - last_);
    last_ = now;
  }

  /** \brief Books time that somebody else has measured, and starts anew. */
  void
  book(double StageTimings::*stage, double elapsed_ms)
  {
    timings_ms_.*stage += elapsed_ms;
    last_ = Clock::now();
  }

  void
  finishAll()
  {
    timings_ms_.total = milliseconds(Clock::now() - start_);
  }

private:
  using Clock = std::chrono::steady_clock;

  static double
  milliseconds(Clock::duration elapsed)
  {
    return std::chrono::duration<double, std::milli>(elapsed).count();
  }

  StageTimings& timings_ms_;
  Clock::time_point start_, last_;
};

} // namespace pcl_flashreg
