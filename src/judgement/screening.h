// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/agreement.h"
#include "support/thread_pool.h"

#include <vector>

namespace pcl_flashreg {

/** \brief How closely those are looked at that a glance leaves. A pose that has not been moved
 * onto the surface yet is off by a spacing or two, which the wider tolerance makes up for. */
constexpr LookSettings WHILE_SCREENING{128, 2, 3};

/** \brief What speaks for a pose while it is screened, from 0 to 1. */
double
shareOf(const CloudAgreement& agreement);

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
