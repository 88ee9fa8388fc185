// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/export.h>
#include <pcl_flashreg/scan.h>

#include <cstddef>
#include <memory>
#include <string>

namespace pcl_flashreg {

/** \brief A Scan made ready for other, smaller ones to be found in it: a map. Beside the scan
 * it has its descriptors at two resolutions in trees, and its surface in a grid, all of which
 * a registration would make over again.
 *
 * What is found in it is what is found in its scan, to the last bit. Made by
 * PairRegistration::makeIndex(). Never changes: copies share their memory, and any number of
 * threads may use it at a time.
 */
class PCL_FLASHREG_EXPORT ScanIndex {
public:
  /** \brief Of an empty scan. */
  ScanIndex();
  // No moves: a copy costs no more, and leaves nobody without data.
  ScanIndex(const ScanIndex&) = default;
  ScanIndex&
  operator=(const ScanIndex&) = default;

  const Scan&
  scan() const;

  /** \brief Of memory, or of the file. */
  std::size_t
  bytes() const;

  /** \brief Writes it to a file, under another name first, so that a crash leaves none that is
   * half written.
   * \throws ScanFileError with the path and the system's reason
   */
  void
  save(const std::string& path) const;

  /** \brief Opens what save() wrote, in milliseconds whatever its size: the file is mapped and
   * read where it is looked at. While the index or a copy of its scan is there the file may be
   * replaced or removed, but nobody may write into it.
   * \param[in] verify whether to read all of it at once and compare its checksum; if not,
   * damage may lead to other results, to nothing worse
   * \throws ScanFileError with the path, that says whether it is no index, of another
   * version, incomplete or damaged, or the system's reason
   */
  static ScanIndex
  open(const std::string& path, bool verify = false);

  /** \brief Known to the library alone. */
  struct Data;
  explicit ScanIndex(std::shared_ptr<const Data> data);

  const Data&
  data() const
  {
    return *data_;
  }

private:
  std::shared_ptr<const Data> data_;
};

} // namespace pcl_flashreg
