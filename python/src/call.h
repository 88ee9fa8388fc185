// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// How Python waits for the core.

#include <pybind11/pybind11.h>

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace pcl_flashreg::python {

namespace py = pybind11;

/** \brief What a computation asks, where it may be left, whether anybody waits for it still. */
class Cancellation {
public:
  void
  request()
  {
    requested_ = true;
  }

  /** \throws an exception that only ends the computation, if nobody does */
  void
  check() const;

private:
  std::atomic<bool> requested_{false};
};

/** \brief Runs work that touches nothing of Python's while other threads of Python go on.
 *
 * Signals reach Python in its main thread alone. Called there, the work has a thread of its
 * own, while this one looks after signals: once a handler raises an exception, as that of
 * Ctrl-C does, the work is asked to end, is waited for, since it uses what the caller owns,
 * and the exception goes on.
 * \throws SystemExit once Python is about to end */
void
computeInterruptibly(const std::function<void(const Cancellation&)>& work);

/** \brief The same for work that has a result. */
template <typename Work>
auto
compute(const Work& work)
{
  std::optional<decltype(work(std::declval<const Cancellation&>()))> result;
  computeInterruptibly(
      [&](const Cancellation& cancellation) { result.emplace(work(cancellation)); });
  return std::move(*result);
}

/** \brief Sees to it that computations of all threads end before Python does, which then ends
 * whichever thread asks for its lock, in the middle of C++. */
void
endBeforePython();

/** \brief Objects of the core work for one thread at a time; Python's threads would notice by
 * a crash. */
class Turn {
public:
  /** \throws RuntimeError if the object is in a call */
  Turn(std::atomic<bool>& busy, const char* name) : busy_(busy)
  {
    if (busy_.exchange(true))
      throw std::runtime_error(std::string("this ") + name +
                               " is in a call of another thread: make one a thread");
  }
  ~Turn()
  {
    busy_ = false;
  }
  Turn(const Turn&) = delete;
  Turn&
  operator=(const Turn&) = delete;

private:
  std::atomic<bool>& busy_;
};

} // namespace pcl_flashreg::python
