// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/agreement.h"
#include "support/thread_pool.h"

#include <vector>

namespace pcl_flashreg {

/** \brief Appends the best of thousands of hypotheses, by the clouds alone and on a few
 * points, which differ from each other and from those in the list.
 * \param[in] half_side see displacementOf()
 * \param[in] most that are appended */
void
screen(const SurfacePair& clouds,
       const std::vector<Pose>& hypotheses,
       double half_side,
       std::size_t most,
       std::vector<Pose>& list,
       ThreadPool& pool);

} // namespace pcl_flashreg
