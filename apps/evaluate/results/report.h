// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "summary.h"

#include <string>

namespace pcl_flashreg::evaluate {

/** \brief A table for people. */
std::string
formatTable(const std::vector<GroupSummary>& groups);

/** \brief The same, with the configuration and the maps, for programs. */
std::string
formatJson(const Config& config,
           const std::vector<GroupSummary>& groups,
           const std::vector<MapSummary>& maps = {});

} // namespace pcl_flashreg::evaluate
