// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_flashreg::batch {

/** \brief Where one of several processes leaves its rows until all are put together.
 * \param[in] kind what the process is: "rank", "shard"
 */
std::string
partPath(const std::string& file, const std::string& kind, std::size_t number);

/** \brief All parts of that kind that lie beside a file, in no particular order. */
std::vector<std::string>
partsOf(const std::string& file, const std::string& kind);

} // namespace pcl_flashreg::batch
