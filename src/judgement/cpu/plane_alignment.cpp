// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/plane_alignment.h"

#include "math/rigid_float.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_flashreg {
namespace {

constexpr int ROUNDS = 6;
/** \brief Points of the source that are used at most: for a step, for the stiffness. */
constexpr std::size_t POINTS = 400, STIFFNESS_POINTS = 1000;
/** \brief Distance of a point from its plane's point, in spacings, in the first round and
 * in the last. */
constexpr float FIRST_RADIUS = 2, LAST_RADIUS = 1;
/** \brief Cosine of the normals, about 45 degrees. */
constexpr float MIN_COSINE = 0.7f;
/** \brief The same two lengths for the stiffness, of a pose that is final. */
constexpr float STIFFNESS_RADIUS = 1.5f, STIFFNESS_COSINE = 0.85f;
/** \brief Residual that halves a point's weight, in spacings. */
constexpr float SOFTNESS = 0.5f;
constexpr std::size_t MIN_PLANES = 10;
/** \brief Stiffness that holds a direction which few planes constrain, a point. */
constexpr double STIFFNESS = 0.01;

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/** \brief Which points are drawn to which planes. */
struct Reach {
  std::size_t points;
  float radius;
  float min_cosine;
};

/** \brief A source point where it is now, and the tangent plane it is drawn to. */
struct Pull {
  Eigen::Vector3f place;
  Eigen::Vector3f normal;
  float residual;
};

void
findPulls(const SurfacePair& clouds,
          const RigidFloat& pose,
          const Reach& reach,
          std::vector<Pull>& pulls)
{
  const Surface &source = clouds.source, &target = clouds.target;
  const bool oriented = clouds.oriented();
  const std::size_t count = std::min(reach.points, source.points.size());
  const float limit = reach.radius * clouds.spacing;
  pulls.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k * source.points.size() / count;
    const Eigen::Vector3f place = pose * source.points[i];
    const int neighbor = target.nearest.find(place);
    if (neighbor < 0)
      continue;
    const Eigen::Vector3f offset = place - target.points[neighbor];
    const Eigen::Vector3f& normal = target.normals[neighbor];
    const float cosine =
        alignmentOf(pose.rotation * source.normals[i], normal, oriented);
    if (offset.squaredNorm() <= limit * limit && cosine >= reach.min_cosine)
      pulls.push_back({place, normal, normal.dot(offset)});
  }
}

Eigen::Vector3d
middleOf(const std::vector<Pull>& pulls)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Pull& pull : pulls)
    sum += pull.place.cast<double>();
  return sum / static_cast<double>(pulls.size());
}

/** \brief How the distance to the plane changes with a turn and a shift. */
Vector6
jacobianOf(const Pull& pull, const Eigen::Vector3d& arm)
{
  const Eigen::Vector3d normal = pull.normal.cast<double>();
  Vector6 jacobian;
  jacobian << arm.cross(normal), normal;
  return jacobian;
}

/** \brief One step of Gauss-Newton: a small turn about the middle of the points, and a
 * shift. */
void
step(const std::vector<Pull>& pulls, float softness, RigidFloat& pose)
{
  const Eigen::Vector3d middle = middleOf(pulls);
  Matrix6 hessian = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  double spread = 0;
  for (const Pull& pull : pulls) {
    const Eigen::Vector3d arm = pull.place.cast<double>() - middle;
    const Vector6 jacobian = jacobianOf(pull, arm);
    const double scaled = pull.residual / softness;
    const double weight = 1 / (1 + scaled * scaled);
    hessian += weight * jacobian * jacobian.transpose();
    gradient += weight * pull.residual * jacobian;
    spread += arm.squaredNorm();
  }
  hessian.diagonal().head<3>().array() += STIFFNESS * spread;
  hessian.diagonal().tail<3>().array() += STIFFNESS * static_cast<double>(pulls.size());
  const Vector6 motion = -hessian.ldlt().solve(gradient);
  const Eigen::Vector3d turn = motion.head<3>();
  const double angle = turn.norm();
  if (!motion.allFinite() || !(angle > 0))
    return;
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  const Eigen::Vector3d shifted =
      rotation * (pose.translation.cast<double>() - middle) + middle + motion.tail<3>();
  pose.rotation = (rotation * pose.rotation.cast<double>()).cast<float>();
  pose.translation = shifted.cast<float>();
}

} // namespace

Pose
moveOntoTarget(const SurfacePair& clouds, const Pose& pose)
{
  RigidFloat moved = toRigidFloat(pose);
  std::vector<Pull> pulls;
  for (int round = 0; round < ROUNDS; ++round) {
    const float t = static_cast<float>(round) / (ROUNDS - 1);
    const float radius = FIRST_RADIUS + t * (LAST_RADIUS - FIRST_RADIUS);
    findPulls(clouds, moved, {POINTS, radius, MIN_COSINE}, pulls);
    if (pulls.size() < MIN_PLANES)
      break;
    step(pulls, SOFTNESS * clouds.spacing, moved);
  }
  Pose result;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(result.r) =
      Eigen::Quaterniond(moved.rotation.cast<double>()).normalized().toRotationMatrix();
  Eigen::Map<Eigen::Vector3d>(result.t) = moved.translation.cast<double>();
  return result;
}

double
stiffnessOf(const SurfacePair& clouds, const Pose& pose)
{
  std::vector<Pull> pulls;
  findPulls(clouds,
            toRigidFloat(pose),
            {STIFFNESS_POINTS, STIFFNESS_RADIUS, STIFFNESS_COSINE},
            pulls);
  if (pulls.empty())
    return 0;
  const Eigen::Vector3d middle = middleOf(pulls);
  double squared_spread = 0;
  for (const Pull& pull : pulls)
    squared_spread += (pull.place.cast<double>() - middle).squaredNorm();
  squared_spread /= static_cast<double>(pulls.size());
  if (!(squared_spread > 0))
    return 0;
  Matrix6 hessian = Matrix6::Zero();
  for (const Pull& pull : pulls) {
    const Vector6 jacobian = jacobianOf(
        pull, (pull.place.cast<double>() - middle) / std::sqrt(squared_spread));
    hessian += jacobian * jacobian.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(hessian, Eigen::EigenvaluesOnly);
  const auto looked_at =
      static_cast<double>(std::min(STIFFNESS_POINTS, clouds.source.points.size()));
  return std::max(0.0, solver.eigenvalues()[0]) / looked_at;
}

} // namespace pcl_flashreg
