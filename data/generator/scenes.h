// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "random.h"
#include "scene.h"

namespace pcl_flashreg::generator {

/** \brief A furnished room of about 6 m x 5 m x 2.7 m; its floor is z = 0 and one
 * corner is the origin, the walls along +x and +y. */
Scene
makeRoom(Random& random);

/** \brief How much the street rises along x. */
constexpr double street_slope = 0.02;

/** \brief A street along x with its middle at y = 0: house fronts, parked cars, trees
 * and poles on both sides. The ground rises by street_slope along x and is at z = 0 at
 * the origin. */
Scene
makeStreet(Random& random);

} // namespace pcl_flashreg::generator
