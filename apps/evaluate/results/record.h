// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <cstddef>
#include <optional>
#include <string>

namespace pcl_flashreg::evaluate {

/** \brief Milliseconds. */
struct Times {
  /** \brief Features of both clouds, whether computed for this pair or an earlier one. */
  double features = 0;
  double matching = 0;
  /** \brief From correspondences (or, for methods on clouds, features) to the pose. */
  double estimation = 0;
  /** \brief Nothing for methods without these stages. */
  std::optional<StageTimings> stages;
};

/** \brief How one method did on one pair. All but the times is the same in every run. */
struct Record {
  /** \brief Number of the pair in the list of the run, from 0. */
  std::size_t pair = 0;
  std::string dataset, scene, source, target;
  std::string method;
  std::size_t correspondences = 0;
  /** \brief Share of the correspondences that agree with the true pose. */
  double inlier_ratio = 0;
  bool found = false;
  /** \brief The pose is right by the criterion. */
  bool success = false;
  /** \brief The method's verdict. */
  bool trusted = false;
  double confidence = 0;
  std::size_t inliers = 0;
  /** \brief Nothing for methods without one. */
  std::optional<Evidence> evidence;
  /** \brief Degrees; of the identity if no pose was found. */
  double rotation_error = 0;
  double translation_error = 0;
  Times times;
};

} // namespace pcl_flashreg::evaluate
