// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <deque>

namespace pcl_flashreg {

/** \brief Workers with a thread of their own each, for problems side by side; they are made
 * when they are wanted, and kept.
 * \tparam Worker what another one is made like, with a number of threads */
template <typename Worker>
class SideBySide {
public:
  /** \param[in] like what they are; outlives this, as all that follows
   * \param[in] pool whose threads they have
   * \param[in] most how many there may be */
  SideBySide(const Worker& like, ThreadPool& pool, std::size_t most)
      : like_(like), pool_(pool), most_(std::min(most, pool.size()))
  {
  }

  /** \brief Calls work(worker, i) for every i in [0, count), in any order. An exception ends
   * up with the caller; what had not begun is then skipped. */
  template <typename Work>
  void
  forEach(std::size_t count, const Work& work)
  {
    const std::size_t wanted = std::min(count, most_);
    while (workers_.size() < wanted)
      workers_.emplace_back(like_, 1u);
    // Who takes what depends on who is faster; no result does.
    std::atomic<std::size_t> next{0};
    pool_.forEach(wanted, [&](std::size_t worker, std::size_t) {
      try {
        for (std::size_t i = next++; i < count; i = next++)
          work(workers_[worker], i);
      }
      catch (...) {
        next = count;
        throw;
      }
    });
  }

private:
  const Worker& like_;
  ThreadPool& pool_;
  std::size_t most_;
  std::deque<Worker> workers_;
};

} // namespace pcl_flashreg
