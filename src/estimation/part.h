// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/problem.h"

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief These rows, at most `most` of them, spread evenly over their numbers; all else as in
 * the whole. */
void
takeRows(const Problem& problem,
         const std::vector<std::size_t>& rows,
         std::size_t most,
         Problem& part);

/** \brief What a pose leaves unexplained: the rows whose residuals are not below this limit,
 * at most `most` of them, spread evenly over their numbers.
 *
 * The pivots of a problem are the edges of highest score, and the edges of its largest
 * consistent set score highest: where that set is large, all pivots are its own, and no other
 * motion is ever looked at, however well supported. Among what is left, the next one is the
 * largest. */
void
takeLeftover(const Problem& problem,
             const Pose& pose,
             float limit,
             std::size_t most,
             Problem& leftover);

} // namespace pcl_flashreg
