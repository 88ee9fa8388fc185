// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "registration/pose_search.h"
#include "scan/scan_maker.h"

namespace pcl_flashreg {

/** \brief What does the work of all calls, with one pool of threads. */
struct PairWorkers {
  PairWorkers(BackendKind backend, unsigned num_threads)
      : search(backend, num_threads), maker(search.pool())
  {
  }

  /** \brief Others, on the same device. */
  PairWorkers(const PairWorkers& like, unsigned num_threads)
      : search(like.search, num_threads), maker(search.pool())
  {
  }

  PoseSearch search;
  ScanMaker maker;
};

} // namespace pcl_flashreg
