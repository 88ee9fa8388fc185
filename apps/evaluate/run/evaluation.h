// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../options.h"
#include "../results/map_summary.h"
#include "../results/record.h"
#include "job.h"

#include <functional>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief Registers pairs with every method.
 * \return the maps that were made, for a method of whole scenes
 * \param[in] pairs positions in Job::pairs
 * \param[in] quiet no progress
 * \param[in] done gets the records of each pair, one a method
 * \throws io::InputError, BackendError, std::bad_alloc
 */
std::vector<MapSummary>
evaluatePairs(const Options& options,
              const Job& job,
              const std::vector<std::size_t>& pairs,
              bool quiet,
              const std::function<void(const std::vector<Record>&)>& done);

} // namespace pcl_flashreg::evaluate
