// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/cloud_view.h>
#include <pcl_flashreg/parameters.h>
#include <pcl_flashreg/stage_timings.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
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

/** \brief A pose, and what speaks for it. */
struct Hypothesis {
  RigidTransform T_target_source;
  /** \brief Correspondences with residual below Parameters::inlier_distance. */
  int inlier_count = 0;
  /** \brief By Parameters::score_metric; the inlier count by default. */
  double score = 0;
  /** \brief What the clouds say; nothing if they were not asked. */
  std::optional<CloudAgreement> agreement;
};

/** \brief What Result::confidence is computed from (docs/method.md); no number has a
 * unit. */
struct Evidence {
  /** \brief Correspondences that agree with the pose. */
  double inliers = 0;
  /** \brief The same over the correspondences that were used. */
  double inlier_ratio = 0;
  /** \brief Most correspondences that agree with a pose that disagrees with this one. */
  double rival_inliers = 0;
  /** \brief Smallest standard deviation of the inliers' source points along any axis, in
   * halves of the inlier distance: near 0 if they lie in a plane, which leaves a pose free
   * to slide. */
  double thickness = 0;
  /** \brief The middle one of these three standard deviations, likewise: near 0 if the
   * inliers lie on a line, which leaves a pose free to turn about it. */
  double breadth = 0;
  /** \brief Logarithm of how many poses would have as many inliers, were the same points
   * paired at random: 0 is what chance gives. An upper bound (see docs/method.md). */
  double log_chance = 0;
  /** \brief By how many standard deviations a reflection of the source explains the
   * correspondences better than a motion: clearly above 0 if one of the clouds is mirrored. */
  double mirrored = 0;
  /** \brief Of upright motions, how much of a rival a pose is that gravity forbids: 1 if it
   * explains as much, and more if it explains more, as where the direction of gravity is
   * wrong. 0 where there is none, and of rigid motions. */
  double tilted = 0;

  /** \brief Whether the clouds were asked: the rest is 0 where not. */
  bool has_clouds = false;
  /** \brief Whether viewpoints are known, and believed. */
  bool has_viewpoints = false;
  /** \brief Whether that is so of one cloud alone. */
  bool one_viewpoint = false;
  /** \brief Whether viewpoints are known and not believed: without them the clouds are more
   * certain, of another pose perhaps. */
  bool overruled_viewpoints = false;
  /** \brief Whether the viewpoint of one cloud, or of both, is not known, but the sides of
   * its surfaces that normals point to are believed to be those that were seen. */
  bool has_sides = false;
  /** \brief Whether these are not believed: without them the clouds are more certain. */
  bool overruled_sides = false;
  /** \brief Whether one cloud has more than three times as many points as the other: it is a
   * map, of which the other one has a part in its sight. `agreement` then is as that one sees
   * it. */
  bool in_map = false;
  /** \brief Whether it took a second look (PairOptions::second_look). `inliers` then is the mean
   * of matches from the source's side and from the target's. */
  bool second_look = false;
  CloudAgreement agreement;
  /** \brief By how much the evidence for this pose exceeds that for the best other one,
   * as a logarithm; at most 5, which is also its value where there is no other one. */
  double lead = 0;
  /** \brief How many other poses explain as much. One that explains less counts for
   * exp(-4 lead), or, if a few dozen correspondences agree with it, for exp(-q lead) by the
   * clouds alone, q from 8 down to 3 the more they are. */
  double rivals = 0;
  /** \brief By how much, as a logarithm, what the clouds say falls at least where the source
   * is moved off along the motions that the surfaces oppose least; at most 5, and about 0 or
   * less where the pose may slide or turn. */
  double hold = 0;
  /** \brief How firmly the surfaces hold the pose: the smallest eigenvalue of their
   * point-to-plane Hessian over the number of points, with arms in units of their own
   * spread. */
  double stiffness = 0;
};

/** \brief A way to move the source that neither cloud opposes: all along it they match as
 * well as at the pose itself, or nearly. The pose holds but for this. */
struct FreeMotion {
  enum class Kind { Slide, Turn };
  Kind kind = Kind::Slide;
  /** \brief Of the slide, or of the axis; of length 1, in the frame of the target. */
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /** \brief On the axis; for a slide, the middle of the points that match. */
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /** \brief How far it goes against the direction and along it, in the unit of the clouds or
   * in radians. No further was looked than 63 times the resolution, or half a turn. */
  double backward = 0, forward = 0;
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

  /** \brief The verdict: status is Ok and confidence is at least
   * Parameters::min_confidence. */
  bool converged = false;

  /** \brief Probability that the pose is right, in [0, 1], as fitted on public pairs of
   * scans (docs/method.md has the fit and its limits); 0 unless status is Ok. */
  double confidence = 0;

  /** \brief What the confidence is computed from. */
  Evidence evidence;

  /** \brief Rows of the input that agree with the pose, ascending. */
  std::vector<int> inliers;

  /** \brief Score of the pose by Parameters::score_metric. */
  double score = 0;

  /** \brief Inliers of the pose over the inliers of the best hypothesis that disagrees
   * with it; infinite if there is none. */
  double distinctness = 0;

  /** \brief The best distinct hypotheses, refined, best first; the first is the pose
   * itself. Two are distinct if they move some corner of the source correspondences'
   * bounding box to places further apart than 5 * Parameters::inlier_distance. Best by
   * score; where there are clouds, by what those say. */
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
   * over-confident where neighbouring inliers err together. Nothing is known along free
   * motions, and gravity adds nothing. Zero unless status is Ok. */
  InformationMatrix information = InformationMatrix::Zero();

  /** \brief Motions that the clouds leave free, the freest first: a corridor lets the pose
   * slide, a bottle lets it turn. Empty where all of the pose is held, or no cloud was asked. */
  std::vector<FreeMotion> free_motions;

  StageTimings timings_ms;

  /** \brief Which backend ran, e.g. "cpu-avx512". */
  std::string backend;

  /** \brief Which form stage 2 took: SecondOrder::Exact or SecondOrder::Bounded. */
  SecondOrder second_order = SecondOrder::Exact;
};

} // namespace pcl_flashreg
