// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/standing.h"
#include "support/thread_pool.h"
#include "estimation/problem.h"

#include <pcl_flashreg/result.h>

#include <memory>
#include <vector>

namespace pcl_flashreg {

/** \brief How closely clouds look at each pose, and at the best. Moved onto the surface, a pose
 * is exact enough for a thinner margin than while it is screened. */
constexpr LookSettings AT_EACH{1000, 1.5f, 2}, AT_THE_BEST{4000, 1.5f, 2};

/** \brief Poses that are taken up along the way off the best one, and how often that may be
 * another one then. */
constexpr std::size_t TAKEN_UP = 4;
constexpr int WALKS = 3;

/** \brief A pose that was brought before the clouds. */
struct CheckedPose : Standing {
  Pose pose;
};

/** \brief What the clouds have to say. */
struct CloudFindings {
  /** \brief Distinct poses, best first. */
  std::vector<CheckedPose> poses;
  /** \brief For the best pose; what comes from correspondences alone is not filled in,
   * but for the inliers, which are the best pose's support. */
  Evidence evidence;
  /** \brief Of the best pose, in the centred frame of the target. */
  std::vector<FreeMotion> free_motions;
};

/** \brief Asks the clouds which of many hypotheses is right.
 *
 * All hypotheses are screened on a few points, and the best again on more. The best that
 * differ, and the favourites, are moved onto the target's surface and judged on all that is
 * known: by (matched + 1 %) / (contradicted + 1 %) * sqrt(support + 5), or without
 * the denominator, where neither viewpoints nor the sides of surfaces are believed.
 * Hypotheses may come in several lots, after each of which judge() says which of all so far
 * is right. The same on any number of threads.
 */
class CloudCheck {
public:
  /** \param[in] clouds must outlive this
   * \param[in] inlier_distance as in Parameters
   * \param[in] give_up_early see PairOptions */
  CloudCheck(const SurfacePair& clouds,
             float inlier_distance,
             bool give_up_early,
             ThreadPool& pool);
  ~CloudCheck();

  /** \brief From now on these correspondences are asked, too, which poses they support; they
   * must outlive this. */
  void
  addWitnesses(const Problem& correspondences);

  /** \param[in] hypotheses to be screened, in the centred frames of all problems
   * \param[in] favourites poses that skip the screening
   * \param[in] screened how many may pass it */
  void
  addPoses(const std::vector<Pose>& hypotheses,
           const std::vector<ScoredPose>& favourites,
           std::size_t screened);

  /** \brief In a map, what else turns the source as poses that are known.
   * \param[in] twins to be screened
   * \param[in] screened how many may pass it */
  void
  addTwins(const std::vector<Pose>& twins, std::size_t screened);

  /** \return no pose, if there was none or a cloud has no points */
  CloudFindings
  judge();

private:
  class Court;

  /** \brief The one of a belief, opened when it is asked for; they are asked in order. */
  Court&
  court(std::size_t number);

  /** \brief What contradicts poses according to viewpoints that are not believed: who weighs
   * poses against each other later has other witnesses, too. */
  void
  addOverruled(CloudFindings& findings) const;

  CloudFindings
  judgeIn(std::size_t number);

  const SurfacePair clouds_;
  bool give_up_early_;
  double half_side_ = 0;
  ThreadPool& pool_;
  float inlier_distance_;
  std::vector<const Problem*> witnesses_;
  /** \brief All that passed, in the order in which they came. */
  std::vector<Pose> list_;
  /** \brief Each is less than the one before it, and counts where that one leaves doubt. */
  std::vector<Belief> beliefs_{Belief::Sides};
  std::vector<std::unique_ptr<Court>> courts_;
};

} // namespace pcl_flashreg
