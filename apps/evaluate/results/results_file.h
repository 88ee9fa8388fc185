// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../../batch/config.h"
#include "map_summary.h"
#include "record.h"

#include <fstream>
#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief With method names under "methods", the number of pairs under "pairs". */
using batch::Config;

/** \brief Records and what they were made with.
 *
 * On disk: `x.csv` with a row a pair and method, in which two runs agree to the last byte,
 * behind a line "# " with the configuration and one with the names of the columns; and
 * `x.times.csv` with what differs, the times.
 */
struct Results {
  Config config;
  /** \brief By pair, and by method in the order of the configuration. */
  std::vector<Record> records;
  /** \brief Those that this run made; they are in no file. */
  std::vector<MapSummary> maps = {};
};

/** \brief The file of times that belongs to a file of results. */
std::string
timesPath(const std::string& path);

/** \brief Reads both files. A last line without an end, and pairs that lack a method or
 * its times, are what a killed run leaves: they are passed over.
 * \throws io::InputError with the file, and the line where there is one
 */
Results
readResults(const std::string& path);

/** \brief Writes both files, each under another name first.
 * \throws io::InputError if that fails
 */
void
writeResults(const std::string& path, const Results& results);

/** \brief Puts records into the order of Results::records. */
void
sortRecords(const Config& config, std::vector<Record>& records);

/** \brief Adds rows to files that writeResults() made. */
class ResultsAppender {
public:
  /** \throws io::InputError if the files cannot be written */
  explicit ResultsAppender(const std::string& path);

  /** \brief All records of a pair; they are on disk when it returns, as far as the
   * operating system goes.
   * \throws io::InputError if the disk is full
   */
  void
  append(const std::vector<Record>& records);

private:
  std::string path_;
  std::ofstream results_, times_;
};

} // namespace pcl_flashreg::evaluate
