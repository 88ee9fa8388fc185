// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cloud_check.h"

#include "judgement/cpu/plane_alignment.h"
#include "judgement/confidence.h"
#include "judgement/evidence.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief A pose that has not been moved onto the surface yet is off by a spacing or two,
 * which the wider tolerance makes up for. */
constexpr Effort GLANCE{24, 2.0f}, LOOK{128, 2.0f}, STUDY{1000, 1.5f};

/** \brief Hypotheses that pass the first screening, and the second. */
constexpr std::size_t AFTER_GLANCE = 400, AFTER_LOOK = 12;

/** \brief Poses are the same if no corner of the cube around the source moves by more
 * than this many spacings, before they are moved onto the surface and after. */
constexpr float SAME_BEFORE = 6, SAME_AFTER = 10;

/** \brief Shares of points below which nothing can be told. */
constexpr double FLOOR = 0.01;

/** \brief Evidence::lead at most. */
constexpr double MAX_LEAD = 5;

/** \brief A pose that is this certain without the viewpoints, and not with them, is
 * believed: it is the viewpoints that are wrong. */
constexpr double BELIEVED_BLINDLY = 0.95;

struct Ranked {
  double evidence;
  std::uint32_t hypothesis;
};

bool
better(const Ranked& a, const Ranked& b)
{
  return a.evidence > b.evidence ||
         (a.evidence == b.evidence && a.hypothesis < b.hypothesis);
}

/** \brief By the clouds alone. */
double
evidenceOf(const CloudAgreement& agreement)
{
  return agreement.matched / (agreement.matched + agreement.contradicted + FLOOR);
}

void
rank(const SurfacePair& clouds,
     const std::vector<Pose>& hypotheses,
     const Effort& effort,
     std::vector<Ranked>& ranked,
     ThreadPool& pool)
{
  constexpr std::size_t A_TASK = 32;
  pool.forEach(
      (ranked.size() + A_TASK - 1) / A_TASK, [&](std::size_t task, std::size_t) {
        const std::size_t end = std::min(ranked.size(), (task + 1) * A_TASK);
        for (std::size_t i = task * A_TASK; i < end; ++i)
          ranked[i].evidence =
              evidenceOf(agreementOf(clouds, hypotheses[ranked[i].hypothesis], effort));
      });
}

/** \brief Largest displacement between two poses over the corners of a cube of this half
 * side around the centre of the source. */
double
displacementOf(const Pose& a, const Pose& b, double half_side)
{
  double largest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{corner & 1 ? half_side : -half_side,
                 corner & 2 ? half_side : -half_side,
                 corner & 4 ? half_side : -half_side};
    const Vec3 d = transform(a, p) - transform(b, p);
    largest = std::max(largest, std::sqrt(dot(d, d)));
  }
  return largest;
}

double
halfSideOf(const Surface& source)
{
  float squared = 0;
  for (const Eigen::Vector3f& point : source.points)
    squared = std::max(squared, point.squaredNorm());
  return std::sqrt(squared / 3.0);
}

/** \brief Appends the best hypotheses that differ from each other and from those in the
 * list. */
void
screen(const SurfacePair& clouds,
       const std::vector<Pose>& hypotheses,
       double half_side,
       std::vector<Pose>& list,
       ThreadPool& pool)
{
  std::vector<Ranked> ranked(hypotheses.size());
  for (std::size_t i = 0; i < ranked.size(); ++i)
    ranked[i].hypothesis = static_cast<std::uint32_t>(i);
  if (ranked.size() > AFTER_GLANCE) {
    rank(clouds, hypotheses, GLANCE, ranked, pool);
    std::nth_element(
        ranked.begin(), ranked.begin() + AFTER_GLANCE, ranked.end(), better);
    ranked.resize(AFTER_GLANCE);
  }
  rank(clouds, hypotheses, LOOK, ranked, pool);
  std::sort(ranked.begin(), ranked.end(), better);
  const std::size_t wanted = list.size() + AFTER_LOOK;
  for (const Ranked& entry : ranked) {
    if (list.size() == wanted)
      return;
    const Pose& pose = hypotheses[entry.hypothesis];
    if (std::none_of(list.begin(), list.end(), [&](const Pose& other) {
          return displacementOf(pose, other, half_side) < SAME_BEFORE * clouds.spacing;
        }))
      list.push_back(pose);
  }
}

/** \brief What speaks for a pose, as a logarithm. */
double
weightOf(const CheckedPose& pose, bool with_viewpoints)
{
  const CloudAgreement& agreement = pose.agreement;
  return std::log(agreement.matched + FLOOR) -
         (with_viewpoints ? std::log(agreement.contradicted + FLOOR) : 0) +
         0.5 * std::log(pose.inlier_count + 5.0);
}

/** \brief Ranks the poses and gathers the evidence for the best. */
CloudFindings
judge(const SurfacePair& clouds,
      std::vector<CheckedPose> checked,
      double half_side,
      bool with_viewpoints)
{
  const auto weight = [&](const CheckedPose& pose) {
    return weightOf(pose, with_viewpoints);
  };
  std::stable_sort(checked.begin(), checked.end(), [&](const auto& a, const auto& b) {
    return weight(a) > weight(b);
  });
  CloudFindings findings;
  std::vector<CheckedPose>& poses = findings.poses;
  for (const CheckedPose& pose : checked)
    if (std::none_of(poses.begin(), poses.end(), [&](const CheckedPose& other) {
          return displacementOf(pose.pose, other.pose, half_side) <
                 SAME_AFTER * clouds.spacing;
        }))
      poses.push_back(pose);
  Evidence& evidence = findings.evidence;
  evidence.inliers = poses.front().inlier_count;
  evidence.has_clouds = true;
  evidence.has_viewpoints = with_viewpoints;
  evidence.one_viewpoint = with_viewpoints && !clouds.oriented();
  evidence.agreement = poses.front().agreement;
  evidence.lead = MAX_LEAD;
  if (poses.size() > 1)
    evidence.lead = std::min(MAX_LEAD, weight(poses[0]) - weight(poses[1]));
  evidence.stiffness = stiffnessOf(clouds, poses.front().pose);
  return findings;
}

} // namespace

CloudFindings
checkOnClouds(const SurfacePair& clouds,
              const Problem& problem,
              const std::vector<Pose>& hypotheses,
              const std::vector<ScoredPose>& favourites,
              float inlier_distance,
              ThreadPool& pool)
{
  std::vector<Pose> list;
  for (const ScoredPose& favourite : favourites)
    list.push_back(favourite.pose);
  if (clouds.source.points.empty() || clouds.target.points.empty() || list.empty())
    return {};
  const double half_side = halfSideOf(clouds.source);
  if (clouds.seeing())
    screen(clouds, hypotheses, half_side, list, pool);

  std::vector<CheckedPose> checked(list.size());
  pool.forEach(list.size(), [&](std::size_t i, std::size_t) {
    CheckedPose& result = checked[i];
    result.pose = moveOntoTarget(clouds, list[i]);
    result.agreement = agreementOf(clouds, result.pose, STUDY);
    result.inlier_count =
        static_cast<int>(inliersOf(problem, result.pose, inlier_distance).size());
  });
  CloudFindings blind = judge(clouds, checked, half_side, false);
  if (!clouds.seeing())
    return blind;
  CloudFindings seeing = judge(clouds, std::move(checked), half_side, true);
  const double enough = std::max(BELIEVED_BLINDLY, confidenceOfClouds(seeing.evidence));
  return confidenceOfClouds(blind.evidence) > enough ? blind : seeing;
}

} // namespace pcl_flashreg
