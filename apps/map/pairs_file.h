// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../batch/config.h"
#include "scan_reader.h"

#include <pcl_flashreg/multiview_registration.h>

#include <fstream>
#include <string>
#include <vector>

namespace pcl_flashreg::map {

/** \brief All that the relations of pairs depend on: the program, the settings, and under
 * "scans" the name and the checksum of each scan. */
batch::Config
pairsConfig(const Options& options, const ScanSet& scans);

/** \brief Relations, and what they were made with.
 *
 * On disk: a line "# " with the configuration, one with the names of the columns, and a row
 * a pair. A whole file has them in order; one that was not finished as they came. */
struct PairsFile {
  batch::Config config;
  /** \brief Their scans are numbered as those of the configuration. */
  std::vector<ScanRelation> relations;
};

/** \brief A last line without an end is what a killed run leaves: it is passed over.
 * \throws io::InputError with the file, and the line where there is one
 */
PairsFile
readPairs(const std::string& path);

/** \brief Under another name first.
 * \throws io::InputError if that fails */
void
writePairs(const std::string& path, const PairsFile& pairs);

/** \brief What a file knows of our scans, with our numbers. Scans are known by their
 * contents, whatever their names.
 * \param[in] now our configuration
 * \param[in] growing whether there may be scans that the file does not know
 * \throws io::InputError if the file was made with other settings, with the difference
 */
std::vector<ScanRelation>
knownRelations(const std::string& path, const batch::Config& now, bool growing);

/** \brief Adds rows to a file that writePairs() made. */
class PairsAppender {
public:
  /** \throws io::InputError if the file cannot be written */
  explicit PairsAppender(const std::string& path);

  /** \brief The row is on disk when it returns, as far as the operating system goes.
   * \throws io::InputError if the disk is full */
  void
  append(const ScanRelation& relation);

private:
  std::string path_;
  std::ofstream file_;
};

} // namespace pcl_flashreg::map
