// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/flash_multiview_registration.h>
#include <pcl_flashreg/impl/move_cloud.hpp>
#include <pcl_flashreg/impl/number_text.hpp>

#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace pcl_flashreg {

template <typename PointT>
typename FlashMultiviewRegistration<PointT>::Vertex
FlashMultiviewRegistration<PointT>::addPointCloud(const PointCloudConstPtr& cloud)
{
  nodes_.emplace_back();
  setPointCloud(nodes_.size() - 1, cloud);
  return nodes_.size() - 1;
}

template <typename PointT>
void
FlashMultiviewRegistration<PointT>::setPointCloud(Vertex vertex,
                                                  const PointCloudConstPtr& cloud)
{
  Node& node = nodes_.at(vertex);
  if (!cloud)
    PCL_ERROR("[pcl::FlashMultiviewRegistration] No cloud given!\n");
  node.cloud = cloud ? cloud : PointCloudConstPtr(new PointCloud);
  node.side.reset();
  node.side.setViewpointKnown(viewpoints_known_);
  resetResult();
}

template <typename PointT>
void
FlashMultiviewRegistration<PointT>::setViewpointsKnown(bool known)
{
  viewpoints_known_ = known;
  for (Node& node : nodes_)
    node.side.setViewpointKnown(known);
}

template <typename PointT>
void
FlashMultiviewRegistration<PointT>::resetResult()
{
  result_ = {};
  result_.scans.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    result_.scans[i].group = i;
    result_.groups.push_back({i});
  }
  converged_ = false;
  estimated_resolution_ = 0;
  error_message_.clear();
}

template <typename PointT>
double
FlashMultiviewRegistration<PointT>::estimateResolutions()
{
  std::vector<double> estimates;
  for (const Node& node : nodes_) {
    const detail::FloatRows<PointT> rows(*node.cloud, {});
    const ScanInput<float> input = node.side.inputFrom(*node.cloud, rows);
    try {
      estimates.push_back(registration_.get().chooseResolution(input, input));
    }
    catch (const std::invalid_argument&) {
      // Too few points for one; then for a scan, too.
    }
  }
  if (estimates.empty())
    throw std::invalid_argument("no cloud has points that differ");
  const auto middle =
      estimates.begin() + static_cast<std::ptrdiff_t>(estimates.size() / 2);
  std::nth_element(estimates.begin(), middle, estimates.end());
  return *middle;
}

template <typename PointT>
std::vector<Scan>
FlashMultiviewRegistration<PointT>::makeScans(double resolution)
{
  std::vector<Scan> scans;
  for (Node& node : nodes_) {
    const bool has_points =
        std::any_of(node.cloud->begin(), node.cloud->end(), [](const PointT& point) {
          return pcl::isXYZFinite(point);
        });
    if (has_points && node.side.scan().spacing() != resolution) {
      const detail::FloatRows<PointT> rows(*node.cloud, {});
      try {
        node.side.keep(*node.cloud,
                       registration_.get().makeScan(
                           node.side.inputFrom(*node.cloud, rows), resolution));
      }
      catch (const std::invalid_argument& error) {
        throw std::invalid_argument("cloud " + std::to_string(scans.size()) + ": " +
                                    error.what());
      }
    }
    scans.push_back(has_points ? node.side.scan() : Scan());
  }
  return scans;
}

template <typename PointT>
void
FlashMultiviewRegistration<PointT>::compute()
{
  resetResult();
  try {
    if (!(resolution_ >= 0 && std::isfinite(resolution_)))
      throw std::invalid_argument("the resolution is " + detail::toText(resolution_) +
                                  ", it must be > 0 and finite, or 0 to estimate it");
    if (nodes_.size() < 2)
      throw std::invalid_argument("fewer than two clouds were given");
    const double resolution = resolution_ != 0 ? resolution_ : estimateResolutions();
    MultiviewOptions options = options_;
    if (parameters_)
      options.pair = optionsWith(*parameters_);
    applyMotion(options.pair.parameters);
    options.pair.resolution = resolution;
    MultiviewRegistration registration(registration_.backend(),
                                       registration_.numThreads());
    result_ = registration.align(makeScans(resolution), options);
    converged_ = result_.groups.size() == 1;
    estimated_resolution_ = resolution;
  }
  catch (const std::exception& error) {
    resetResult();
    error_message_ = error.what();
    PCL_ERROR("[pcl::FlashMultiviewRegistration::compute] %s\n", error.what());
  }
}

template <typename PointT>
typename FlashMultiviewRegistration<PointT>::PointCloudPtr
FlashMultiviewRegistration<PointT>::getTransformedCloud(Vertex vertex) const
{
  PointCloudPtr cloud(new PointCloud(*nodes_.at(vertex).cloud));
  detail::moveCloud(*cloud, placeOf(vertex).T_group_scan);
  return cloud;
}

template <typename PointT>
typename FlashMultiviewRegistration<PointT>::PointCloudPtr
FlashMultiviewRegistration<PointT>::getConcatenatedCloud(std::size_t group) const
{
  PointCloudPtr cloud(new PointCloud);
  if (group < result_.groups.size())
    for (const std::size_t vertex : result_.groups[group])
      *cloud += *getTransformedCloud(vertex);
  return cloud;
}

} // namespace pcl_flashreg
