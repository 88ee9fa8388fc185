// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/surface.h"
#include "matching/feature_index.h"
#include "scan/scan_maker.h"

#include <pcl_flashreg/scan_index.h>

#include <optional>

namespace pcl_flashreg {

/** \brief By how much the second look's resolution is coarser. */
constexpr double COARSER = 1.5;

struct ScanIndex::Data {
  Data() = default;
  Data(const Data&) = delete;
  Data&
  operator=(const Data&) = delete;

  Scan scan;
  /** \brief The same at the coarser resolution; empty if the descriptors are the caller's. */
  Scan coarse;
  /** \brief Nothing where no descriptor is finite. */
  std::optional<FeatureIndex> features, coarse_features;
  /** \brief In order, about the middle of the scan. */
  Surface surface;
  Vec3 middle{0, 0, 0};
};

/** \throws std::invalid_argument if the scan has no descriptors */
ScanIndex
makeScanIndex(const Scan& scan, ScanMaker& maker, ThreadPool& pool);

} // namespace pcl_flashreg
