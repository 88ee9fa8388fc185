// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "device/device_figures.h"
#include "repetition.h"
#include "spread.h"

#include <pcl_flashreg/estimator.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::benchmark {

/** \brief Whole calls, from correspondences in host memory to the verdict there, in batches of
 * a problem over and over. */
struct Throughput {
  /** \brief How many are worked on at a time. */
  unsigned side_by_side = 1;
  double pairs_per_second = 0;
};

/** \brief One problem, timed. */
struct Measurement {
  std::string name;
  std::size_t size = 0;
  Result result;
  /** \brief First call of a fresh estimator: threads and memory are made here. */
  double cold_ms = 0;
  /** \brief By stage, of the warm calls, from host memory to the pose. On a device stages
   * are timed there, by marks in its stream; the preparation and the total are the
   * host's. */
  std::array<Spread, STAGES.size()> stages;
  Spread total;
  std::vector<Throughput> throughput;
  std::optional<DeviceFigures> device;
};

/** \brief Times the estimation from correspondences to pose.
 * \param[in] repetition of the warm calls
 */
Measurement
measure(const std::string& name,
        const CorrespondenceView<double>& correspondences,
        const Parameters& parameters,
        BackendKind backend,
        unsigned threads,
        const Repetition& repetition);

Throughput
measureThroughput(const CorrespondenceView<double>& correspondences,
                  const Parameters& parameters,
                  BackendKind backend,
                  unsigned side_by_side,
                  const Repetition& repetition);

} // namespace pcl_flashreg::benchmark
