// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <array>
#include <chrono>

namespace pcl_flashreg::align {

/** \brief Wall-clock milliseconds of a run, step by step, from the first file to the pose.
 * 0 for what was not done. */
struct Times {
  /** \brief Files to coordinates in double precision. */
  double reading = 0;
  /** \brief Choosing and starting the backend. */
  double setup = 0;
  /** \brief Estimating the resolution, without --leaf. */
  double resolution = 0;
  double voxel_grid = 0;
  double normals = 0;
  double features = 0;
  double matching = 0;
  /** \brief From correspondences to hypotheses. */
  double pose = 0;
  double cloud_check = 0;
  /** \brief Between the formats of files, PCL and the estimator. */
  double copying = 0;
  /** \brief All of them. */
  double total = 0;
};

/** \brief A step's name for people, and where its time stands. */
struct Step {
  const char* name;
  double Times::*milliseconds;
};

/** \brief All steps in their order; their times add up to the total. */
inline constexpr std::array<Step, 10> STEPS = {{
    {"reading", &Times::reading},
    {"set-up", &Times::setup},
    {"resolution", &Times::resolution},
    {"voxel grid", &Times::voxel_grid},
    {"normals", &Times::normals},
    {"features", &Times::features},
    {"matching", &Times::matching},
    {"pose", &Times::pose},
    {"cloud check", &Times::cloud_check},
    {"copying", &Times::copying},
}};

/** \brief Books all time since its construction under some step. */
class StepClock {
public:
  /** \brief What has passed since the last call, and was not booked yet, was this step. */
  void
  finish(double Times::*step)
  {
    const Clock::time_point now = Clock::now();
    const double elapsed = milliseconds(now - last_) - booked_;
    last_ = now;
    booked_ = 0;
    times_.*step += elapsed;
    times_.total = milliseconds(now - start_);
  }

  /** \brief Of what has passed since finish(), this much was this step, as somebody else
   * has measured. */
  void
  book(double Times::*step, double elapsed_ms)
  {
    times_.*step += elapsed_ms;
    booked_ += elapsed_ms;
  }

  const Times&
  times() const
  {
    return times_;
  }

private:
  using Clock = std::chrono::steady_clock;

  static double
  milliseconds(Clock::duration elapsed)
  {
    return std::chrono::duration<double, std::milli>(elapsed).count();
  }

  Times times_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
  double booked_ = 0;
};

} // namespace pcl_flashreg::align
