// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>

namespace pcl_flashreg::batch {

/** \brief The processes that share the work: one, or as many as mpirun started. A program
 * that was not started by mpirun (srun ...) does not touch MPI at all. */
class Ranks {
public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks&
  operator=(const Ranks&) = delete;

  /** \brief From 0. */
  std::size_t
  rank() const
  {
    return rank_;
  }

  std::size_t
  size() const
  {
    return size_;
  }

  /** \brief Returns when all have called it. */
  void
  wait() const;

  /** \brief Ends this process, and the others with it.
   * \return the status, if there are no others
   */
  int
  abort(int status) const;

private:
  std::size_t rank_ = 0;
  std::size_t size_ = 1;
  bool started_ = false;
};

} // namespace pcl_flashreg::batch
