// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/scan.h>

#include "scan/scan_data.h"

#include <utility>
#include <vector>

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

namespace {

/** \brief Some rows of an array that has so many values a row. */
template <typename Value>
void
takeRows(const Array<Value>& from,
         const std::vector<std::size_t>& rows,
         std::size_t length,
         Array<Value>& to)
{
  std::vector<Value> values;
  if (!from.empty())
    for (const std::size_t row : rows)
      values.insert(values.end(), &from[row * length], &from[row * length] + length);
  to = std::move(values);
}

} // namespace

Scan
Scan::within(const Eigen::Vector3d& centre, double radius) const
{
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < size(); ++i)
    if ((point(i) - centre).squaredNorm() <= radius * radius)
      rows.push_back(i);
  const auto part = std::make_shared<Data>();
  takeRows(data_->points, rows, 3, part->points);
  takeRows(data_->normals, rows, 3, part->normals);
  takeRows(data_->curvatures, rows, 1, part->curvatures);
  takeRows(data_->descriptors, rows, data_->dimension, part->descriptors);
  takeRows(data_->origins, rows, 1, part->origins);
  part->dimension = data_->dimension;
  part->normals_oriented = data_->normals_oriented;
  part->spacing = data_->spacing;
  part->shift = data_->shift;
  return {part, viewpoint_.value_or(Eigen::Vector3d::Zero()), viewpoint_source_};
}

} // namespace pcl_flashreg
