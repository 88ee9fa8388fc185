// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "ablation/ablation.h"
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
  /** \brief The device's. */
  Ceilings ceilings;
  /** \brief Making the first estimator of the process, ms: on a device, its context. */
  double start_ms = 0;
};

/** \brief The ablation on one problem. */
struct NamedAblation {
  std::string name;
  std::size_t size = 0;
  std::vector<AblationMeasurement> rows;
};

/** \brief What was measured; one of these is empty. */
struct Figures {
  std::vector<Measurement> measurements;
  std::vector<NamedAblation> ablations;
};

void
printSetting(const Setting& setting);

/** \brief The line above the measurements. */
void
printHeader();

/** \param[in] ceilings of the device, if one was measured */
void
print(const Measurement& measurement, const Ceilings& ceilings);

void
print(const NamedAblation& ablation);

/** \brief All figures as JSON. */
std::string
toJson(const Setting& setting, const Options& options, const Figures& figures);

} // namespace pcl_flashreg::benchmark
