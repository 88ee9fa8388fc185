// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "call.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

namespace pcl_flashreg::python {
namespace {

class Cancelled : public std::exception {
public:
  const char*
  what() const noexcept override
  {
    return "nobody waits for the result";
  }
};

/** \brief How long a signal waits at most for Python's handler. */
constexpr std::chrono::milliseconds PATIENCE{20};

bool
onMainThread()
{
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("get_ident")().equal(
      threading.attr("main_thread")().attr("ident"));
}

/** \brief What is under way in all threads; looked at with Python's lock alone. */
struct Running {
  std::set<Cancellation*> computations;
  bool python_ends = false;
};

Running&
running()
{
  static Running all;
  return all;
}

[[noreturn]] void
exitThread()
{
  PyErr_SetNone(PyExc_SystemExit);
  throw py::error_already_set();
}

/** \brief A computation, from before it gives Python's lock away until it has it again. */
class UnderWay {
public:
  UnderWay()
  {
    if (running().python_ends)
      exitThread();
    running().computations.insert(&cancellation);
  }
  ~UnderWay()
  {
    running().computations.erase(&cancellation);
  }
  UnderWay(const UnderWay&) = delete;
  UnderWay&
  operator=(const UnderWay&) = delete;

  Cancellation cancellation;
};

void
endAll()
{
  running().python_ends = true;
  for (Cancellation* computation : running().computations)
    computation->request();
  while (!running().computations.empty()) {
    const py::gil_scoped_release others_go_on;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/** \brief Work in a thread of its own, which nobody gets rid of before it is done. */
class Worker {
public:
  Worker(const std::function<void(const Cancellation&)>& work,
         const Cancellation& cancellation)
      : thread_([this, &work, &cancellation] {
          try {
            work(cancellation);
          }
          catch (...) {
            error_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          done_ = true;
          // Within the lock: whoever waits may destroy this right after it.
          finished_.notify_one();
        })
  {
  }
  ~Worker()
  {
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker&
  operator=(const Worker&) = delete;

  /** \brief Whether the work was done before the patience was at an end. */
  bool
  wait()
  {
    std::unique_lock lock(mutex_);
    return finished_.wait_for(lock, PATIENCE, [&] { return done_; });
  }

  /** \brief What the work threw, once it is done. */
  std::exception_ptr
  error() const
  {
    return error_;
  }

private:
  std::mutex mutex_;
  std::condition_variable finished_;
  bool done_ = false;
  std::exception_ptr error_;
  std::thread thread_;
};

/** \brief Waits for the worker, and looks after signals.
 * \return the exception that a signal's handler raised */
std::optional<py::error_already_set>
waitFor(Worker& worker, Cancellation& cancellation)
{
  std::optional<py::error_already_set> interruption;
  const py::gil_scoped_release others_go_on;
  while (!worker.wait()) {
    if (interruption)
      continue;
    const py::gil_scoped_acquire python;
    if (PyErr_CheckSignals() != 0) {
      interruption.emplace();
      cancellation.request();
    }
  }
  return interruption;
}

} // namespace

void
Cancellation::check() const
{
  if (requested_)
    throw Cancelled();
}

void
computeInterruptibly(const std::function<void(const Cancellation&)>& work)
{
  UnderWay under_way;
  Cancellation& cancellation = under_way.cancellation;
  try {
    if (!onMainThread()) {
      const py::gil_scoped_release others_go_on;
      return work(cancellation);
    }
    Worker worker(work, cancellation);
    if (const auto interruption = waitFor(worker, cancellation))
      throw *interruption;
    if (worker.error())
      std::rethrow_exception(worker.error());
  }
  catch (const Cancelled&) {
    exitThread();
  }
}

void
endBeforePython()
{
  py::module_::import("atexit").attr("register")(py::cpp_function(&endAll));
  // Of the threads of a process its child has the one that forked alone.
  py::module_::import("os").attr("register_at_fork")(
      py::arg("after_in_child") =
          py::cpp_function([] { running().computations.clear(); }));
}

} // namespace pcl_flashreg::python
