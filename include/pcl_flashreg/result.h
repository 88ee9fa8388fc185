// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/parameters.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_flashreg {

/** \brief A rigid transform T_target_source: target = rotation * source + translation.
 *
 * Two plain members instead of an Eigen::Isometry3d, whose alignment changes with the
 * compiler's SIMD flags: this type is the same on both sides of the compiled boundary.
 */
struct RigidTransform {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Isometry3d
  toIsometry() const
  {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = rotation;
    pose.translation() = translation;
    return pose;
  }

  /** \brief 4x4 homogeneous matrix, as PCL's registration classes store it. */
  template <typename Scalar = float>
  Eigen::Matrix<Scalar, 4, 4>
  toMatrix() const
  {
    return toIsometry().matrix().template cast<Scalar>();
  }
};

/** \brief How an estimation ended. */
enum class Status {
  /** \brief A pose was found. Whether to trust it is Result::converged. */
  Ok,
  /** \brief Fewer than three correspondences with finite coordinates. */
  TooFewCorrespondences,
  /** \brief No three correspondences preserve their mutual distances. */
  NoClique,
  /** \brief Cliques were found, but all of them are collinear or coincident, or no
   * pose has three inliers. */
  Degenerate
};

/** \brief One line, without a full stop, for messages. */
PCL_FLASHREG_EXPORT const char*
toString(Status status);

/** \brief Wall-clock time of each stage in milliseconds; the names are METHOD's. */
struct StageTimings {
  /** \brief Checking, ranking, centring and packing the input. */
  double preparation = 0;
  double first_order_graph = 0;
  double second_order_graph = 0;
  double pivots = 0;
  double cliques = 0;
  double hypotheses = 0;
  double verification = 0;
  double refinement = 0;
  /** \brief The whole call. */
  double total = 0;
};

/** \brief A pose, and what speaks for it. */
struct Hypothesis {
  RigidTransform T_target_source;
  /** \brief Correspondences with residual below Parameters::inlier_distance. */
  int inlier_count = 0;
  /** \brief By Parameters::score_metric; the inlier count by default. */
  double score = 0;
};

/** \brief 6x6, symmetric, positive semi-definite; a type whose alignment does not depend on
 * the compiler's SIMD flags. */
using InformationMatrix = Eigen::Matrix<double, 6, 6, Eigen::DontAlign>;

/** \brief What Estimator::estimate() returns. */
struct Result {
  /** \brief The refined pose, in the frames and units of the input; identity unless
   * status is Ok. */
  RigidTransform T_target_source;

  Status status = Status::TooFewCorrespondences;

  /** \brief The verdict: status is Ok and the pose passed the test stated at
   * Parameters::min_inliers and Parameters::min_distinctness. */
  bool converged = false;

  /** \brief Rows of the input that agree with the pose, ascending. */
  std::vector<int> inliers;

  /** \brief Score of the pose by Parameters::score_metric. */
  double score = 0;

  /** \brief Inliers of the pose over the inliers of the best hypothesis that disagrees
   * with it; infinite if there is none. */
  double distinctness = 0;

  /** \brief The best distinct hypotheses, refined, best first; the first is the pose
   * itself. Two are distinct if they move some corner of the source correspondences'
   * bounding box to places further apart than 5 * Parameters::inlier_distance. */
  std::vector<Hypothesis> hypotheses;

  /** \brief Rows of the input with finite coordinates that were used. */
  std::size_t correspondences_used = 0;

  /** \brief Rows left out because of Parameters::max_correspondences. */
  std::size_t correspondences_dropped = 0;

  /** \brief Rows left out because a coordinate is not finite. */
  std::size_t correspondences_invalid = 0;

  /** \brief Information matrix (inverse covariance) of the pose from its inliers: the
   * Gauss-Newton Hessian of the squared residuals over the residuals' own variance. Order
   * (rotation, translation), of a small motion applied on the left, about the target
   * frame's origin: T <- exp(xi) T. Independent errors are assumed, so it is
   * over-confident where neighbouring inliers err together. Zero unless status is Ok. */
  InformationMatrix information = InformationMatrix::Zero();

  StageTimings timings_ms;

  /** \brief Which backend ran, e.g. "cpu-avx512". */
  std::string backend;

  /** \brief Which form stage 2 took: SecondOrder::Exact or SecondOrder::Bounded. */
  SecondOrder second_order = SecondOrder::Exact;
};

} // namespace pcl_flashreg
