// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/scan.h>

#include <cstddef>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::map {

/** \brief Scans by their numbers: in memory, or as files in a folder, of which the few that
 * were asked for last are in memory, too. A folder keeps them for later runs. */
class ScanStore {
public:
  /** \param[in] folder made if it is not there; empty for memory
   * \throws io::InputError if it can't be made */
  explicit ScanStore(std::string folder);

  /** \brief The scan that an earlier run left in the folder; nothing if there is none, or
   * none that is whole. */
  std::optional<Scan>
  earlier(const std::string& key) const;

  /** \brief The scan with the next number.
   * \param[in] key names it in the folder, and changes with all that it is made from
   * \param[in] is_kept whether it is what earlier() gave
   * \throws ScanFileError if it can't be written */
  void
  add(const std::string& key, const Scan& scan, bool is_kept);

  /** \brief Any number of threads may call it at a time.
   * \throws ScanFileError if it can't be read again */
  Scan
  get(std::size_t number) const;

  std::size_t
  size() const
  {
    return count_;
  }

private:
  using Recent = std::list<std::pair<std::size_t, Scan>>;

  std::string
  pathOf(const std::string& key) const;
  Scan
  remember(std::size_t number, const Scan& scan) const;

  std::string folder_;
  std::size_t count_ = 0;
  /** \brief All, without a folder. */
  std::vector<Scan> scans_;
  /** \brief With one: their files, and the scans that were asked for last, newest first. */
  std::vector<std::string> paths_;
  mutable Recent recent_;
  mutable std::mutex mutex_;
};

} // namespace pcl_flashreg::map
