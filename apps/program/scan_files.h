// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>
#include <vector>

namespace pcl_flashreg::program {

/** \brief A scan that the command line names. */
struct ScanFile {
  /** \brief Of the file; with as many of its folders as it takes to tell it from others. */
  std::string name;
  std::string path;
};

enum class ScanOrder {
  /** \brief In natural order of their names, whatever the order in which they are given. */
  ByName,
  /** \brief The order in which they are given; by name within a folder. */
  AsGiven
};

/** \brief The files that are meant: those named, of folders all clouds that lie in them,
 * of a list its lines ('#' begins a comment; paths start from the list's folder).
 * \param[in] list a text file; empty for none
 * \throws UsageError if a file is given twice
 * \throws io::InputError if a folder holds no cloud or can't be read, if the list can't
 */
std::vector<ScanFile>
findScans(const std::vector<std::string>& paths,
          const std::string& list,
          ScanOrder order = ScanOrder::ByName);

} // namespace pcl_flashreg::program
