// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>
#include <vector>

namespace pcl_flashreg::map {

/** \brief A scan that the command line names. */
struct ScanFile {
  /** \brief Of the file; with as many of its folders as it takes to tell it from others. */
  std::string name;
  std::string path;
};

/** \brief The files that are meant: those named, of folders all clouds that lie in them,
 * of a list its lines ('#' begins a comment; paths start from the list's folder). In
 * natural order of their names, whatever the order in which they are given.
 * \param[in] list a text file; empty for none
 * \throws program::UsageError if a file is given twice
 * \throws io::InputError if a folder holds no cloud or can't be read, if the list can't
 */
std::vector<ScanFile>
findScans(const std::vector<std::string>& paths, const std::string& list);

} // namespace pcl_flashreg::map
