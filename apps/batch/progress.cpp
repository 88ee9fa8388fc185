// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "progress.h"

#include <unistd.h>

#include <cstdio>

namespace pcl_flashreg::batch {
namespace {

constexpr std::size_t WIDTH = 30;

std::string
clockText(double seconds)
{
  const auto all = static_cast<unsigned long>(seconds + 0.5);
  char text[48];
  if (all < 3600)
    std::snprintf(text, sizeof(text), "%lu:%02lu", all / 60, all % 60);
  else
    std::snprintf(
        text, sizeof(text), "%lu:%02lu:%02lu", all / 3600, all / 60 % 60, all % 60);
  return text;
}

} // namespace

std::string
progressText(std::size_t done,
             std::size_t total,
             double seconds,
             bool with_bar,
             const std::string& things)
{
  std::string text;
  if (with_bar) {
    const std::size_t filled = total == 0 ? WIDTH : WIDTH * done / total;
    text = "[" + std::string(filled, '#') + std::string(WIDTH - filled, '.') + "]  ";
  }
  text += std::to_string(done) + "/" + std::to_string(total) + ' ' + things;
  if (done == 0 || seconds <= 0)
    return text;
  const double rate = static_cast<double>(done) / seconds;
  char of_rate[48];
  std::snprintf(of_rate, sizeof(of_rate), "  %.3g/s  ", rate);
  return text + of_rate + clockText(static_cast<double>(total - done) / rate) + " left";
}

Progress::Progress(std::size_t total, const std::string& things, bool quiet)
    : total_(total),
      things_(things),
      quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO) == 1)
{
}

Progress::~Progress()
{
  if (!quiet_ && terminal_)
    std::fputc('\n', stderr);
}

void
Progress::step()
{
  ++done_;
  const auto now = Clock::now();
  const auto pause =
      terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(30000);
  if (!quiet_ && (now - printed_ >= pause || done_ == total_))
    print(now);
}

void
Progress::print(Clock::time_point now)
{
  printed_ = now;
  const std::string text =
      progressText(done_,
                   total_,
                   std::chrono::duration<double>(now - start_).count(),
                   terminal_,
                   things_);
  // The terminal's line is cleared to its end: the text before may have been longer.
  std::fprintf(stderr, terminal_ ? "\r%s\x1b[K" : "%s\n", text.c_str());
}

} // namespace pcl_flashreg::batch
