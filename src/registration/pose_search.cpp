// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "registration/pose_search.h"

#include "judgement/confidence.h"
#include "judgement/evidence.h"
#include "judgement/mirror.h"
#include "judgement/tilt.h"
#include "judgement/twins.h"
#include "estimation/check_correspondences.h"
#include "estimation/information.h"
#include "estimation/part.h"
#include "math/distinctness.h"
#include "math/isometry.h"
#include "registration/choose_backend.h"

#include <algorithm>
#include <limits>

namespace pcl_flashreg {
namespace {

Eigen::Matrix3d
rotationOf(const Pose& T)
{
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(T.r);
}

/** \brief Hypotheses that the verdict needs to see: rivals for the correspondences, and
 * more of them where the clouds choose. */
constexpr int LISTED = 5, LISTED_FOR_CLOUDS = 20;

/** \brief Hypotheses that may pass the screening. */
constexpr std::size_t SCREENED = 12;

/** \brief How many hypotheses come before the clouds. */
struct Passing {
  /** \brief Those that need not pass the screening, and those that do. */
  std::size_t favourites, screened;
};

/** \brief Of a second look, and of one at a part of a map, of which there are many. */
constexpr Passing OF_OTHERS{8, SCREENED}, OF_PLACE{3, 4};
constexpr int PIVOTS_OF_PLACE = 500;

/** \brief Places with the same turn that are looked for, and which of them pass the screening;
 * what is less certain needs no rivals. */
constexpr std::size_t TWINS = 16;
constexpr double WITHOUT_TWINS = 0.05;

/** \brief After so many looks the clouds are asked again. */
constexpr std::size_t AT_A_TIME = 8;

Parameters
withRivals(Parameters parameters, bool for_clouds)
{
  parameters.max_hypotheses =
      std::max(parameters.max_hypotheses, for_clouds ? LISTED_FOR_CLOUDS : LISTED);
  return parameters;
}

/** \brief With which the clouds came to it. */
Belief
beliefOf(const Evidence& evidence)
{
  if (evidence.has_sides)
    return Belief::Sides;
  return evidence.has_viewpoints ? Belief::Viewpoints : Belief::Nothing;
}

/** \brief The most inliers that a hypothesis other than the first has. */
int
rivalInliers(const std::vector<ScoredPose>& hypotheses)
{
  int most = 0;
  for (std::size_t i = 1; i < hypotheses.size(); ++i)
    most = std::max(most, hypotheses[i].inlier_count);
  return most;
}

} // namespace

PoseSearch::PoseSearch(BackendKind backend, unsigned num_threads)
    : pool_(num_threads), backend_(chooseBackend(backend, pool_))
{
}

PoseSearch::PoseSearch(const PoseSearch& like, unsigned num_threads)
    : pool_(num_threads), backend_(like.backend_->another(pool_))
{
}

/** \brief p_t = R p_s + t with p_s = s + c_s and p_t = q + c_t: q = R s + R c_s + t - c_t. */
Pose
PoseSearch::toCentred(const RigidTransform& T) const
{
  Pose centred;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(centred.r) = T.rotation;
  Eigen::Map<Eigen::Vector3d>(centred.t) =
      T.rotation * toEigen(preparation_.source_centre) + T.translation -
      toEigen(preparation_.target_centre);
  return centred;
}

RigidTransform
PoseSearch::toOriginal(const Pose& T) const
{
  RigidTransform original;
  original.rotation = rotationOf(T);
  original.translation = Eigen::Map<const Eigen::Vector3d>(T.t) +
                         toEigen(preparation_.target_centre) -
                         original.rotation * toEigen(preparation_.source_centre);
  return original;
}

/** \brief Adds hypotheses that the correspondences support which the best one leaves
 * unexplained. */
void
PoseSearch::addSecondBest(const Parameters& parameters,
                          PoseEstimate& estimate,
                          StageClock& clock)
{
  constexpr float NEAR = 3;
  constexpr std::size_t MOST = 1000;
  const float limit = parameters.inlier_distance;
  const Pose best = estimate.hypotheses.front().pose;
  takeLeftover(problem_, best, NEAR * limit, MOST, leftover_);
  if (leftover_.size < 3)
    return;
  const PoseEstimate second = backend_->run(leftover_,
                                            withRivals(parameters, false),
                                            std::nullopt,
                                            /* with_candidates */ false,
                                            clock,
                                            nullptr);
  std::vector<ScoredPose>& hypotheses = estimate.hypotheses;
  for (const ScoredPose& found : second.hypotheses) {
    if (std::any_of(hypotheses.begin(), hypotheses.end(), [&](const ScoredPose& other) {
          return samePose(found.pose, other.pose, problem_.radius, limit);
        }))
      continue;
    const std::vector<int> inliers = inliersOf(problem_, found.pose, limit);
    hypotheses.push_back({found.pose,
                          scoreOf(problem_, found.pose, inliers, parameters),
                          static_cast<int>(inliers.size())});
  }
  std::stable_sort(hypotheses.begin() + 1,
                   hypotheses.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
}

/** \brief Brings before the clouds what other correspondences speak for. */
void
PoseSearch::lookAt(const OtherCorrespondences& other,
                   const Parameters& parameters,
                   Problem& problem,
                   CloudCheck& check)
{
  prepareLike(preparation_, other.correspondences.view(), parameters, problem);
  if (other.are_witnesses)
    check.addWitnesses(problem);
  if (problem.size < 3)
    return;
  Parameters for_others = withRivals(parameters, !other.of_place);
  if (other.of_place)
    for_others.pivots = std::min(for_others.pivots, PIVOTS_OF_PLACE);
  StageTimings unused;
  StageClock clock(unused);
  PoseEstimate found = backend_->run(problem,
                                     for_others,
                                     std::nullopt,
                                     /* with_candidates */ true,
                                     clock,
                                     nullptr);
  const Passing& passing = other.of_place ? OF_PLACE : OF_OTHERS;
  found.hypotheses.resize(std::min(found.hypotheses.size(), passing.favourites));
  check.addPoses(found.candidates, found.hypotheses, passing.screened);
}

/** \brief Does that with some of them, from the first on.
 * \return whether there may be more */
bool
PoseSearch::lookAgain(const SecondLook& second_look,
                      std::size_t first,
                      const Parameters& parameters,
                      CloudCheck& check)
{
  for (std::size_t i = first; i < first + AT_A_TIME; ++i) {
    const std::optional<OtherCorrespondences> other = second_look(i);
    if (!other)
      return false;
    if (others_.size() <= i)
      others_.emplace_back();
    lookAt(*other, parameters, others_[i], check);
  }
  return true;
}

/** \brief What the clouds say; in a map, with the places in mind that look the same. */
CloudFindings
PoseSearch::judged(const Parameters& parameters, CloudCheck& check) const
{
  CloudFindings findings = check.judge();
  if (!findings.evidence.in_map ||
      confidenceOfClouds(findings.evidence) < WITHOUT_TWINS)
    return findings;
  std::vector<Pose> known;
  for (const CheckedPose& checked : findings.poses)
    known.push_back(checked.pose);
  check.addTwins(twinsOf(problem_, known, parameters.inlier_distance, TWINS), TWINS);
  return check.judge();
}

/** \brief Replaces the hypotheses by those that stand before the clouds, unless the best
 * of these has less than three inliers. */
CloudFindings
PoseSearch::askClouds(const JudgingClouds& clouds,
                      const Parameters& parameters,
                      const SecondLook& second_look,
                      PoseEstimate& estimate,
                      StageClock& clock)
{
  const SurfacePair surfaces = prepareClouds(clouds);
  CloudCheck check(surfaces, parameters.inlier_distance, clouds.give_up_early, pool_);
  check.addWitnesses(problem_);
  check.addPoses(estimate.candidates, estimate.hypotheses, SCREENED);
  CloudFindings findings = judged(parameters, check);
  clock.finish(&StageTimings::cloud_check);
  bool may_be_more = static_cast<bool>(second_look);
  for (std::size_t first = 0;
       may_be_more && confidenceOfClouds(findings.evidence) < parameters.min_confidence;
       first += AT_A_TIME) {
    may_be_more = lookAgain(second_look, first, parameters, check);
    CloudFindings again = judged(parameters, check);
    again.evidence.second_look = true;
    // Of many poses that nothing speaks for the best is none better than the first.
    if (confidenceOfClouds(again.evidence) > confidenceOfClouds(findings.evidence))
      findings = std::move(again);
    clock.finish(&StageTimings::second_look);
  }
  // Those of a map's places are others than the first look's.
  if (findings.evidence.inliers < 3 && !findings.evidence.in_map)
    return {};
  takeOver(findings, parameters, estimate);
  const SurfacePair believed = surfaces.believing(beliefOf(findings.evidence));
  findings.evidence.tilted = tiltedEvidence(
      problem_, &believed, findings.poses.front().pose, parameters.inlier_distance);
  return findings;
}

void
PoseSearch::takeOver(const CloudFindings& findings,
                     const Parameters& parameters,
                     PoseEstimate& estimate) const
{
  const float limit = parameters.inlier_distance;
  estimate.status = Status::Ok;
  estimate.hypotheses.clear();
  for (const CheckedPose& checked : findings.poses) {
    std::vector<int> inliers = inliersOf(problem_, checked.pose, limit);
    estimate.hypotheses.push_back({checked.pose,
                                   scoreOf(problem_, checked.pose, inliers, parameters),
                                   static_cast<int>(inliers.size())});
    if (estimate.hypotheses.size() == 1)
      estimate.inliers = std::move(inliers);
  }
}

void
PoseSearch::fill(Result& result,
                 const PoseEstimate& estimate,
                 const CloudFindings& findings,
                 const Parameters& parameters)
{
  result.status = estimate.status;
  result.second_order = estimate.second_order;
  if (estimate.status != Status::Ok)
    return;
  for (const ScoredPose& hypothesis : estimate.hypotheses)
    result.hypotheses.push_back(
        {toOriginal(hypothesis.pose),
         hypothesis.inlier_count,
         static_cast<double>(hypothesis.score) / static_cast<double>(SCORE_UNIT),
         std::nullopt});
  result.T_target_source = result.hypotheses.front().T_target_source;
  result.score = result.hypotheses.front().score;
  for (const int i : estimate.inliers)
    result.inliers.push_back(preparation_.rows[i]);
  const int rival = rivalInliers(estimate.hypotheses);
  result.distinctness = rival > 0 ? static_cast<double>(estimate.inliers.size()) / rival
                                  : std::numeric_limits<double>::infinity();
  result.evidence = findings.evidence;
  addCorrespondences(problem_,
                     estimate.hypotheses.front().pose,
                     estimate.inliers,
                     rival,
                     parameters.inlier_distance,
                     pool_,
                     result.evidence);
  // Of several looks, what all their correspondences say.
  if (result.evidence.has_clouds)
    result.evidence.inliers = findings.evidence.inliers;
  for (std::size_t i = 0; i < findings.poses.size(); ++i)
    result.hypotheses[i].agreement = findings.poses[i].agreement;
  result.hypotheses.resize(
      std::min<std::size_t>(result.hypotheses.size(), parameters.max_hypotheses));
  result.confidence = confidenceOf(result.evidence);
  result.converged = result.confidence >= parameters.min_confidence;
  result.information = informationMatrix(problem_,
                                         estimate.hypotheses.front().pose,
                                         estimate.inliers,
                                         preparation_.target_centre,
                                         parameters.inlier_distance);
  for (FreeMotion motion : findings.free_motions) {
    motion.point += toEigen(preparation_.target_centre);
    forget(motion, result.information);
    result.free_motions.push_back(motion);
  }
}

Vec3
JudgingCloud::middle() const
{
  if (known_middle)
    return *known_middle;
  return std::visit([](const auto& cloud) { return middleOf(cloud); }, view) + shift;
}

SurfacePair
PoseSearch::prepareClouds(const JudgingClouds& clouds)
{
  const auto spacing = static_cast<float>(clouds.spacing);
  const bool is_map = clouds.areScanAndMap();
  const auto build = [&](const JudgingCloud& cloud,
                         const Vec3& centre,
                         bool in_order,
                         Surface& surface) {
    std::visit(
        [&](const auto& view) {
          surface.build(view, centre - cloud.shift, spacing, in_order);
        },
        cloud.view);
  };
  const JudgingCloud& target = clouds.target;
  const bool is_made = is_map && target.surface && target.spacing == clouds.spacing;
  pool_.forEach(is_made ? 1 : 2, [&](std::size_t side, std::size_t) {
    if (side == 0)
      build(clouds.source, preparation_.source_centre, false, source_surface_);
    else
      build(target, preparation_.target_centre, is_map, target_surface_);
  });
  const Surface& target_surface = is_made ? *target.surface : target_surface_;
  if (is_map)
    vicinity_.build(source_surface_, target_surface);
  return {source_surface_,
          target_surface,
          spacing,
          Belief::Viewpoints,
          problem_.upright,
          is_map ? &vicinity_ : nullptr};
}

template <typename Scalar>
Result
PoseSearch::run(const CorrespondenceView<Scalar>& correspondences,
                const Parameters& parameters,
                const std::optional<RigidTransform>& guess,
                const JudgingClouds* clouds,
                const SecondLook& second_look)
{
  parameters.validate();
  checkCorrespondences(correspondences);
  Result result;
  result.backend = backend_->name();
  StageClock clock(result.timings_ms);
  // A map's surface does not depend on what is looked for in it.
  std::optional<Vec3> middle;
  if (clouds && clouds->areScanAndMap())
    middle = clouds->target.middle();
  prepare(correspondences, parameters, middle, preparation_, problem_);
  result.correspondences_used = preparation_.rows.size();
  result.correspondences_dropped = preparation_.dropped;
  result.correspondences_invalid = preparation_.invalid;
  std::optional<Pose> centred_guess;
  if (guess && guess->rotation.allFinite() && guess->translation.allFinite()) {
    centred_guess = toCentred(*guess);
    // Turned back about the centre of the source.
    limitTilt(problem_.upright, centred_guess->r);
  }
  clock.finish(&StageTimings::preparation);

  if (problem_.size >= 3) {
    PoseEstimate estimate = backend_->run(problem_,
                                          withRivals(parameters, clouds != nullptr),
                                          centred_guess,
                                          clouds != nullptr,
                                          clock,
                                          trace_);
    CloudFindings findings;
    std::vector<Pose> motions;
    if (estimate.status == Status::Ok) {
      addSecondBest(parameters, estimate, clock);
      motions.push_back(estimate.hypotheses.front().pose);
    }
    // Where these correspondences show no pose, others of the same clouds may.
    if (clouds && (estimate.status == Status::Ok || second_look))
      findings = askClouds(*clouds, parameters, second_look, estimate, clock);
    if (findings.evidence.has_clouds)
      motions.push_back(estimate.hypotheses.front().pose);
    if (estimate.status == Status::Ok)
      findings.evidence.mirrored = mirroredEvidence(
          problem_, estimate.cliques, motions, parameters.inlier_distance, pool_);
    if (estimate.status == Status::Ok && !findings.evidence.has_clouds)
      findings.evidence.tilted = tiltedEvidence(problem_,
                                                nullptr,
                                                estimate.hypotheses.front().pose,
                                                parameters.inlier_distance);
    fill(result, estimate, findings, parameters);
    clock.finish(&StageTimings::cloud_check);
  }
  clock.finishAll();
  return result;
}

template Result
PoseSearch::run(const CorrespondenceView<float>&,
                const Parameters&,
                const std::optional<RigidTransform>&,
                const JudgingClouds*,
                const SecondLook&);
template Result
PoseSearch::run(const CorrespondenceView<double>&,
                const Parameters&,
                const std::optional<RigidTransform>&,
                const JudgingClouds*,
                const SecondLook&);

const char*
toString(Status status)
{
  switch (status) {
  case Status::Ok:
    return "pose found";
  case Status::TooFewCorrespondences:
    return "fewer than three usable correspondences";
  case Status::NoClique:
    return "no three correspondences preserve their mutual distances";
  case Status::Degenerate:
    return "the consistent correspondences are collinear, coincident, or fewer than "
           "three "
           "agree with any pose";
  }
  return "unknown status";
}

} // namespace pcl_flashreg
