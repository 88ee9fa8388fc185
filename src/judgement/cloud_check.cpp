// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cloud_check.h"

#include "judgement/confidence.h"
#include "judgement/cpu/plane_alignment.h"
#include "judgement/displacement.h"
#include "judgement/evidence.h"
#include "judgement/free_motion.h"
#include "judgement/screening.h"
#include "judgement/walk.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl_flashreg {
namespace {

/** \brief Poses on the surface are the same if no corner of the cube around the source moves
 * by more than this many spacings, or than this share of its half side. */
constexpr double SAME = 10, SAME_OF_SMALL = 0.6;

/** \brief A pose that is less certain than this does not overrule viewpoints, and one that is
 * more certain with them than that is not overruled. */
constexpr double LEAST_TO_OVERRULE = 0.01, NOT_TO_OVERRULE = 0.9;
/** \brief In a map viewpoints that are wrong leave less. */
constexpr double NOT_TO_OVERRULE_IN_MAP = 0.6;

/** \brief A pose that is less certain than this, whatever its walk would say, is hopeless. */
constexpr double HOPELESS = 0.1;
/** \brief Poses that are judged without the viewpoints where nobody wants to wait. */
constexpr std::size_t FAVOURITES_IN_A_HURRY = 8;

/** \brief Before the walk: were the pose held as firmly as most right ones are. */
bool
isHopeless(Evidence evidence)
{
  constexpr double HOLD = 2, STIFFNESS = 0.05;
  evidence.hold = HOLD;
  evidence.stiffness = STIFFNESS;
  return confidenceOfClouds(evidence) < HOPELESS;
}

} // namespace

/** \brief Poses before the clouds, which know where they were seen from, or don't. */
class CloudCheck::Court {
public:
  Court(const SurfacePair& clouds,
        const std::vector<const Problem*>& witnesses,
        float inlier_distance,
        double half_side,
        ThreadPool& pool)
      : clouds_(clouds),
        witnesses_(witnesses),
        inlier_distance_(inlier_distance),
        half_side_(half_side),
        pool_(pool),
        look_(clouds_, AT_EACH),
        look_closely_(clouds_, AT_THE_BEST)
  {
    if (clouds_.mayRepeat())
      look_without_sides_.emplace(without_sides_, AT_EACH);
  }

  /** \brief Takes up what is new among the first so many of a list. */
  void
  studyNew(const std::vector<Pose>& list, std::size_t count)
  {
    const auto at = [&](std::size_t i) {
      return list.begin() + static_cast<std::ptrdiff_t>(i);
    };
    study({at(studied_), at(count)});
    studied_ = count;
  }

  /** \brief There are more witnesses than before. */
  void
  countAgain()
  {
    pool_.forEach(checked_.size(), [&](std::size_t i, std::size_t) {
      checked_[i].support = supportOf(checked_[i].pose);
    });
  }

  /** \brief Ranks the poses and gathers the evidence for the best. */
  CloudFindings
  judge(bool give_up_early)
  {
    std::size_t best = heaviestOf(checked_);
    if (give_up_early) {
      const CloudFindings so_far = findings();
      if (isHopeless(so_far.evidence))
        return so_far;
    }
    walk(best);
    for (int walks = 1; walks < WALKS; ++walks) {
      study(peaksOf(walks_, clouds_.upright, TAKEN_UP));
      const std::size_t now = heaviestOf(checked_);
      if (now == best)
        break;
      best = now;
      walk(best);
    }
    return findings();
  }

private:
  double
  supportOf(const Pose& pose) const
  {
    double sum = 0;
    for (const Problem* witness : witnesses_)
      sum += static_cast<double>(inliersOf(*witness, pose, inlier_distance_).size());
    return sum / static_cast<double>(witnesses_.size());
  }

  /** \brief Moves poses onto the surface, and asks the clouds on many points. */
  void
  study(const std::vector<Pose>& poses)
  {
    const std::size_t first = checked_.size();
    checked_.resize(first + poses.size());
    pool_.forEach(poses.size(), [&](std::size_t i, std::size_t) {
      CheckedPose& result = checked_[first + i];
      result.pose = moveOntoTarget(clouds_, poses[i]);
      result.agreement = look_(result.pose);
      result.support = supportOf(result.pose);
    });
  }

