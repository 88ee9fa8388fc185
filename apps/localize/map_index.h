// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../program/messages.h"
#include "options.h"

#include <functional>

namespace pcl_flashreg::localize {

/** \brief What scans are found in: opened, where the map is an index or has one that
 * was made of it; else made, and kept where that is asked for.
 * \param[in] resolution what scans need; asked where nothing else tells
 * \throws UsageError if options do not suit the index
 * \throws io::InputError, ScanFileError if a file can't be used */
ScanIndex
openMap(const Options& options,
        const std::function<double()>& resolution,
        PairRegistration& registration,
        const program::Messages& messages);

} // namespace pcl_flashreg::localize
