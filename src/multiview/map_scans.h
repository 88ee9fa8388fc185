// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/agreement.h"
#include "multiview/map_scan.h"
#include "support/thread_pool.h"

#include <pcl_flashreg/multiview_registration.h>

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <vector>

namespace pcl_flashreg {

/** \brief The surfaces of two scans, each about its own middle, which stay in memory while
 * they are asked. */
struct TwoClouds {
  std::shared_ptr<const Surface> source, target;
  float spacing;

  SurfacePair
  pair() const
  {
    return {*source, *target, spacing};
  }
};

/** \brief The scans of a map. Their surfaces are made when they are asked for, and those that
 * were asked for last are kept. */
class MapScans {
public:
  /** \brief Of memory, for surfaces: enough for a thousand rooms or some hundred turns of a
   * lidar, so that few maps have to make any twice. */
  static constexpr std::size_t SURFACE_BYTES = std::size_t{1} << 30;

  /** \brief Asks for every scan once.
   * \param[in] most_bytes of surfaces that are kept */
  MapScans(std::size_t count,
           MultiviewRegistration::ScanSource source,
           ThreadPool& pool,
           std::size_t most_bytes = SURFACE_BYTES);

  std::size_t
  size() const
  {
    return scans_.size();
  }

  const MapScan&
  operator[](std::size_t scan) const
  {
    return scans_[scan];
  }

  const std::vector<MapScan>&
  all() const
  {
    return scans_;
  }

  /** \brief Scans whose viewpoint is not to be believed. */
  void
  setBlind(const std::vector<bool>& blind);

  /** \brief Any number of threads may call it at a time. */
  TwoClouds
  clouds(std::size_t source, std::size_t target) const;

private:
  struct Kept {
    std::shared_ptr<const Surface> surface;
    /** \brief In recent_. */
    std::list<std::size_t>::iterator use;
  };

  std::shared_ptr<const Surface>
  surface(std::size_t scan) const;
  std::shared_ptr<const Surface>
  make(const Scan& scan, std::size_t number) const;
  std::shared_ptr<const Surface>
  keep(std::size_t scan, std::shared_ptr<const Surface> surface) const;
  void
  drop(std::size_t scan) const;

  MultiviewRegistration::ScanSource source_;
  std::size_t most_bytes_;
  std::vector<MapScan> scans_;
  std::vector<bool> blind_;
  mutable std::mutex mutex_;
  mutable std::vector<Kept> kept_;
  /** \brief The scans whose surface is kept, those first that were asked for last. */
  mutable std::list<std::size_t> recent_;
  mutable std::size_t bytes_ = 0;
};

} // namespace pcl_flashreg