  /** \brief All other poses, the first being the best. Sides that may be turned the wrong way
   * don't silence them. */
  double
  rivalsOf(const std::vector<CheckedPose>& poses) const
  {
    const auto withoutSides = [&](const CheckedPose& checked) {
      return evidenceOf((*look_without_sides_)(checked.pose));
    };
    const CheckedPose& first = poses.front();
    const double firsts = look_without_sides_ ? withoutSides(first) : 0;
    double rivals = 0;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      double loudness = clouds_.vicinity
                            ? loudnessInMap(weightOf(first) - weightOf(poses[i]),
                                            leadByClouds(first, poses[i]))
                            : loudnessOf(poses[i], first);
      if (look_without_sides_)
        loudness = std::max(
            loudness,
            loudnessByClouds(poses[i].support, firsts - withoutSides(poses[i])));
      rivals += loudness;
    }
    return rivals;
  }

  /** \brief Off this pose, unless that is where the last walk went. */
  void
  walk(std::size_t pose)
  {
    if (walked_from_ == pose)
      return;
    walks_ = walkOff(clouds_, checked_[pose].pose, pool_);
    walked_from_ = pose;
  }

  bool
  same(const Pose& a, const Pose& b) const
  {
    return displacementOf(a, b, half_side_) <
           std::min(SAME * clouds_.spacing, SAME_OF_SMALL * half_side_);
  }

  CloudFindings
  findings() const
  {
    CloudFindings findings;
    findings.poses = distinctOf(
        checked_, [&](const auto& a, const auto& b) { return same(a.pose, b.pose); });
    const CheckedPose& first = findings.poses.front();
    Evidence& evidence = findings.evidence;
    evidence.inliers = first.support;
    evidence.has_clouds = true;
    evidence.has_viewpoints = clouds_.viewpoints() > 0;
    evidence.has_sides = clouds_.hasSides();
    evidence.one_viewpoint = clouds_.viewpoints() == 1;
    evidence.in_map = clouds_.vicinity != nullptr;
    evidence.agreement = look_closely_(first.pose);
    // They are in order.
    evidence.lead =
        leadOf(first, findings.poses.size() > 1 ? &findings.poses[1] : nullptr);
    evidence.rivals = rivalsOf(findings.poses);
    addWalks(walks_, evidence);
    findings.free_motions = freeMotionsOf(walks_);
    return findings;
  }

  static constexpr std::size_t NOWHERE = ~std::size_t{0};

  const SurfacePair clouds_;
  const SurfacePair without_sides_ = clouds_.believing(Belief::Viewpoints);
  const std::vector<const Problem*>& witnesses_;
  float inlier_distance_;
  double half_side_;
  ThreadPool& pool_;
  Look look_, look_closely_;
  std::optional<Look> look_without_sides_;
  std::vector<CheckedPose> checked_;
  /** \brief Of the list. */
  std::size_t studied_ = 0;
  std::vector<Walk> walks_;
  std::size_t walked_from_ = NOWHERE;
};

CloudCheck::CloudCheck(const SurfacePair& clouds,
                       float inlier_distance,
                       bool give_up_early,
                       ThreadPool& pool)
    : clouds_(clouds.believing(Belief::Sides)),
      give_up_early_(give_up_early),
      half_side_(halfSideOf(clouds.source)),
      pool_(pool),
      inlier_distance_(inlier_distance)
{
  if (clouds_.hasSides() && clouds_.viewpoints() > 0)
    beliefs_.push_back(Belief::Viewpoints);
  if (clouds_.seeing())
    beliefs_.push_back(Belief::Nothing);
}

CloudCheck::~CloudCheck() = default;

CloudCheck::Court&
CloudCheck::court(std::size_t number)
{
  if (number == courts_.size())
    courts_.push_back(std::make_unique<Court>(clouds_.believing(beliefs_[number]),
                                              witnesses_,
                                              inlier_distance_,
                                              half_side_,
                                              pool_));
  return *courts_[number];
}

void
CloudCheck::addWitnesses(const Problem& correspondences)
{
  witnesses_.push_back(&correspondences);
  for (const auto& court : courts_)
    court->countAgain();
}

void
CloudCheck::addPoses(const std::vector<Pose>& hypotheses,
                     const std::vector<ScoredPose>& favourites,
                     std::size_t screened)
{
  if (favourites.empty())
    return;
  std::vector<Pose> best;
  for (const ScoredPose& favourite : favourites)
    best.push_back(favourite.pose);
  if (!clouds_.vicinity) {
    list_.insert(list_.end(), best.begin(), best.end());
    screen(clouds_, hypotheses, half_side_, screened, list_, pool_);
    return;
  }
  // In a map a glance tells more than correspondences do.
  best.insert(best.end(), hypotheses.begin(), hypotheses.end());
  screen(clouds_, best, half_side_, screened, list_, pool_);
}

void
CloudCheck::addTwins(const std::vector<Pose>& twins, std::size_t screened)
{
  screen(clouds_, twins, half_side_, screened, list_, pool_);
}

void
CloudCheck::addOverruled(CloudFindings& findings) const
{
  const Look look(clouds_, AT_EACH);
  pool_.forEach(findings.poses.size(), [&](std::size_t i, std::size_t) {
    CheckedPose& checked = findings.poses[i];
    checked.agreement.contradicted = look(checked.pose).contradicted;
  });
  findings.evidence.agreement.contradicted =
      findings.poses.front().agreement.contradicted;
}

CloudFindings
CloudCheck::judgeIn(std::size_t number)
{
  const std::size_t most =
      give_up_early_ && number > 0 ? FAVOURITES_IN_A_HURRY : list_.size();
  court(number).studyNew(list_, std::min(list_.size(), most));
  CloudFindings findings = court(number).judge(give_up_early_);
  Evidence& evidence = findings.evidence;
  evidence.overruled_viewpoints = clouds_.viewpoints() > 0 && !evidence.has_viewpoints;
  evidence.overruled_sides = clouds_.hasSides() && !evidence.has_sides;
  return findings;
}

CloudFindings
CloudCheck::judge()
{
  if (clouds_.source.points.empty() || clouds_.target.points.empty() || list_.empty())
    return {};
  CloudFindings findings = judgeIn(0);
  for (std::size_t i = 1; i < beliefs_.size(); ++i) {
    const double before = confidenceOfClouds(findings.evidence);
    if (before > (clouds_.vicinity ? NOT_TO_OVERRULE_IN_MAP : NOT_TO_OVERRULE))
      break;
    // What is more certain without the viewpoints says that they are wrong.
    CloudFindings others = judgeIn(i);
    if (confidenceOfClouds(others.evidence) > std::max(LEAST_TO_OVERRULE, before))
      findings = std::move(others);
  }
  if (findings.evidence.overruled_viewpoints)
    addOverruled(findings);
  return findings;
}

} // namespace pcl_flashreg
