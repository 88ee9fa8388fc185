// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/pose_graph.h"

#include "math/isometry.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <cmath>
#include <map>
#include <utility>

namespace pcl_flashreg {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Poses = std::vector<Eigen::Isometry3d>;

constexpr int ROUNDS = 30;
/** \brief It is enough when a round gains less than this share of the cost. */
constexpr double ENOUGH = 1e-7;
constexpr double FIRST_DAMPING = 1e-6, MOST_DAMPING = 1e6;

Eigen::Matrix3d
turnBy(const Eigen::Vector3d& turn)
{
  const double angle = turn.norm();
  if (!(angle > 0))
    return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

double
costOf(const std::vector<PoseConstraint>& constraints, const Poses& poses)
{
  double cost = 0;
  for (const PoseConstraint& c : constraints) {
    const Vector6 r = residualOf(c, poses[c.target], poses[c.source]);
    cost += c.weight * std::log1p(r.dot(c.hessian * r));
  }
  return cost;
}

/** \brief How a constraint's residual changes with motions of a node in the map's frame, about
 * the node's own place; of the source, with the sign of the target turned. */
Matrix6
jacobianOf(const PoseConstraint& c,
           const Eigen::Isometry3d& target,
           const Eigen::Isometry3d& node)
{
  const Eigen::Matrix3d back = target.linear().transpose();
  const Eigen::Vector3d arm = target * c.middle - node.translation();
  Matrix6 jacobian = Matrix6::Zero();
  jacobian.topLeftCorner<3, 3>() = back;
  jacobian.bottomLeftCorner<3, 3>() = -back * crossMatrix(arm);
  jacobian.bottomRightCorner<3, 3>() = back;
  return jacobian;
}

/** \brief The normal equations; the first node is not among the unknowns. */
struct System {
  std::map<std::pair<std::size_t, std::size_t>, Matrix6> blocks;
  Eigen::VectorXd gradient;

  void
  add(std::size_t row, std::size_t column, const Matrix6& block)
  {
    if (row == 0 || column == 0 || row < column)
      return;
    const auto [at, is_new] = blocks.try_emplace({row, column}, Matrix6::Zero());
    at->second += block;
  }

  void
  addGradient(std::size_t node, const Vector6& part)
  {
    if (node != 0)
      gradient.segment<6>(6 * static_cast<Eigen::Index>(node - 1)) += part;
  }
};

System
linearize(const std::vector<PoseConstraint>& constraints, const Poses& poses)
{
  System system;
  system.gradient.setZero(6 * static_cast<Eigen::Index>(poses.size() - 1));
  for (const PoseConstraint& c : constraints) {
    const Vector6 r = residualOf(c, poses[c.target], poses[c.source]);
    const Matrix6 weighted = c.weight / (1 + r.dot(c.hessian * r)) * c.hessian;
    const Matrix6 of_source = jacobianOf(c, poses[c.target], poses[c.source]);
    const Matrix6 of_target = -jacobianOf(c, poses[c.target], poses[c.target]);
    system.add(c.source, c.source, of_source.transpose() * weighted * of_source);
    system.add(c.target, c.target, of_target.transpose() * weighted * of_target);
    system.add(c.source, c.target, of_source.transpose() * weighted * of_target);
    system.add(c.target, c.source, of_target.transpose() * weighted * of_source);
    system.addGradient(c.source, of_source.transpose() * weighted * r);
    system.addGradient(c.target, of_target.transpose() * weighted * r);
  }
  return system;
}

/** \brief The step, or nothing of the right size where the system can't be solved. */
Eigen::VectorXd
solve(const System& system, double damping)
{
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * system.blocks.size());
  for (const auto& [at, block] : system.blocks) {
    const auto row = 6 * static_cast<int>(at.first - 1),
               column = 6 * static_cast<int>(at.second - 1);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        if (row + i >= column + j)
          entries.emplace_back(row + i,
                               column + j,
                               row + i == column + j ? (1 + damping) * block(i, j)
                                                     : block(i, j));
  }
  Eigen::SparseMatrix<double> matrix(system.gradient.size(), system.gradient.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success)
    return Eigen::VectorXd();
  return -solver.solve(system.gradient);
}

Poses
moved(const Poses& poses, const Eigen::VectorXd& step)
{
  Poses result = poses;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Vector6 motion = step.segment<6>(6 * static_cast<Eigen::Index>(i - 1));
    const Eigen::Matrix3d rotation = turnBy(motion.head<3>()) * poses[i].linear();
    result[i].linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
    result[i].translation() += motion.tail<3>();
  }
  return result;
}

} // namespace

Vector6
residualOf(const PoseConstraint& c,
           const Eigen::Isometry3d& target,
           const Eigen::Isometry3d& source)
{
  const Eigen::Isometry3d off = target.inverse(Eigen::Isometry) * source *
                                c.T_target_source.inverse(Eigen::Isometry);
  const Eigen::AngleAxisd turn(off.linear());
  Vector6 residual;
  residual.head<3>() = turn.angle() * turn.axis();
  residual.tail<3>() = off * c.middle - c.middle;
  return residual;
}

void
optimize(const std::vector<PoseConstraint>& constraints, Poses& poses)
{
  if (poses.size() < 2)
    return;
  double cost = costOf(constraints, poses), damping = FIRST_DAMPING;
  for (int round = 0; round < ROUNDS; ++round) {
    const System system = linearize(constraints, poses);
    bool better = false, enough = false;
    for (; !better && damping <= MOST_DAMPING; damping *= 10) {
      const Eigen::VectorXd step = solve(system, damping);
      if (step.size() == 0 || !step.allFinite())
        continue;
      const Poses next = moved(poses, step);
      const double next_cost = costOf(constraints, next);
      better = next_cost < cost;
      if (!better)
        continue;
      enough = cost - next_cost <= ENOUGH * cost;
      poses = next;
      cost = next_cost;
    }
    if (!better || enough)
      return;
    damping = std::max(FIRST_DAMPING, damping / 100);
  }
}

} // namespace pcl_flashreg
