// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "data_set.h"

#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief Whether a folder holds `sequences/` and `poses/`. */
bool
isKitti(const std::string& root);

/** \brief Pairs of KITTI odometry scans about 10 m apart:
 * `sequences/NN/velodyne/NNNNNN.bin`, `sequences/NN/calib.txt`, `poses/NN.txt`.
 *
 * The usual list of the literature (3DFeatNet, FCGF and those after them: 555 pairs of
 * the sequences 8 to 10): from a frame on, the partner is the last one before the distance
 * first exceeds 10 m, looked for within 100 frames; the next pair begins with the frame
 * after the partner. 8: 15 - 58 is left out, since its pose is wrong. The earlier frame is
 * the source. Poses are those of the camera, taken to the lidar by the calibration's Tr, and
 * to be refined: those of the navigation system are off by up to a metre.
 * \throws io::InputError with file and line
 */
DataSet
readKitti(const std::string& root, const std::vector<int>& sequences);

} // namespace pcl_flashreg::evaluate
