// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/pipeline.h"
#include "support/thread_pool.h"

#include <pcl_flashreg/estimator.h>

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

  /** \brief One more, on the same device if it has one.
   * \param[in] pool must outlive it */
  virtual std::unique_ptr<Backend>
  another(ThreadPool& pool) const = 0;

  /** \brief Whether it works in a memory of its own, which others may share. */
  virtual bool
  isOnDevice() const
  {
    return false;
  }

  virtual PoseEstimate
  run(const Problem& problem,
      const Parameters& parameters,
      const std::optional<Pose>& guess,
      bool with_candidates,
      StageClock& clock,
      Trace* trace) = 0;

  /** \brief Correspondences in the host's memory; the view holds until the next call.
   * \throws BackendError if this backend has no device */
  virtual CorrespondenceView<float>
  readBack(const DeviceCorrespondences& correspondences);

  /** \brief Leaves a pose, row-major, where its caller asked for it.
   * \throws BackendError if this backend has no device */
  virtual void
  leavePose(const float T_target_source[16], const DeviceCorrespondences& asked);
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
