// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan_store.h"

#include "../io/error.h"

#include <algorithm>
#include <filesystem>

namespace fs = std::filesystem;

namespace pcl_flashreg::map {
namespace {

/** \brief Threads work on pairs of one target at a time, mostly: a few are enough. */
constexpr std::size_t RECENT = 32;

} // namespace

ScanStore::ScanStore(std::string folder) : folder_(std::move(folder))
{
  if (folder_.empty())
    return;
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!fs::is_directory(folder_))
    throw io::InputError(folder_ + ": cannot be made: " + error.message());
}

std::string
ScanStore::pathOf(const std::string& key) const
{
  return (fs::path(folder_) / (key + ".scan")).string();
}

std::optional<Scan>
ScanStore::earlier(const std::string& key) const
{
  if (folder_.empty() || !fs::exists(pathOf(key)))
    return std::nullopt;
  try {
    return Scan::load(pathOf(key));
  }
  catch (const ScanFileError&) {
    return std::nullopt;
  }
}

void
ScanStore::add(const std::string& key, const Scan& scan, bool is_kept)
{
  if (folder_.empty())
    scans_.push_back(scan);
  else {
    if (!is_kept)
      scan.save(pathOf(key));
    paths_.push_back(pathOf(key));
  }
  ++count_;
}

Scan
ScanStore::get(std::size_t number) const
{
  if (folder_.empty())
    return scans_.at(number);
  {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(recent_.begin(), recent_.end(), [&](const auto& one) {
          return one.first == number;
        });
    if (found != recent_.end()) {
      recent_.splice(recent_.begin(), recent_, found);
      return found->second;
    }
  }
  return remember(number, Scan::load(paths_.at(number)));
}

Scan
ScanStore::remember(std::size_t number, const Scan& scan) const
{
  const std::lock_guard lock(mutex_);
  recent_.emplace_front(number, scan);
  if (recent_.size() > RECENT)
    recent_.pop_back();
  return scan;
}

} // namespace pcl_flashreg::map
