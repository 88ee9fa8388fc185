// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "random.h"
#include "scene.h"

namespace pcl_flashreg::generator {

/** \brief A house of two to four storeys with its front along x from 0 to its width,
 * outward -y, on z = 0. \return its width, metres */
double
addHouse(const Placer& house, Random& random);

} // namespace pcl_flashreg::generator
