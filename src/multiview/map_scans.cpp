// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/map_scans.h"

#include "math/isometry.h"
#include "scan/scan_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_flashreg {
MapScans::MapScans(std::size_t count,
                   MultiviewRegistration::ScanSource source,
                   ThreadPool& pool,
                   std::size_t most_bytes)
    : source_(std::move(source)),
      most_bytes_(most_bytes),
      scans_(count),
      blind_(count),
      kept_(count)
{
  pool.forEach(count, [&](std::size_t i, std::size_t) {
    const Scan scan = source_(i);
    MapScan& entry = scans_[i];
    entry.middle = toEigen(middleOf(viewOf(scan)) + shiftOf(scan));
    entry.spacing = scan.spacing();
    const auto surface = make(scan, i);
    entry.points = surface->points.size();
    for (const Eigen::Vector3f& point : surface->points)
      entry.radius = std::max(entry.radius, static_cast<double>(point.norm()));
    keep(i, surface);
  });
}

void
MapScans::setBlind(const std::vector<bool>& blind)
{
  for (std::size_t i = 0; i < size(); ++i)
    if (blind[i] != blind_[i])
      drop(i);
  blind_ = blind;
}

TwoClouds
MapScans::clouds(std::size_t source, std::size_t target) const
{
  const double spacing = std::max(scans_[source].spacing, scans_[target].spacing);
  return {surface(source), surface(target), static_cast<float>(spacing)};
}

std::shared_ptr<const Surface>
MapScans::surface(std::size_t scan) const
{
  {
    const std::lock_guard lock(mutex_);
    const Kept& kept = kept_[scan];
    if (kept.surface) {
      recent_.splice(recent_.begin(), recent_, kept.use);
      return kept.surface;
    }
  }
  return keep(scan, make(source_(scan), scan));
}

std::shared_ptr<const Surface>
MapScans::make(const Scan& scan, std::size_t number) const
{
  CloudView<float> view = viewOf(scan);
  view.normals_oriented = false;
  if (blind_[number] || scan.viewpointSource() == ViewpointSource::Points)
    view.viewpoint.reset();
  auto surface = std::make_shared<Surface>();
  surface->build(view, middleOf(view), static_cast<float>(scans_[number].spacing));
  return surface;
}

/** \brief Another thread may have been as quick. */
std::shared_ptr<const Surface>
MapScans::keep(std::size_t scan, std::shared_ptr<const Surface> surface) const
{
  const std::lock_guard lock(mutex_);
  Kept& kept = kept_[scan];
  if (kept.surface)
    return kept.surface;
  kept.surface = surface;
  recent_.push_front(scan);
  kept.use = recent_.begin();
  bytes_ += surface->bytes();
  while (bytes_ > most_bytes_ && !recent_.empty())
    drop(recent_.back());
  return surface;
}

void
MapScans::drop(std::size_t scan) const
{
  Kept& kept = kept_[scan];
  if (!kept.surface)
    return;
  bytes_ -= kept.surface->bytes();
  recent_.erase(kept.use);
  kept.surface.reset();
}

} // namespace pcl_flashreg
