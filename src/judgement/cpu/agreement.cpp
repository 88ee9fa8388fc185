// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/agreement.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief Points whose normals differ by more than 60 degrees don't match. */
constexpr float MIN_COSINE = 0.5f;

/** \brief A point this near to a surface, in spacings, can't contradict it, whatever its
 * normal: the surface itself is not free space. */
constexpr float TOUCHING = 1;

/** \brief How far before a surface is empty where nothing but its normals is known, in
 * spacings: somebody looked at it, but who knows from where. */
constexpr float BEFORE = 6;

/** \brief Sums over the points of one cloud. */
struct Sums {
  double matched = 0, contradicted = 0;
  /** \brief Points that match, and the sum of their squared distances from the planes. */
  double matches = 0, squares = 0;
  /** \brief Points, and how many of their cloud these stand for. */
  double points = 0, stand_for = 0;

  /** \brief A share of the points; 0 of none. */
  double
  share(double part) const
  {
    return points > 0 ? part / points : 0;
  }
};

/** \brief What counts as what; lengths in the unit of the clouds. */
struct Limits {
  float match, touch, margin, before;
  bool oriented;
  /** \brief Whether what the other cloud's sensor looked through is empty. */
  bool by_viewpoint;
  /** \brief Whether it is what is just before its surfaces. */
  bool by_sides;
};

/** \brief Whether there can be nothing at a place, as it is before a surface that was seen,
 * and near to it. */
bool
isBefore(const Surface& surface, const Eigen::Vector3f& place, const Limits& limits)
{
  const int near = surface.around.find(place);
  if (near < 0)
    return false;
  const Eigen::Vector3f offset = place - surface.points[near];
  return surface.normals[near].dot(offset) > limits.match &&
         offset.squaredNorm() < limits.before * limits.before;
}

Sums
sumUp(const Samples& from,
      const Surface& to,
      const RigidFloat& pose,
      const Limits& limits)
{
  constexpr std::size_t A_BLOCK = 64;
  Sums sums;
  const std::size_t points = from.points.size();
  sums.points = static_cast<double>(points);
  sums.stand_for = static_cast<double>(from.stand_for);
  Eigen::Vector3f places[A_BLOCK];
  int neighbors[A_BLOCK];
  for (std::size_t first = 0; first < points; first += A_BLOCK) {
    const std::size_t count = std::min(A_BLOCK, points - first);
    // All look-ups first: then they wait for the memory together.
    for (std::size_t k = 0; k < count; ++k) {
      places[k] = pose * from.points[first + k];
      neighbors[k] = to.nearest.find(places[k]);
      if (neighbors[k] >= 0) {
        __builtin_prefetch(&to.points[neighbors[k]]);
        __builtin_prefetch(&to.normals[neighbors[k]]);
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Eigen::Vector3f& place = places[k];
      if (const int neighbor = neighbors[k]; neighbor >= 0) {
        const float squared = (place - to.points[neighbor]).squaredNorm();
        const float cosine = alignmentOf(pose.rotation * from.normals[first + k],
                                         to.normals[neighbor],
                                         limits.oriented);
        if (squared < limits.match * limits.match && cosine > MIN_COSINE) {
          // 1 - (d / tolerance)^2 of the distance to the tangent plane.
          const float off = to.normals[neighbor].dot(place - to.points[neighbor]);
          const float relative = off / limits.match;
          sums.matched += cosine * std::max(0.0f, 1 - relative * relative);
          sums.matches += 1;
          sums.squares += off * off;
          continue;
        }
        // A surface that was seen from its other side.
        if (limits.by_sides && squared < limits.match * limits.match) {
          sums.contradicted += cosine < -MIN_COSINE ? 1 : 0;
          continue;
        }
        if (squared < limits.touch * limits.touch)
          continue;
      }
      const bool is_empty =
          limits.by_sides
              ? isBefore(to, place, limits)
              : limits.by_viewpoint && to.free_space.contains(place, limits.margin);
      sums.contradicted += is_empty ? 1 : 0;
    }
  }
  return sums;
}

/** \brief From the sums over both clouds: each side counts by the number of its points,
 * however many were looked at. */
CloudAgreement
seenFromBoth(const Sums& there, const Sums& back)
{
  const auto share = [&](double of_source, double of_target) {
    return (there.share(of_source) * there.stand_for +
            back.share(of_target) * back.stand_for) /
           (there.stand_for + back.stand_for);
  };
  return {share(there.matched, back.matched),
          share(there.contradicted, back.contradicted),
          0};
}

/** \brief Sums over the one cloud whose sensor is known, and over the other. */
struct OneSees {
  const Sums& seeing;
  const Sums& seen;
};

/** \brief As it is from both, but that of a larger cloud as much counts as the other one
 * has. */
CloudAgreement
seenFromOneWithSides(const OneSees& one)
{
  const auto& [seeing, seen] = one;
  const double seers = seeing.stand_for, all = seen.stand_for;
  const double counting = std::min(seers, all);
  return {(seeing.share(seeing.matched) * seers + seen.share(seen.matched) * counting) /
              (seers + counting * counting / all),
          std::min(1.0,
                   (seeing.share(seeing.contradicted) * seers +
                    seen.share(seen.contradicted) * all) /
                       (seers + counting)),
          0};
}

/** \brief As the one that sees sees it. */
CloudAgreement
seenFromOne(const OneSees& one)
{
  const auto& [seeing, seen] = one;
  // Points of the other cloud that hang in the empty space, over what would fill the view.
  const double contradicting = seen.share(seen.contradicted) * seen.stand_for;
  return {
      seeing.share(seeing.matched), std::min(1.0, contradicting / seeing.stand_for), 0};
}

/** \brief By how much of a point one counts that the map does not show. */
constexpr double MISSING = 0.1;

/** \brief As the scan sees it that is looked for in a map. What a map does not show speaks
 * against a place, too: elsewhere it would be explained. */
CloudAgreement
seenInMap(const Sums& scan, const Sums& map)
{
  const double missing = scan.points - scan.matches - scan.contradicted;
  const double contradicting = map.share(map.contradicted) * map.stand_for;
  return {scan.share(scan.matched),
          std::min(1.0,
                   scan.share(scan.contradicted + MISSING * missing) +
                       contradicting / scan.stand_for),
          0};
}

/** \brief CloudAgreement::residual */
double
residualOf(const Sums& there, const Sums& back, double spacing)
{
  const double matches = there.matches + back.matches;
  return matches > 0 ? std::sqrt((there.squares + back.squares) / matches) / spacing
                     : 0;
}

} // namespace

