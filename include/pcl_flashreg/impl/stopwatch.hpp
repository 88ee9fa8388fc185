// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <chrono>

namespace pcl_flashreg {
namespace detail {

/** \brief Milliseconds since construction. */
class Stopwatch {
public:
  double
  milliseconds() const
  {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

} // namespace detail
} // namespace pcl_flashreg
