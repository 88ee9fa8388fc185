// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/pair_registration.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_flashreg::localize {

/** \brief How files become scans. */
struct ScanSettings {
  double spacing = 0;
  std::size_t bin_fields = 0;
  bool viewpoint_known = true;
  /** \brief See ScanInput. */
  bool many_viewpoints = false;
};

/** \brief What a file holds. */
struct InputScan {
  Scan scan;
  /** \brief What people should know of it. */
  std::vector<std::string> warnings;
  /** \brief Milliseconds. */
  double reading = 0, making = 0;
};

/** \brief The first bytes of a file say what it is. */
enum class FileKind { Cloud, Scan, Index };

/** \brief Of what is no file, FileKind::Cloud, whose readers say so. */
FileKind
kindOf(const std::string& path);

/** \brief A saved scan.
 * \throws io::InputError */
Scan
loadScan(const std::string& path);

/** \brief Reads a cloud and makes a scan of it, or loads a saved scan.
 * \throws io::InputError, with the path, if it can't be read, or has not enough points at
 * this spacing; if a saved scan has another */
InputScan
readScan(const std::string& path,
         const ScanSettings& settings,
         PairRegistration& registration);

/** \brief The resolution that the first of the files needs that can be used.
 * \throws io::InputError if none can */
double
resolutionOfFirst(const std::vector<std::string>& paths, std::size_t bin_fields);

} // namespace pcl_flashreg::localize
