// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "record.h"

#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

// A record as a row of each of the two files: what is the same in every run, and times.

std::vector<std::string>
resultColumns();

std::vector<std::string>
timeColumns();

std::vector<std::string>
resultCells(const Record& record);

std::vector<std::string>
timeCells(const Record& record);

/** \throws io::InputError if the cells are not those of a record */
Record
recordFromCells(const std::vector<std::string>& cells);

/** \brief The times of a row of the other file, and whose they are.
 * \throws io::InputError if the cells are not those of a row
 */
Times
timesFromCells(const std::vector<std::string>& cells,
               std::size_t& pair,
               std::string& method);

} // namespace pcl_flashreg::evaluate
