// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "registration/exchange.h"

#include "math/isometry.h"

#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief Of a motion applied on the left of T, in terms of one on the left of its inverse,
 * but for the sign. */
Eigen::Matrix<double, 6, 6>
adjointOf(const RigidTransform& T)
{
  Eigen::Matrix<double, 6, 6> adjoint = Eigen::Matrix<double, 6, 6>::Zero();
  adjoint.topLeftCorner<3, 3>() = T.rotation;
  adjoint.bottomRightCorner<3, 3>() = T.rotation;
  adjoint.bottomLeftCorner<3, 3>() = crossMatrix(T.translation) * T.rotation;
  return adjoint;
}

} // namespace

RigidTransform
inverseOf(const RigidTransform& T)
{
  RigidTransform inverse;
  inverse.rotation = T.rotation.transpose();
  inverse.translation = -(inverse.rotation * T.translation);
  return inverse;
}

void
exchange(Result& result)
{
  const RigidTransform T = result.T_target_source;
  const RigidTransform inverse = inverseOf(T);
  const Eigen::Matrix<double, 6, 6> adjoint = adjointOf(T);
  result.information = adjoint.transpose() * result.information * adjoint;
  for (FreeMotion& motion : result.free_motions) {
    motion.direction = inverse.rotation * motion.direction;
    motion.point = inverse.rotation * motion.point + inverse.translation;
    // What the one does along it the other does against it.
    std::swap(motion.backward, motion.forward);
  }
  result.T_target_source = inverse;
  for (Hypothesis& hypothesis : result.hypotheses)
    hypothesis.T_target_source = inverseOf(hypothesis.T_target_source);
}

Parameters
exchanged(Parameters parameters)
{
  std::swap(parameters.source_gravity, parameters.target_gravity);
  return parameters;
}

void
exchange(std::vector<FeatureMatch>& matches)
{
  for (FeatureMatch& match : matches)
    std::swap(match.query, match.match);
}

} // namespace pcl_flashreg
