// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "multiview/joint_judgement.h"
#include "multiview/surface_constraint.h"
#include "multiview/votes.h"
#include "support/thread_pool.h"

#include <pcl_flashreg/cloud_view.h>

namespace pcl_flashreg {

/** \brief Moves the scans of a group, all but the first, so that the pairs fit which agree
 * with their poses.
 * \param[in] pairs between scans of the group
 * \param[in,out] poses of the group's scans change */
void
settlePoses(const MapScans& scans,
            const std::vector<const PairVotes*>& pairs,
            const std::vector<std::size_t>& group,
            MapPoses& poses,
            ThreadPool& pool);

/** \brief Two scans of a group whose surfaces touch. */
struct SurfaceEdge {
  /** \brief Where they lie by themselves, near to where the map has them. */
  PoseConstraint constraint;
  /** \brief Of the clouds under that pose, once askClouds() has filled it in. */
  CloudAgreement agreement;
  /** \brief That the pose is right, by these two scans alone; 0 where they don't speak for it. */
  double probability = 0;
};

/** \brief Moves the scans of a group so that all surfaces fit that touch, however little the
 * pairs had to say of it.
 * \return the edges of the last round, by target and source */
std::vector<SurfaceEdge>
refineMap(const MapScans& scans,
          const std::vector<const PairVotes*>& pairs,
          const std::vector<std::size_t>& group,
          MapPoses& poses,
          ThreadPool& pool);

/** \brief Asks the clouds of each edge about its pose. */
void
askClouds(const MapScans& scans, std::vector<SurfaceEdge>& edges, ThreadPool& pool);

} // namespace pcl_flashreg
