// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "localization/scan_index_data.h"
#include "registration/pair_workers.h"

#include <pcl_flashreg/impl/stopwatch.hpp>
#include <pcl_flashreg/pair_registration.h>

namespace pcl_flashreg {

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

  /** \brief Scans that are there already, and the coarser of their resolutions.
   * \param[in] index of the target, if not null */
  void
  takeScans(const Scan& source,
            const Scan& target,
            const ScanIndex::Data* index = nullptr);

  /** \brief Correspondences between the scans. */
  void
  match();

  void
  takeMatches(const std::vector<FeatureMatch>& matches);

  /** \brief From them to the pose, with a second look at the scans where it takes one. */
  void
  estimateFromMatches();

  /** \brief From correspondences of the caller's to the pose; the scans judge, where there
   * are any. */
  template <typename Scalar>
  void
  estimateFrom(CorrespondenceView<Scalar> correspondences);

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

  /** \brief A scan is looked for in a map, whichever of them is the source. */
  void
  exchangeIfMap();

  template <typename Scalar>
  void
  estimate(const CorrespondenceView<Scalar>& correspondences,
           const SecondLook& second_look);

  PairWorkers& workers_;
  const PairOptions& options_;
  PairResult result_;
  /** \brief Whether source and target of the result are the caller's target and source. */
  bool exchanged_ = false;
  /** \brief Of the target, where it is a map that has one. */
  const ScanIndex::Data* index_ = nullptr;
  detail::Stopwatch total_;
};

/** \brief All steps of two scans. */
PairResult
alignScans(PairWorkers& workers,
           const Scan& source,
           const Scan& target,
           const PairOptions& options);

} // namespace pcl_flashreg
