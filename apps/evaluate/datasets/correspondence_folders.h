// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "data_set.h"

#include <string>

namespace pcl_flashreg::evaluate {

/** \brief Reads folders of correspondences with their true transforms, at any depth.
 *
 * TurboReg's: `<id>_<descriptor>_kpts_src.txt` and `..._kpts_dst.txt` (N x 3 each, row r of
 * both is one correspondence) with `<id>_trans.txt`. MAC's and MAC++'s:
 * `<pair>@corr<s>.txt` (N x 6) with `<pair>@GTmat<s>.txt`, where `<s>` is empty or names
 * the descriptor ("_fcgf"); where the folder has a `dataload<s>.txt`, only the pairs that
 * it names. Transforms are 4 x 4 and map source to target. The folder is the scene, the
 * path to it the data set.
 * \return without pairs if there are no such files
 * \throws io::InputError with the file, and the line where there is one
 */
DataSet
readCorrespondenceFolders(const std::string& root);

} // namespace pcl_flashreg::evaluate
