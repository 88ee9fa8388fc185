// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

namespace pcl_flashreg {

/** \brief Stiffness below which the surfaces leave a pose free. */
constexpr double NEEDED_STIFFNESS = 0.004;

/** \brief Result::confidence: a logistic regression on the evidence, with one set of
 * coefficients for correspondences alone, one for clouds with both viewpoints, one for
 * clouds with one of them and one for clouds without. scripts/fit_confidence.py computes
 * them. */
double
confidenceOf(const Evidence& evidence);

/** \brief The same before it is known what a reflection would explain. */
double
confidenceOfClouds(const Evidence& evidence);

} // namespace pcl_flashreg
