// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/principal_motions.h"
#include "support/thread_pool.h"

#include <pcl_flashreg/result.h>

#include <functional>
#include <vector>

namespace pcl_flashreg {

/** \brief What the clouds say some way off a pose. */
struct Stop {
  /** \brief In the unit of the clouds; below 0 on the other side. */
  double way;
  Pose pose;
  CloudAgreement agreement;
};

/** \brief Off a pose and along a motion, to either side. */
struct Walk {
  Motion motion;
  /** \brief Ascending; the one in the middle is the pose itself. */
  std::vector<Stop> stops;
  /** \brief From where on a pose is another one. */
  double far = 0;

  const Stop&
  start() const
  {
    return stops[stops.size() / 2];
  }

  /** \brief By how much what speaks for a pose rises above the start's, far off. */
  double
  rise() const;
};

/** \brief Along the softest motion of a pose, and up to two others that are soft: where the
 * clouds say the same all along, or again some way off, they don't say where the pose is. */
std::vector<Walk>
walkOff(const SurfacePair& clouds, const Pose& pose, ThreadPool& pool);

/** \brief The same for whoever has other clouds to ask, by any number of threads at a time.
 * \param[in] motions the softest first; none where nothing matches */
std::vector<Walk>
walkOff(const std::vector<Motion>& motions,
        const Pose& pose,
        float spacing,
        const std::function<CloudAgreement(const Pose&)>& look,
        ThreadPool& pool);

/** \brief How closely clouds are looked at on the way. */
constexpr LookSettings ON_THE_WAY{256, 2, 3};

/** \brief Evidence::hold and Evidence::stiffness of the pose that was walked off. */
void
addWalks(const std::vector<Walk>& walks, Evidence& evidence);

/** \brief Where clouds that were walked over say most, far off: at most `most` poses, the best
 * first, and none that tilts much more than it may. */
std::vector<Pose>
peaksOf(const std::vector<Walk>& walks, const Upright& upright, std::size_t most);

} // namespace pcl_flashreg
