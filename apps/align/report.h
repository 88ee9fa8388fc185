// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "options.h"
#include "pipeline.h"

#include <string>

namespace pcl_flashreg::align {

/** \brief The outcome for a person: verdict, pose, counts, times; several lines. */
std::string
formatReport(const Options& options, const Outcome& outcome);

/** \brief Verdict in one line: whether the pose is trusted, and if not, why. */
std::string
formatVerdict(const Outcome& outcome);

/** \brief The outcome for a program, one JSON object. Keys are only ever added. Numbers
 * that are not finite (distinctness without a rival) are null. In timings_ms "estimation" is
 * the sum of the stages before it; without these, the entries add up to "total". */
std::string
formatJson(const Options& options, const Outcome& outcome);

} // namespace pcl_flashreg::align
