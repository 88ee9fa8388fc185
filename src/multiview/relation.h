// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/multiview_registration.h>

namespace pcl_flashreg {

/** \brief The options under which a pair has rivals to tell of. */
PairOptions
withRivals(PairOptions options);

/** \brief The poses of a pair's result that may be right, and how likely. */
std::vector<RelativePose>
posesOf(const Result& result);

} // namespace pcl_flashreg
