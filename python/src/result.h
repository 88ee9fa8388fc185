// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "array.h"

#include <pcl_flashreg/pair_registration.h>

#include <string>
#include <vector>

namespace pcl_flashreg::python {

/** \brief Which rows match, M x 2 int32; memory of `owner`. */
py::array
pairsOf(const std::vector<FeatureMatch>& matches, py::handle owner);

/** \brief The squared distances of matches, M float32; memory of `owner`. */
py::array
squaredDistancesOf(const std::vector<FeatureMatch>& matches, py::handle owner);

/** \brief Both of these, in arrays that own them. */
py::tuple
tupleOf(std::vector<FeatureMatch>&& matches);

/** \brief 6 x 6 float64. */
py::array
arrayOf(const InformationMatrix& information);

/** \brief A few digits, for people. */
std::string
rounded(double value, int digits);

/** \brief "12.3 deg, [1.23, 4.56, 7.89]": how far a pose turns, and its translation. */
std::string
poseText(const RigidTransform& pose);

} // namespace pcl_flashreg::python
