// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace pcl_flashreg::batch {

/** \brief "[#####.....]  40/100 pairs  12.5/s  0:05 left", or without the bar. */
std::string
progressText(std::size_t done,
             std::size_t total,
             double seconds,
             bool with_bar,
             const std::string& things);

/** \brief Tells on standard error how far a run is: a bar on a terminal, a line every half
 * minute elsewhere. */
class Progress {
public:
  /** \param[in] total how many to do
   * \param[in] things what is counted: "pairs"
   * \param[in] quiet say nothing
   */
  Progress(std::size_t total, const std::string& things, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress&
  operator=(const Progress&) = delete;

  /** \brief One more is done. */
  void
  step();

private:
  using Clock = std::chrono::steady_clock;

  void
  print(Clock::time_point now);

  std::size_t total_;
  std::string things_;
  std::size_t done_ = 0;
  bool quiet_;
  bool terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point printed_ = start_;
};

} // namespace pcl_flashreg::batch
