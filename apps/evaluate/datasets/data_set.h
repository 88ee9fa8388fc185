// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "pair.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief Below which errors a pose counts as right. */
struct Criterion {
  /** \brief Degrees. */
  double max_rotation = 15;
  /** \brief Unit of the clouds. */
  double max_translation = 0.3;
};

/** \brief Pairs to register, whatever layout they were read from, and what is usual for
 * that layout unless the user says otherwise. */
struct DataSet {
  /** \brief Folder that the paths of the pairs start from. */
  std::string root;
  std::vector<Pair> pairs;
  double leaf = 0.05;
  Criterion criterion;
  /** \brief float32 values in a row of raw .bin files; 0 to tell it from the values. */
  std::size_t bin_fields = 0;
};

/** \brief What a layout may need to be told. */
struct DataSetOptions {
  /** \brief For a list of pairs: the folder of its paths; empty for the list's own. */
  std::string root;
  /** \brief For KITTI: which sequences. */
  std::vector<int> sequences = {8, 9, 10};
  /** \brief What DataSet::bin_fields is to be; 0 for what the layout says. */
  std::size_t bin_fields = 0;
};

/** \brief Reads a list of pairs, or a folder in one of the layouts that the headers of
 * this folder describe; which one is told from what the folder holds.
 * \throws io::InputError with the file, and the line where there is one
 */
DataSet
openDataSet(const std::string& path, const DataSetOptions& options);

} // namespace pcl_flashreg::evaluate
