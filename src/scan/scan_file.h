// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/scan.h>

#include <memory>
#include <string_view>

namespace pcl_flashreg {

/** \brief Scan::deserialize() that leaves the arrays where they are, and does not compare the
 * checksum.
 * \param[in] bytes from a multiple of 64 bytes on
 * \param[in] keeper has them as long as it lives
 * \throws ScanFileError */
Scan
mapScan(std::string_view bytes, const std::shared_ptr<const void>& keeper);

} // namespace pcl_flashreg
