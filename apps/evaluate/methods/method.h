// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/pair_registration.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief What a method is given of a pair. */
struct Problem {
  const Correspondences& correspondences;
  /** \brief The keypoints behind them; empty if the data set brings its own. */
  const std::vector<FeatureMatch>& matches;
  /** \brief With descriptors, unless the data set brings its own correspondences; empty if
   * it does so without clouds. */
  Scan source, target;
  /** \brief The pair's, for methods that something is made up for. */
  const std::string& name;
  /** \brief T_target_source, of which methods are told what a sensor would tell them. */
  const RigidTransform& truth;
};

/** \brief What a method says of a pair. */
struct Answer {
  bool found = false;
  RigidTransform T_target_source;
  /** \brief The method's own verdict; a method without one trusts every pose it finds. */
  bool trusted = false;
  /** \brief What the verdict goes by; larger is surer, only the order counts. */
  double confidence = 0;
  std::size_t inliers = 0;
  double estimation_ms = 0;
  /** \brief What this project's confidence is computed from. */
  std::optional<Evidence> evidence;
  /** \brief Of this project's estimator; other methods have no such stages. */
  std::optional<StageTimings> stages_ms;
};

using Method = std::function<Answer(const Problem&)>;

/** \brief The same for all methods of a run. */
struct MethodSettings {
  /** \brief Lengths, number of correspondences and score. */
  Parameters parameters;
  /** \brief Voxel size, from which the authors' settings take their lengths. */
  double leaf = 0.05;
  /** \brief For methods that can be told; 0 for all. */
  unsigned threads = 0;
};

/** \brief A method that the command line can name. */
struct MethodEntry {
  std::string name;
  /** \brief One line for --help. */
  std::string description;
  /** \brief Correspondences alone don't do. */
  bool needs_clouds = false;
  /** \throws BackendError if this machine cannot run it
   * \throws std::invalid_argument if it cannot work with the settings */
  std::function<Method(const MethodSettings&)> make;
  /** \brief Answers from the map of a scene's clouds (SceneMaps), not pair by pair: `make` is
   * empty. */
  bool of_scenes = false;
};

} // namespace pcl_flashreg::evaluate
