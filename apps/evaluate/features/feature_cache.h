// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "descriptors.h"
#include "stored_scan.h"

#include <cstddef>
#include <optional>
#include <string>

namespace pcl_flashreg::evaluate {

/** \brief Features on disk, one file a cloud and setting.
 *
 * A file's name is made from the contents of the cloud's file, the voxel size, the descriptors, and what the
 * front end makes of a small made cloud: whatever changes, even in the code, leads to
 * another name. Files are written under another name and renamed, so that a crash leaves
 * none that is half done, and hold scans as Scan::serialize() writes them: one that is
 * damaged counts as absent.
 */
class FeatureCache {
public:
  /** \param[in] bin_fields how raw .bin files are read
   * \throws io::InputError if the folder is not there and cannot be made */
  FeatureCache(std::string folder,
               double leaf,
               Descriptors descriptors,
               std::size_t bin_fields);

  /** \brief Where the features of a cloud's file belong.
   * \throws io::InputError if the cloud cannot be read
   */
  std::string
  keyOf(const std::string& cloud_path, ScanContent content) const;

  /** \brief Nothing if there is no file of that key, or if it is not as it was written. */
  std::optional<StoredScan>
  load(const std::string& key) const;

  /** \throws io::InputError if it cannot be written */
  void
  save(const std::string& key, const StoredScan& scan) const;

private:
  std::string folder_;
  std::string settings_;
  std::size_t bin_fields_;
};

} // namespace pcl_flashreg::evaluate
