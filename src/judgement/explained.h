// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/problem.h"

#include <vector>

namespace pcl_flashreg {

/** \brief An isometry that agrees with these rows, ascending. */
struct Explained {
  Pose pose;
  std::vector<int> rows;
};

/** \brief What isometries are refined among. */
struct Isometries {
  /** \brief Reflections instead of motions. */
  bool mirrored = false;
  /** \brief What motions keep to. */
  Upright upright;
};

/** \brief Rounds of weighted alignment, as stage 7, as long as more rows agree. */
Explained
refined(const Problem& problem,
        const Pose& start,
        const Isometries& among,
        int rounds,
        float inlier_distance);

/** \brief The rows that are not among the others. */
std::vector<int>
without(const std::vector<int>& rows, const std::vector<int>& others);

/** \brief By how many standard deviations a coin that fell so often on either side speaks for
 * the one. */
double
leadOf(std::size_t one, std::size_t other);

} // namespace pcl_flashreg
