// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <memory>

namespace pcl_flashreg {

/** \brief Threads that help their owner through loops.
 *
 * The caller works too, and waits only for helpers that are in the middle of a task: a
 * helper that the system has not scheduled yet is not waited for. On a machine with busy
 * cores this is what keeps seven short loops from costing seven time slices, which is what
 * they cost with a barrier that every thread of a team has to reach. Helpers sleep between
 * loops.
 *
 * After a fork() between two loops, the child may use and destroy its copy, too: it gets
 * helpers of its own with its first loop.
 */
class ThreadPool {
public:
  /** \param[in] threads the caller included; 0 takes the number of processors */
  explicit ThreadPool(unsigned threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool&
  operator=(const ThreadPool&) = delete;

  /** \brief The caller included, >= 1. */
  std::size_t
  size() const
  {
    return size_;
  }

  /** \brief Calls task(i, thread) for every i in [0, count), in any order, thread in
   * [0, size()). Tasks must not depend on each other, and what they write must not depend
   * on `thread`, which only names scratch memory. An exception of a task ends up with the
   * caller; tasks that had not begun are then skipped. Not to be called from a task. */
  template <typename Task>
  void
  forEach(std::size_t count, const Task& task)
  {
    if (size_ == 1 || count <= 1) {
      for (std::size_t i = 0; i < count; ++i)
        task(i, std::size_t{0});
      return;
    }
    run([](const void* opaque,
           std::size_t i,
           std::size_t thread) { (*static_cast<const Task*>(opaque))(i, thread); },
        &task,
        count);
  }

private:
  using Call = void (*)(const void* task, std::size_t i, std::size_t thread);
  class Team;

  void
  run(Call call, const void* task, std::size_t count);
  void
  leaveForkedTeam();

  const std::size_t size_;
  /** \brief The helpers and what they share with the caller; null until the first loop. */
  std::unique_ptr<Team> team_;
};

} // namespace pcl_flashreg
