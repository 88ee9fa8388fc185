// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "localization/scan_index_data.h"

#include <Eigen/Geometry>

#include <stdexcept>
#include <utility>

namespace pcl_flashreg {
namespace {

void
indexFeatures(const Scan& scan, std::optional<FeatureIndex>& index, ThreadPool& pool)
{
  if (DistinctFeatures(scan.features()).size() > 0)
    index.emplace(scan.features(), pool);
}

} // namespace

Vec3
middleOf(const Scan& scan)
{
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < scan.size(); ++i)
    box.extend(Eigen::Map<const Eigen::Vector3f>(scan.points() + 3 * i));
  if (box.isEmpty())
    box.extend(Eigen::Vector3f(Eigen::Vector3f::Zero()));
  const Eigen::Vector3d middle =
      0.5 * (box.min().cast<double>() + box.max().cast<double>()) + scan.shift();
  return {middle.x(), middle.y(), middle.z()};
}

std::optional<Eigen::Vector3f>
viewpointIn(const Scan& scan)
{
  if (!scan.viewpoint())
    return std::nullopt;
  const Vec3 middle = middleOf(scan);
  return (*scan.viewpoint() - Eigen::Vector3d(middle.x, middle.y, middle.z))
      .cast<float>();
}

ScanIndex
makeScanIndex(const Scan& scan, ScanMaker& maker, ThreadPool& pool)
{
  if (!scan.empty() && scan.features().dimension == 0)
    throw std::invalid_argument("scan: it has no descriptors to be found by");
  const auto data = std::make_shared<ScanIndex::Data>();
  data->scan = scan;
  if (scan.empty())
    return ScanIndex(data);
  if (!scan.origins())
    data->coarse = maker.coarser(scan, COARSER);
  indexFeatures(data->scan, data->features, pool);
  indexFeatures(data->coarse, data->coarse_features, pool);
  data->middle = middleOf(scan);
  const Eigen::Vector3d& shift = scan.shift();
  data->surface.build(
      CloudView<float>{scan.points(), scan.normals(), scan.size(), std::nullopt},
      data->middle - Vec3{shift.x(), shift.y(), shift.z()},
      static_cast<float>(scan.spacing()),
      true);
  data->surface.lookFrom(viewpointIn(scan), static_cast<float>(scan.spacing()));
  return ScanIndex(data);
}

ScanIndex::ScanIndex() : data_(std::make_shared<const Data>()) {}

ScanIndex::ScanIndex(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

const Scan&
ScanIndex::scan() const
{
  return data_->scan;
}

std::size_t
ScanIndex::bytes() const
{
  const auto ofScan = [](const Scan& scan) {
    const std::size_t floats = 3 + 3 + 1 + scan.features().dimension;
    return scan.size() *
           (floats * sizeof(float) + (scan.origins() ? sizeof(std::int32_t) : 0));
  };
  std::size_t sum =
      ofScan(data_->scan) + ofScan(data_->coarse) + data_->surface.bytes();
  for (const auto* features : {&data_->features, &data_->coarse_features})
    if (*features)
      sum += (*features)->bytes();
  return sum;
}

} // namespace pcl_flashreg
