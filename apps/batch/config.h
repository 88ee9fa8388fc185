// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace pcl_flashreg::batch {

/** \brief Everything that the rows of a file depend on, as JSON. */
using Config = nlohmann::ordered_json;

/** \brief What differs between two configurations, in words; empty if nothing does. */
std::string
difference(const Config& before, const Config& now);

} // namespace pcl_flashreg::batch
