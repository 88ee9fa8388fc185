// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../program/json.h"
#include "located.h"
#include "options.h"
#include "sequence.h"

#include <vector>

namespace pcl_flashreg::localize {

/** \brief One line for a person: where the scan is, or why nobody knows.
 * \param[in] spacing of the map, which says how many digits mean anything */
std::string
formatPlace(const Located& located, const Options& options, double spacing);

/** \brief The same of a sequence. */
std::string
formatSequence(const LocatedSequence& sequence, const Options& options, double spacing);

/** \brief How many scans are placed. */
std::string
formatCaption(const std::vector<Located>& all);

/** \brief The same, and how long one took. */
std::string
formatTotal(const std::vector<Located>& all);

/** \brief Keys are only ever added. Those that pcl_flashreg_align writes, too, mean the
 * same; "timings_ms" comes last, and is all that differs from run to run. */
program::Json
jsonOf(const Located& located);
program::Json
jsonOf(const LocatedSequence& sequence);

/** \brief Of the scans that are trusted; in CSV and JSON of all of them. */
std::string
formatPoses(const std::vector<Located>& all, PoseFormat format);

} // namespace pcl_flashreg::localize
