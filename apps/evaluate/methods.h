// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "outcome.h"

#include <pcl_flashreg/parameters.h>

#include <functional>
#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief From correspondences to a pose. */
using Method = std::function<Answer(const Input&)>;

/** \brief Names that makeMethod() knows. */
std::vector<std::string>
methodNames();

/** \brief A method by its name.
 *
 * "flashreg" is Estimator; "pcl_ransac_10k" and "pcl_ransac_50k" are
 * pcl::registration::CorrespondenceRejectorSampleConsensus with that many iterations at
 * most, refined, on the same inlier distance (one thread: it has no more). PCL gives no
 * verdict: a pose that it finds counts as trusted.
 * \throws std::invalid_argument if the name is unknown
 */
Method
makeMethod(const std::string& name, const Parameters& parameters, unsigned threads);

} // namespace pcl_flashreg::evaluate
