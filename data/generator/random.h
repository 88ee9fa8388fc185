// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstdint>

namespace pcl_flashreg::generator {

/** \brief A small random generator (SplitMix64) whose numbers are the same on every
 * platform, which the standard library's distributions don't promise. Draw one number a
 * statement: in which order a call's arguments are evaluated is up to the compiler. */
class Random {
public:
  /** \param[in] seed what the user chose
   * \param[in] stream tells uses of one seed apart (scene, first scan, second scan) */
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(seed * 0x9E3779B97F4A7C15u + (stream + 1) * 0xD1B54A32D192ED03u)
  {
    next();
  }

  /** \brief Uniform in [0, 1). */
  double
  uniform()
  {
    return static_cast<double>(next() >> 11) * 0x1.0p-53;
  }

  /** \brief Uniform in [low, high). */
  double
  uniform(double low, double high)
  {
    return low + (high - low) * uniform();
  }

  /** \brief Close to standard normal: a sum of twelve uniforms needs no library
   * function whose last bit differs between platforms, and never exceeds six sigma. */
  double
  normal()
  {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i)
      sum += uniform();
    return sum;
  }

private:
  std::uint64_t
  next()
  {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

} // namespace pcl_flashreg::generator
