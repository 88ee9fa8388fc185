// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "data_set.h"

#include <string>

namespace pcl_flashreg::evaluate {

/** \brief Reads a tree in the manner of 3DMatch: fragments `<scene>/cloud_bin_<k>.ply` (or
 * .pcd) and a `gt.log` a scene, both anywhere below the root.
 *
 * The gt.log may lie beside the fragments, in `<scene>-evaluation/` (the authors' own
 * layout) or in `benchmarks/{3DMatch,3DLoMatch}/<scene>/` (Predator's and
 * GeoTransformer's). The folder that holds the scene's is the name of the data set. An
 * entry is "i j n" and the 4 x 4 matrix that maps fragment j into the frame of fragment i.
 * All entries are taken, consecutive fragments too: that makes the 1623 and 1781 pairs
 * of the literature.
 * \return without pairs if there is no gt.log
 * \throws io::InputError with file and line if a gt.log is malformed; if the fragments of
 * a pair are not there
 */
DataSet
readThreeDMatch(const std::string& root);

} // namespace pcl_flashreg::evaluate
