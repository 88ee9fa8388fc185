// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "registration/pose_search.h"
#include "scan/scan_maker.h"

#include <pcl_flashreg/impl/stopwatch.hpp>
#include <pcl_flashreg/pair_registration.h>

namespace pcl_flashreg {

/** \brief What does the work of all calls, with one pool of threads. */
struct PairWorkers {
  PairWorkers(BackendKind backend, unsigned num_threads)
      : search(backend, num_threads), maker(search.pool())
  {
  }

  PoseSearch search;
  ScanMaker maker;
};

/** \brief One registration: its steps, each of which adds what it finds to the result and
 * books its time. Whoever calls them decides on their order. */
class PairCall {
public:
  PairCall(PairWorkers& workers, const PairOptions& options)
      : workers_(workers), options_(options)
  {
  }

  /** \brief The resolution of clouds: the coarser of both. */
  void
  chooseResolution(const PreparedInput& source, const PreparedInput& target);

  /** \brief That of correspondences: the finer of both sides, which is that of the side
   * with more distinct points. */
  template <typename Scalar>
  void
  chooseResolution(const CorrespondenceView<Scalar>& correspondences);

  void
  makeScans(const PreparedInput& source,
            const PreparedInput& target,
            ScanContent content);

  /** \brief Scans that are there already, and the coarser of their resolutions. */
  void
  takeScans(const Scan& source, const Scan& target);

  /** \brief Correspondences between the scans. */
  Correspondences
  match();

  /** \brief From correspondences to the pose; the scans judge, where there are any. */
  template <typename Scalar>
  void
  estimate(const CorrespondenceView<Scalar>& correspondences);

  const PairResult&
  result() const
  {
    return result_;
  }

  PairResult
  finish();

private:
  void
  begin(PairStep step) const;

  PairWorkers& workers_;
  const PairOptions& options_;
  PairResult result_;
  detail::Stopwatch total_;
};

/** \brief Matches of keypoints as PairOptions wants them. */
std::vector<FeatureMatch>
matchScans(const Scan& source,
           const Scan& target,
           const PairOptions& options,
           ThreadPool& pool);

} // namespace pcl_flashreg
