// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "support/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <unistd.h>

namespace pcl_flashreg {

namespace {

constexpr unsigned MOST_THREADS = 1024;

/** \brief Looks at a condition for some 20 microseconds, about what it costs to put a
 * thread to sleep and wake it, before giving up. */
template <typename Condition>
bool
spinUntil(const Condition& condition)
{
  for (int i = 0; i < 500; ++i) {
    if (condition())
      return true;
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  return condition();
}

} // namespace

class ThreadPool::Team {
public:
  /** \param[in] size the caller included */
  explicit Team(std::size_t size) : size_(size)
  {
    helpers_.reserve(size - 1);
  }
  ~Team();

  void
  run(Call call, const void* task, std::size_t count);

  /** \brief Whether this is a copy that a fork() left in a child: its threads are in
   * the parent, and a lock that one of them held will never be released. */
  bool
  isForked() const
  {
    return process_ != ::getpid();
  }

  /** \brief For a list of teams that are given up. */
  Team* next_given_up = nullptr;

private:
  void
  startHelpers();
  void
  help(std::size_t thread);
  void
  takeTasks(std::size_t thread) noexcept;

  const std::size_t size_;
  const ::pid_t process_ = ::getpid();
  std::vector<std::thread> helpers_;

  // The loop at hand. Set by the caller while no helper is in it; a helper enters and
  // leaves under the mutex.
  Call call_ = nullptr;
  const void* task_ = nullptr;
  std::size_t count_ = 0;
  std::atomic<std::size_t> next_{0};
  std::exception_ptr failure_;

  std::mutex mutex_;
  std::condition_variable wake_, left_;
  /** \brief Counts loops, so that a helper sees that there is a new one. */
  std::atomic<std::uint64_t> loop_{0};
  bool open_ = false;
  bool stop_ = false;
  std::atomic<std::size_t> inside_{0};
};

ThreadPool::Team::~Team()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
    ++loop_;
  }
  wake_.notify_all();
  for (std::thread& helper : helpers_)
    helper.join();
}

/** \brief Where the system gives no more threads, or no memory for one, there are fewer
 * helpers. */
void
ThreadPool::Team::startHelpers()
{
  for (std::size_t thread = 1; thread < size_; ++thread) {
    try {
      helpers_.emplace_back([this, thread] { help(thread); });
    }
    catch (const std::exception&) {
      return;
    }
  }
}

void
ThreadPool::Team::takeTasks(std::size_t thread) noexcept
{
  for (std::size_t i = next_.fetch_add(1); i < count_; i = next_.fetch_add(1)) {
    try {
      call_(task_, i, thread);
    }
    catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!failure_)
        failure_ = std::current_exception();
      next_.store(count_);
    }
  }
}

void
ThreadPool::Team::run(Call call, const void* task, std::size_t count)
{
  if (helpers_.empty())
    startHelpers();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    call_ = call;
    task_ = task;
    count_ = count;
    next_.store(0);
    failure_ = nullptr;
    open_ = true;
    ++loop_;
  }
  wake_.notify_all();
  takeTasks(0);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    open_ = false;
  }
  const auto all_left = [this] { return inside_.load() == 0; };
  if (!spinUntil(all_left)) {
    std::unique_lock<std::mutex> lock(mutex_);
    left_.wait(lock, all_left);
  }
  if (failure_)
    std::rethrow_exception(failure_);
}

void
ThreadPool::Team::help(std::size_t thread)
{
  std::uint64_t seen = 0;
  for (;;) {
    const auto news = [this, &seen] { return loop_.load() != seen; };
    spinUntil(news);
    {
      std::unique_lock<std::mutex> lock(mutex_);
      wake_.wait(lock, news);
      if (stop_)
        return;
      seen = loop_.load();
      if (!open_)
        continue;
      ++inside_;
    }
    takeTasks(thread);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      --inside_;
    }
    left_.notify_one();
  }
}

ThreadPool::ThreadPool(unsigned threads)
    : size_(std::clamp(threads != 0 ? threads : std::thread::hardware_concurrency(),
                       1u,
                       MOST_THREADS))
{
}

ThreadPool::~ThreadPool()
{
  leaveForkedTeam();
}

/** \brief A child gives its copy of the parent's team up: neither can its threads be
 * joined nor its locks be destroyed. It is not freed, but kept where a leak checker
 * finds it: once a pool that the parent had used. */
void
ThreadPool::leaveForkedTeam()
{
  static std::atomic<Team*> given_up{nullptr};
  if (!team_ || !team_->isForked())
    return;
  Team* const team = team_.release();
  team->next_given_up = given_up.load();
  while (!given_up.compare_exchange_weak(team->next_given_up, team)) {
  }
}

/** \brief Threads are there from the first loop on, so that an object that is never used
 * costs nothing. */
void
ThreadPool::run(Call call, const void* task, std::size_t count)
{
  leaveForkedTeam();
  if (!team_)
    team_ = std::make_unique<Team>(size_);
  team_->run(call, task, count);
}

} // namespace pcl_flashreg
