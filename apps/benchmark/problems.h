// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../io/correspondence_io.h"
#include "options.h"

#include <pcl_flashreg/estimator.h>

#include <string>
#include <vector>

namespace pcl_flashreg::benchmark {

/** \brief Correspondences to be timed. */
struct NamedProblem {
  std::string name;
  io::Correspondences correspondences;

  CorrespondenceView<double>
  view() const
  {
    return {correspondences.source.data(),
            correspondences.target.data(),
            correspondences.size()};
  }
};

/** \brief Those of the files, if any are given, else made ones.
 * \throws io::InputError */
std::vector<NamedProblem>
problemsOf(const Options& options);

/** \brief Writes each problem as rows of sx sy sz tx ty tz, with all digits.
 * \return the paths
 * \throws io::InputError */
std::vector<std::string>
exportProblems(const std::vector<NamedProblem>& problems, const std::string& folder);

} // namespace pcl_flashreg::benchmark
