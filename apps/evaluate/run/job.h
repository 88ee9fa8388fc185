// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../datasets/data_set.h"
#include "../options.h"
#include "../results/results_file.h"

#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief What to evaluate: the data set, the pairs of it that were asked for, and the
 * settings, with the layout's own where the user gave none. */
struct Job {
  DataSet data;
  /** \brief Numbers in data.pairs, of the whole list, whatever the shard. */
  std::vector<std::size_t> pairs;
  /** \brief Positions in `pairs` that belong to the shard. */
  std::vector<std::size_t> shard;
  Parameters parameters;
  Config config;
};

/** \throws io::InputError if there is nothing to evaluate
 * \throws UsageError if a method needs clouds and the data set has none
 */
Job
makeJob(const Options& options);

} // namespace pcl_flashreg::evaluate
