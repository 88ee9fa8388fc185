// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/agreement.h"

#include <pcl_flashreg/cloud_view.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief What a pose has on its side, before the clouds. */
struct Standing {
  CloudAgreement agreement;
  /** \brief Correspondences that agree; of several sets of them, the mean. */
  double support = 0;
};

/** \brief What speaks for a pose, as a logarithm. */
double
weightOf(const Standing& pose);

/** \brief Where the one is that most speaks for, the first of equals.
 * \param[in] poses Standings, or more; at least one */
template <typename Poses>
std::size_t
heaviestOf(const Poses& poses)
{
  std::size_t best = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    if (weightOf(poses[i]) > weightOf(poses[best]))
      best = i;
  return best;
}

/** \brief One of each, the one that most speaks for first.
 * \param[in] poses Standings, or more
 * \param[in] same whether two of them are the same */
template <typename Pose, typename Same>
std::vector<Pose>
distinctOf(std::vector<Pose> poses, const Same& same)
{
  std::stable_sort(poses.begin(), poses.end(), [](const Pose& a, const Pose& b) {
    return weightOf(a) > weightOf(b);
  });
  std::vector<Pose> distinct;
  for (const Pose& pose : poses)
    if (std::none_of(distinct.begin(), distinct.end(), [&](const Pose& other) {
          return same(pose, other);
        }))
      distinct.push_back(pose);
  return distinct;
}

/** \brief By how much what the clouds say for a pose exceeds what they say for another one, as a
 * logarithm. */
double
leadByClouds(const Standing& pose, const Standing& other);

/** \brief Evidence::lead of the best pose.
 * \param[in] next null if there is no other */
double
leadOf(const Standing& best, const Standing* next);

/** \brief How much of a rival another pose is: 1 for one that explains as much.
 *
 * Where a place looks the same from elsewhere, the clouds say so; more correspondences
 * then speak for one pose than for another because the scans' patterns of points meet
 * there. A few dozen for the other one are enough, and the more there are, the less
 * the clouds have to agree. */
double
loudnessOf(const Standing& rival, const Standing& pose);

/** \brief In a map, what the clouds say for one of two places that are the same may be so much
 * more than for the other, since the map was seen from elsewhere in either. */
constexpr double ALIKE_IN_MAP = 0.5;

/** \brief The same of two places in a map: copies of a place share out between them the
 * correspondences of a scan, so that which of them has more is chance. The clouds decide.
 * \param[in] lead of the pose, by all that speaks for it
 * \param[in] lead_by_clouds by what they say */
double
loudnessInMap(double lead, double lead_by_clouds);

/** \brief The same by the clouds alone.
 * \param[in] support of the rival
 * \param[in] lead of the pose, by what the clouds say */
double
loudnessByClouds(double support, double lead);

} // namespace pcl_flashreg
