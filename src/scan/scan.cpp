// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/scan.h>

#include "scan/scan_data.h"

#include <utility>

namespace pcl_flashreg {

Scan::Scan() : data_(std::make_shared<const Data>()) {}

Scan::Scan(std::shared_ptr<const Data> data,
           const Eigen::Vector3d& viewpoint,
           ViewpointSource source)
    : data_(std::move(data)), viewpoint_source_(source)
{
  if (source != ViewpointSource::Unknown)
    viewpoint_ = viewpoint;
}

std::size_t
Scan::size() const
{
  return data_->size();
}

const float*
Scan::points() const
{
  return data_->points.data();
}

const float*
Scan::normals() const
{
  return data_->normals.data();
}

bool
Scan::normalsOriented() const
{
  return data_->normals_oriented;
}

const float*
Scan::curvatures() const
{
  return data_->curvatures.data();
}

FeatureView
Scan::features() const
{
  if (data_->dimension == 0)
    return {};
  return {data_->descriptors.data(), size(), data_->dimension, data_->dimension};
}

const std::int32_t*
Scan::origins() const
{
  return data_->origins.empty() ? nullptr : data_->origins.data();
}

double
Scan::spacing() const
{
  return data_->spacing;
}

const Eigen::Vector3d&
Scan::shift() const
{
  return data_->shift;
}

Scan
Scan::withoutViewpoint() const
{
  return {data_, Eigen::Vector3d::Zero(), ViewpointSource::Unknown};
}

} // namespace pcl_flashreg
