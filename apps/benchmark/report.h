// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "measurement.h"
#include "options.h"

#include <string>
#include <vector>

namespace pcl_flashreg::benchmark {

/** \brief On what was measured. */
struct Setting {
  std::string processor, backend;
  /** \brief Empty without one. */
  std::string device;
  /** \brief Making the first estimator of the process, ms: on a device, its context. */
  double start_ms = 0;
};

void
printHeader(const Setting& setting);

void
print(const Measurement& measurement);

/** \brief All figures as JSON. */
std::string
toJson(const Setting& setting,
       const Options& options,
       const std::vector<Measurement>& measurements);

} // namespace pcl_flashreg::benchmark
