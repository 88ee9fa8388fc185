// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/agreement.h"

#include "math/rigid_float.h"

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
  std::size_t points = 0;
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
  sums.points = from.points.size();
  Eigen::Vector3f places[A_BLOCK];
  int neighbors[A_BLOCK];
  for (std::size_t first = 0; first < sums.points; first += A_BLOCK) {
    const std::size_t count = std::min(A_BLOCK, sums.points - first);
    // All look-ups first: then they wait for the memory together.
    for (std::size_t k = 0; k < count; ++k) {
      places[k] = pose * from.points[first + k];
      neighbors[k] = to.nearest.find(places[k]);
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
seenFromBoth(const Sums& there,
             std::size_t source_points,
             const Sums& back,
             std::size_t target_points)
{
  const auto sources = static_cast<double>(source_points);
  const auto targets = static_cast<double>(target_points);
  const auto share = [&](double of_source, double of_target) {
    return (of_source * sources / static_cast<double>(there.points) +
            of_target * targets / static_cast<double>(back.points)) /
           (sources + targets);
  };
  return {share(there.matched, back.matched),
          share(there.contradicted, back.contradicted),
          0};
}

/** \brief Sums over the one cloud whose sensor is known, and over the other. */
struct OneSees {
  const Sums& seeing;
  std::size_t seeing_points;
  const Sums& seen;
  std::size_t seen_points;
};

/** \brief As it is from both, but that of a larger cloud as much counts as the other one
 * has. */
CloudAgreement
seenFromOneWithSides(const OneSees& one)
{
  const auto seers = static_cast<double>(one.seeing_points);
  const auto all = static_cast<double>(one.seen_points);
  const double counting = std::min(seers, all);
  const auto of_seers = [&](double sum) {
    return sum / static_cast<double>(one.seeing.points) * seers;
  };
  const double seen = static_cast<double>(one.seen.points);
  return {(of_seers(one.seeing.matched) + one.seen.matched / seen * counting) /
              (seers + counting * counting / all),
          std::min(
              1.0,
              (of_seers(one.seeing.contradicted) + one.seen.contradicted / seen * all) /
                  (seers + counting)),
          0};
}

/** \brief As the one that sees sees it. */
CloudAgreement
seenFromOne(const OneSees& one)
{
  const auto& [seeing, seeing_points, seen, seen_points] = one;
  // Points of the other cloud that hang in the empty space, over what would fill the view.
  const double contradicting = seen.contradicted / static_cast<double>(seen.points) *
                               static_cast<double>(seen_points);
  return {seeing.matched / static_cast<double>(seeing.points),
          std::min(1.0, contradicting / static_cast<double>(seeing_points)),
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

Samples::Samples(const Surface& cloud, std::size_t most)
{
  const std::size_t count = std::min(most, cloud.points.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k * cloud.points.size() / count;
    points.push_back(cloud.points[i]);
    normals.push_back(cloud.normals[i]);
  }
}

Look::Look(const SurfacePair& clouds, std::size_t points, float tolerance, float margin)
    : clouds_(clouds),
      tolerance_(tolerance),
      margin_(margin),
      source_(clouds.source, points),
      target_(clouds.target, points)
{
}

CloudAgreement
Look::operator()(const Pose& pose) const
{
  const RigidFloat forward = toRigidFloat(pose);
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
  const Sums back = lookAt(target_, clouds_.source, inverse(forward));
  const std::size_t sources = clouds_.source.points.size();
  const std::size_t targets = clouds_.target.points.size();
  CloudAgreement agreement;
  if (clouds_.viewpoints() != 1) {
    agreement = seenFromBoth(there, sources, back, targets);
  }
  else {
    const OneSees one = clouds_.source.free_space.known()
                            ? OneSees{there, sources, back, targets}
                            : OneSees{back, targets, there, sources};
    agreement = clouds_.hasSides() ? seenFromOneWithSides(one) : seenFromOne(one);
  }
  agreement.residual = residualOf(there, back, spacing);
  return agreement;
}

} // namespace pcl_flashreg