Samples::Samples(const Surface& cloud, const PointRanges& numbers, std::size_t most)
    : stand_for(numbers.size())
{
  const std::size_t count = std::min(most, stand_for);
  points.reserve(count);
  normals.reserve(count);
  numbers.forSome(most, [&](std::size_t i) {
    points.push_back(cloud.points[i]);
    normals.push_back(cloud.normals[i]);
  });
}

Look::Look(const SurfacePair& clouds, std::size_t points, float tolerance, float margin)
    : clouds_(clouds),
      points_(points),
      tolerance_(tolerance),
      margin_(margin),
      source_(clouds.source, PointRanges(clouds.source.points.size()), points)
{
  if (!clouds.vicinity)
    target_.emplace(clouds.target, PointRanges(clouds.target.points.size()), points);
}

CloudAgreement
Look::operator()(const Pose& pose) const
{
  const RigidFloat forward = toRigidFloat(pose);
  std::optional<Samples> near;
  if (!target_)
    near.emplace(clouds_.target, clouds_.targetUnder(forward), points_);
  const Samples& target = target_ ? *target_ : *near;
  const float spacing = clouds_.spacing;
  Limits limits{tolerance_ * spacing,
                TOUCHING * spacing,
                margin_ * spacing,
                BEFORE * spacing,
                clouds_.oriented(),
                clouds_.belief != Belief::Nothing,
                false};
  const auto lookAt = [&](const Samples& from, const Surface& to, const RigidFloat& T) {
    limits.by_sides = clouds_.hasSides() && to.has_sides;
    return sumUp(from, to, T, limits);
  };
  const Sums there = lookAt(source_, clouds_.target, forward);
  const Sums back = lookAt(target, clouds_.source, inverse(forward));
  CloudAgreement agreement;
  if (clouds_.vicinity) {
    agreement = seenInMap(there, back);
  }
  else if (clouds_.viewpoints() != 1) {
    agreement = seenFromBoth(there, back);
  }
  else {
    const OneSees one =
        clouds_.source.free_space.known() ? OneSees{there, back} : OneSees{back, there};
    agreement = clouds_.hasSides() ? seenFromOneWithSides(one) : seenFromOne(one);
  }
  agreement.residual = residualOf(there, back, spacing);
  return agreement;
}

} // namespace pcl_flashreg
