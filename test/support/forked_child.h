// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pcl_flashreg {
namespace test {

/** \brief Whether the thread sanitizer is at work, which refuses threads in a child of a
 * process that has some. */
constexpr bool
threadSanitizer()
{
#if defined(__SANITIZE_THREAD__)
  return true;
#elif defined(__has_feature)
  return __has_feature(thread_sanitizer);
#else
  return false;
#endif
}

constexpr bool
addressSanitizer()
{
#if defined(__SANITIZE_ADDRESS__)
  return true;
#elif defined(__has_feature)
  return __has_feature(address_sanitizer);
#else
  return false;
#endif
}

/** \brief Whether all threads but the calling one sleep. */
inline bool
othersSleep()
{
  const std::string own = std::to_string(::syscall(SYS_gettid));
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string line;
    std::ifstream stat(task.path() / "stat");
    std::getline(stat, line);
    const std::size_t state = line.rfind(") ");
    if (task.path().filename() != own && state != std::string::npos &&
        line[state + 2] != 'S')
      return false;
  }
  return true;
}

inline void
waitUntilOthersSleep()
{
  while (!othersSleep())
    std::this_thread::yield();
}

/** \brief Calls something in a child of a fork(), which then ends by exit(), its static
 * objects destroyed.
 * \param[in] call returns whether all is well
 * \return "good", or else how the child ended; one that hangs is ended by a signal
 */
template <typename Call>
std::string
endOfChild(const Call& call)
{
  // A thread that begins or ends takes locks of the sanitizer's, which the child would
  // find taken.
  if (addressSanitizer())
    waitUntilOthersSleep();
  std::fflush(nullptr);
  const ::pid_t child = ::fork();
  if (child < 0)
    return "no fork";
  if (child == 0) {
    ::alarm(120);
    bool good = false;
    try {
      good = call();
    }
    catch (const std::exception& error) {
      std::fprintf(stderr, "in the child: %s\n", error.what());
    }
    std::exit(good ? 0 : 1);
  }
  int status = 0;
  if (::waitpid(child, &status, 0) != child)
    return "lost";
  if (WIFSIGNALED(status))
    return "signal " + std::to_string(WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "good"
                                  : "exit " + std::to_string(WEXITSTATUS(status));
}

} // namespace test
} // namespace pcl_flashreg
