// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../io/correspondence_io.h"
#include "../io/input_cloud.h"
#include "../program/messages.h"
#include "options.h"

#include <pcl_flashreg/result.h>

#include <optional>
#include <string>

namespace pcl_flashreg::align {

using io::InputCloud;
using program::Messages;

/** \brief Descriptors, one a point of a cloud. */
struct InputFeatures {
  std::size_t dimension = 0;
  /** \brief size x dimension, row by row. */
  std::vector<float> values;
};

/** \brief All that the command line names, read and checked. */
struct Inputs {
  std::optional<InputCloud> source;
  std::optional<InputCloud> target;
  std::optional<io::Correspondences> correspondences;
  /** \brief Both or none. */
  std::optional<InputFeatures> source_features;
  std::optional<InputFeatures> target_features;
  std::optional<RigidTransform> guess;
};

/** \throws io::InputError with the path and what is wrong with it
 * \throws UsageError if clouds are missing that index pairs need
 */
Inputs
readInputs(const Options& options, const Messages& messages);

} // namespace pcl_flashreg::align
