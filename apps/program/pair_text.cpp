// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pair_text.h"

#include <pcl_flashreg/impl/number_text.hpp>

#include <Eigen/Eigenvalues>

namespace pcl_flashreg::program {
namespace {

/** \brief Smallest, middle and largest standard deviation of the keypoints along their
 * principal axes. */
Eigen::Vector3d
spreadOf(const Scan& scan)
{
  const Eigen::Map<const Eigen::Matrix3Xf> points(
      scan.points(), 3, static_cast<Eigen::Index>(scan.size()));
  const Eigen::Matrix3Xd offsets =
      points.cast<double>().colwise() - points.cast<double>().rowwise().mean();
  const Eigen::Matrix3d covariance =
      offsets * offsets.transpose() / static_cast<double>(scan.size());
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance,
                                                        Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseMax(0.0)
      .cwiseSqrt();
}

} // namespace

std::string
vectorText(const Eigen::Vector3d& v)
{
  return "(" + detail::toText(v.x()) + " " + detail::toText(v.y()) + " " +
         detail::toText(v.z()) + ")";
}

std::string
viewpointDoubt(const Scan& scan, const Eigen::Vector3d& stated)
{
  if (scan.empty() || scan.viewpointSource() == ViewpointSource::Stated)
    return "";
  const std::string not_seen =
      "its points were not seen from its viewpoint, " + vectorText(stated);
  if (scan.viewpointSource() == ViewpointSource::Points)
    return not_seen + ", but from about " + vectorText(*scan.viewpoint()) +
           ", by how they lie: that is used";
  return not_seen + ", nor from any one place: none is used";
}

std::string
flatnessDoubt(const Scan& scan)
{
  constexpr double FLAT = 0.05;
  if (scan.empty() || spreadOf(scan)[0] >= FLAT * scan.spacing())
    return "";
  return "is flat: all its points lie in one plane, in which they can slide and turn; "
         "such clouds hold no pose in space";
}

std::string
wantOf(const Evidence& evidence)
{
  // Where the confidence is at most an even chance (docs/method.md).
  constexpr double MIRRORED = 1.2, SOFT = 0.004, LOOSE = 0.2, RIVALS = 1, NARROW = 1;
  if (evidence.mirrored > MIRRORED)
    return "a mirror image explains the correspondences better: is an axis flipped?";
  if (evidence.tilted > RIVALS)
    return "a pose that gravity forbids explains more: is its direction right?";
  if (evidence.has_clouds) {
    if (evidence.stiffness < SOFT || evidence.hold < LOOSE)
      return "the clouds match as well where it is moved off";
    return evidence.rivals > RIVALS ? "other poses explain the clouds as well" : "";
  }
  if (evidence.breadth < NARROW)
    return "those that agree lie on a line, about which it may turn";
  return evidence.log_chance > 0 ? "as many would agree by chance" : "";
}

} // namespace pcl_flashreg::program
