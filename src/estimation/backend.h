// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/pipeline.h"
#include "support/thread_pool.h"

#include <memory>
#include <optional>
#include <string>

namespace pcl_flashreg {

/** \brief A machine that runs the pipeline; owns its working memory. */
class Backend {
public:
  virtual ~Backend() = default;

  virtual std::string
  name() const = 0;

  virtual PoseEstimate
  run(const Problem& problem,
      const Parameters& parameters,
      const std::optional<Pose>& guess,
      bool with_candidates,
      StageClock& clock,
      Trace* trace) = 0;
};

/** \param[in] pool must outlive the backend
 * \throws std::invalid_argument, BackendError, see cpu::selectKernels() */
std::unique_ptr<Backend>
makeCpuBackend(ThreadPool& pool);

/** \throws BackendError, with the reason, if this build has no CUDA backend or this machine
 * no device that it can use */
std::unique_ptr<Backend>
makeCudaBackend();

} // namespace pcl_flashreg
