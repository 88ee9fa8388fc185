// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/agreement.h"

#include "math/rigid_float.h"

#include <algorithm>

namespace pcl_flashreg {
namespace {

/** \brief Points whose normals differ by more than 60 degrees don't match. */
constexpr float MIN_COSINE = 0.5f;

/** \brief A point this near to a surface, in spacings, can't contradict it, whatever its
 * normal: the surface itself is not free space. */
constexpr float TOUCHING = 1;

/** \brief Sums over the points of one cloud. */
struct Sums {
  double matched = 0, contradicted = 0;
  std::size_t points = 0;
};

/** \brief 1 - (d / tolerance)^2 of the distance to the tangent plane, times the cosine of
 * the normals; 0 for a point that does not match. */
float
matchOf(const Surface& to,
        int neighbor,
        const Eigen::Vector3f& place,
        float cosine,
        float limit)
{
  const float off = to.normals[neighbor].dot(place - to.points[neighbor]) / limit;
  return cosine * std::max(0.0f, 1 - off * off);
}

Sums
look(const Surface& from,
     const Surface& to,
     const RigidFloat& pose,
     float spacing,
     bool oriented,
     const Effort& effort)
{
  const float limit = effort.tolerance * spacing;
  const float touching = TOUCHING * spacing;
  Sums sums;
  sums.points = std::min(effort.points, from.points.size());
  for (std::size_t k = 0; k < sums.points; ++k) {
    const std::size_t i = k * from.points.size() / sums.points;
    const Eigen::Vector3f place = pose * from.points[i];
    const int neighbor = to.nearest.find(place);
    if (neighbor >= 0) {
      const float squared = (place - to.points[neighbor]).squaredNorm();
      const float cosine =
          alignmentOf(pose.rotation * from.normals[i], to.normals[neighbor], oriented);
      if (squared < limit * limit && cosine > MIN_COSINE) {
        sums.matched += matchOf(to, neighbor, place, cosine, limit);
        continue;
      }
      if (squared < touching * touching)
        continue;
    }
    sums.contradicted += to.free_space.contains(place) ? 1 : 0;
  }
  return sums;
}

/** \brief From the sums over the one cloud whose sensor is known, and over the other. */
CloudAgreement
seenFromOne(const Sums& seeing,
            std::size_t seeing_points,
            const Sums& seen,
            std::size_t seen_points)
{
  // Points of the other cloud that hang in the empty space, over what would fill the view.
  const double contradicting = seen.contradicted / static_cast<double>(seen.points) *
                               static_cast<double>(seen_points);
  return {seeing.matched / static_cast<double>(seeing.points),
          std::min(1.0, contradicting / static_cast<double>(seeing_points))};
}

} // namespace

CloudAgreement
agreementOf(const SurfacePair& clouds, const Pose& pose, const Effort& effort)
{
  const RigidFloat forward = toRigidFloat(pose);
  const bool oriented = clouds.oriented();
  const Sums there =
      look(clouds.source, clouds.target, forward, clouds.spacing, oriented, effort);
  const Sums back = look(
      clouds.target, clouds.source, inverse(forward), clouds.spacing, oriented, effort);
  const std::size_t sources = clouds.source.points.size();
  const std::size_t targets = clouds.target.points.size();
  if (clouds.seeing() && !oriented)
    return clouds.source.free_space.known()
               ? seenFromOne(there, sources, back, targets)
               : seenFromOne(back, targets, there, sources);
  // Each side counts by the number of its points, however many were looked at.
  const auto source_points = static_cast<double>(sources);
  const auto target_points = static_cast<double>(targets);
  const auto share = [&](double of_source, double of_target) {
    return (of_source * source_points / static_cast<double>(there.points) +
            of_target * target_points / static_cast<double>(back.points)) /
           (source_points + target_points);
  };
  return {share(there.matched, back.matched),
          share(there.contradicted, back.contradicted)};
}

} // namespace pcl_flashreg
