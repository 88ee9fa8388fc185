// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/export.h>

#include <array>

namespace pcl_flashreg {

/** \brief How the scores of the second-order graph are computed (stage 2). */
enum class SecondOrder {
  /** \brief Exact where its cost is bounded, bounded elsewhere. The choice depends on
   * the input alone: exact if the mean degree of the first-order graph is at most
   * 8 * Parameters::row_capacity. */
  Auto,
  /** \brief All common neighbours, Eq. (sog). Cost grows with the cube of N on a graph
   * that is nearly complete. */
  Exact,
  /** \brief FastSOG, Eq. (sog_trunc): at most Parameters::row_capacity voters and entries
   * a row. Cost is bounded on any input. */
  Bounded
};

/** \brief What a hypothesis is ranked by (stage 6); d is the residual of an inlier. */
enum class ScoreMetric {
  /** \brief Number of correspondences with residual below the inlier distance. */
  Inliers,
  /** \brief Sum over the inliers of 1 - d / inlier_distance. */
  Mae,
  /** \brief Sum over the inliers of (1 - d / inlier_distance)^2. */
  Mse
};

/** \brief Which motions a pose may be. */
enum class MotionModel {
  /** \brief All rigid ones: three turns, three shifts. */
  Rigid,
  /** \brief Those that take the direction of gravity in the source to that in the target, up
   * to Parameters::max_tilt: a heading and three shifts. For whoever knows which way is up,
   * as robots and tripods do. */
  Upright
};

/** \brief Where the stages run. */
enum class BackendKind {
  /** \brief CUDA where it is built in and a device is usable, the CPU elsewhere. */
  Auto,
  Cpu,
  /** \brief Constructing an Estimator throws BackendError where CUDA can't be used. */
  Cuda
};

/** \brief Everything that the estimator can be told, in one place.
 *
 * Lengths are in the unit of the clouds; the defaults are the indoor preset in metres
 * (3DMatch at a 5 cm voxel). fromResolution() sets all of them from one number. The
 * symbols in brackets are those of the FlashReg paper.
 */
struct PCL_FLASHREG_EXPORT Parameters {
  /** \brief Two correspondences are compatible if the distance between their source points
   * and that between their target points differ by less than this [tau]. Length, > 0. */
  float length_tolerance = 0.012f;

  /** \brief Pairs of correspondences whose two distances sum to no more than this are
   * ignored: too close together to constrain a pose [r]. Length, >= 0. */
  float min_length_sum = 0.15f;

  /** \brief Residual below which a correspondence agrees with a pose [tau_in].
   * Length, > 0. */
  float inlier_distance = 0.10f;

  /** \brief Correspondences used at most; the best-ranked are kept and Result says how many
   * were left out [N_max]. >= 3, <= 200000. Memory grows with N^2 / 8 bytes. */
  int max_correspondences = 7000;

  /** \brief Number of best edges that cliques are grown from [K]. >= 1, <= 1000000. */
  int pivots = 2000;

  /** \brief 3-cliques kept a pivot [T]. >= 1, <= 16. */
  int cliques_per_pivot = 2;

  /** \brief Bounded mode: voters, and entries kept, a row [L]. >= 1, <= 4096. */
  int row_capacity = 128;

  /** \brief Bounded mode: best edges a row that may become pivots [m].
   * >= 1, <= row_capacity. */
  int pool_capacity = 32;

  SecondOrder second_order = SecondOrder::Auto;

  ScoreMetric score_metric = ScoreMetric::Inliers;

  /** \brief Rounds of reweighted alignment at most (stage 7); 0 keeps the pose of the best
   * clique. >= 0, <= 1000. */
  int refinement_iterations = 20;

  /** \brief How many distinct hypotheses Result lists at most, the best one included.
   * >= 1, <= 64. */
  int max_hypotheses = 5;

  MotionModel motion = MotionModel::Rigid;

  /** \brief Upright motion: the angle, in degrees, between the direction of gravity in the
   * target and that of the source under the pose is at most this. It has to cover what
   * source_gravity and target_gravity may be wrong by together. > 0, <= 30. */
  float max_tilt = 3;

  /** \brief Upright motion: the directions of gravity, or else the opposite ones of both, in
   * the frame of each cloud. Finite, of any length > 0. */
  std::array<float, 3> source_gravity{0, 0, 1}, target_gravity{0, 0, 1};

  /** \brief The verdict: a pose is trusted if Result::confidence is at least this.
   * [0, 1]. What precision and recall that gives: docs/method.md. */
  float min_confidence = 0.6f;

  /** \brief All lengths from the resolution of the clouds (the voxel size v):
   * length_tolerance 0.24 v, min_length_sum 3 v, inlier_distance 2 v.
   * \param[in] resolution voxel size, in the unit of the clouds, > 0 and finite
   * \throws std::invalid_argument if it is not
   */
  static Parameters
  fromResolution(double resolution);

  /** \brief Checks every field against the range stated with it.
   * \throws std::invalid_argument with the name, the value and the range of the first
   * field that is out of it
   */
  void
  validate() const;
};

} // namespace pcl_flashreg
