// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "support/thread_pool.h"

#include <algorithm>
#include <system_error>

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

ThreadPool::ThreadPool(unsigned threads)
    : size_(std::clamp(threads != 0 ? threads : std::thread::hardware_concurrency(),
                       1u,
                       MOST_THREADS))
{
}

ThreadPool::~ThreadPool()
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

/** \brief With the first loop, so that an object that is never used costs nothing. Where
 * the system gives no more threads, there are fewer helpers. */
void
ThreadPool::startHelpers()
{
  helpers_.reserve(size_ - 1);
  for (std::size_t thread = 1; thread < size_; ++thread) {
    try {
      helpers_.emplace_back([this, thread] { help(thread); });
    }
    catch (const std::system_error&) {
      return;
    }
  }
}

void
ThreadPool::takeTasks(std::size_t thread) noexcept
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
ThreadPool::run(Call call, const void* task, std::size_t count)
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
ThreadPool::help(std::size_t thread)
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

} // namespace pcl_flashreg
