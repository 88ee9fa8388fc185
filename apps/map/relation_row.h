// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../batch/rows.h"

#include <pcl_flashreg/multiview_registration.h>

namespace pcl_flashreg::map {

// What two scans say of each other as a row of text. Poses are separated by ';', each is its
// probability, its inliers, and the upper three rows of its matrix.

batch::Cells
relationColumns();

batch::Cells
relationCells(const ScanRelation& relation);

/** \brief The reverse, to the last bit.
 * \throws io::InputError if the cells are not those of a relation
 */
ScanRelation
relationFromCells(const batch::Cells& cells);

} // namespace pcl_flashreg::map
