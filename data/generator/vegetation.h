// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "random.h"
#include "scene.h"

namespace pcl_flashreg::generator {

/** \brief A bush of about 1 m to 2 m on z = 0. */
void
addBush(const Placer& ground, Random& random);

/** \brief A trunk that leans a little, boughs, and a crown of small leaves. */
void
addTree(const Placer& ground, Random& random);

} // namespace pcl_flashreg::generator
