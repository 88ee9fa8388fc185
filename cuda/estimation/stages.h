// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// The host's side of the backend: no kernel is called from here but through the functions
// of the stages' own headers, and nvcc does not read this.

#include "cuda/estimation/call.cuh"
#include "cuda/support/memory.h"
#include "cuda/estimation/options.h"
#include "estimation/pipeline.h"
#include "cuda/support/stream.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace pcl_flashreg {
namespace cuda {

/** \brief The seven stages on a device, and the memory between them. A stage puts its
 * kernels into a stream and returns; settled() waits for all of them, once a call. */
class Stages {
public:
  /** \param[in] multiprocessors of the device
   * \param[in] cooperative whether it launches kernels whose blocks wait for each other
   */
  Stages(const Options& options, unsigned multiprocessors, bool cooperative);

  void
  begin(const Problem& problem,
        const Parameters& parameters,
        const std::optional<Pose>& guess,
        StageClock& clock);
  void
  firstOrderGraph();
  void
  secondOrderGraph();
  void
  pivots();
  void
  cliques();
  void
  hypotheses();
  void
  verification();
  void
  refinement();
  void
  finish(double StageTimings::*stage);
  bool
  settled();
  PoseEstimate
  result() const;
  std::vector<Pose>
  candidates() const;
  void
  copyTo(Trace& trace) const;

  /** \brief What the kernels of the call under way are told, and the stream that they go
   * into: for comparisons that do a stage in another way. */
  const Call&
  call() const
  {
    return call_;
  }
  const Stream&
  stream() const
  {
    return stream_;
  }
  /** \brief Bytes of device memory that are held. */
  std::size_t
  deviceBytes() const;

  /** \brief Waits for whatever is under way, after a failure. */
  void
  abandon() noexcept;

private:
  static constexpr std::size_t STAGES = 7;

  void
  describe(const Problem& problem, const Parameters& parameters);
  void
  upload(const Problem& problem);
  void
  reserveHypotheses();
  void
  reserveReport();
  void
  planExact(unsigned long long entries);
  void
  planBounded();
  void
  bookTimes();

  bool
  fused() const
  {
    return options_.fused && cooperative_;
  }
  /** \brief The host's copy of what the kernels reported. */
  const Control&
  control() const
  {
    return *reinterpret_cast<const Control*>(host_report_.data());
  }

  template <typename T>
  std::vector<T>
  download(const T* from, std::size_t n) const;
  void
  traceBits(Trace& trace) const;
  void
  traceRows(const Rows& rows, std::size_t entries, std::vector<Edge>& edges) const;
  void
  traceHypotheses(Trace& trace) const;

  const Options options_;
  const unsigned multiprocessors_;
  const bool cooperative_;
  Stream stream_;
  /** \brief What kernels are told. Call::exact, the form of stage 2, is kept from call to
   * call: most inputs of a program are alike. */
  Call call_{};

  StageClock* clock_ = nullptr;
  Event beginning_;
  /** \brief The ends of stages, in their order. */
  std::array<Event, STAGES> ends_;
  std::array<double StageTimings::*, STAGES> ended_{};
  std::size_t ended_count_ = 0;

  PinnedBuffer<float> staging_;
  DeviceBuffer<float> points_;
  bool uploaded_ = false;
  DeviceBuffer<unsigned> graph_;
  /** \brief Entries of the second-order graph in either form; in the exact one the columns
   * are those of all neighbours. */
  DeviceBuffer<unsigned> columns_, scores_;
  DeviceBuffer<Neighbours> neighbour_rows_;
  DeviceBuffer<Row> rows_, pool_rows_;
  DeviceBuffer<unsigned> pool_columns_, pool_scores_;
  DeviceBuffer<unsigned> row_best_, tie_begin_;
  DeviceBuffer<unsigned long long> pivot_keys_;
  DeviceBuffer<Clique> cliques_;
  DeviceBuffer<unsigned> clique_counts_;
  DeviceBuffer<Pose> poses_;
  DeviceBuffer<SlotPose> slot_poses_;
  DeviceBuffer<long long> pose_scores_;
  DeviceBuffer<unsigned> candidate_inliers_, candidate_lists_;

  /** \brief The histogram and a Control, which are cleared with every call; from the
   * Control on, with the listed poses and the inliers of the first, what the host reads. */
  DeviceBuffer<unsigned char> report_;
  PinnedBuffer<unsigned char> host_report_;
  std::size_t cleared_bytes_ = 0, control_offset_ = 0, read_bytes_ = 0;
  std::size_t listed_offset_ = 0, cliques_offset_ = 0, inliers_offset_ = 0;
};

} // namespace cuda
} // namespace pcl_flashreg
