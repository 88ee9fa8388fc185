// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "feature_store.h"

#include "../../io/cloud_io.h"
#include "../../io/error.h"
#include "../../io/pcl_cloud.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <limits>

namespace pcl_flashreg::evaluate {

FeatureStore::FeatureStore(std::string root,
                           double leaf,
                           unsigned threads,
                           const std::string& cache_folder)
    : root_(std::move(root)), leaf_(leaf), extractor_(threads)
{
  if (!cache_folder.empty())
    cache_.emplace(cache_folder, leaf);
}

void
FeatureStore::expect(const Pair& pair)
{
  ++uses_[pair.source];
  ++uses_[pair.target];
}

FeatureStore::Cloud
FeatureStore::get(const std::string& path)
{
  Cloud& cloud = clouds_[path];
  if (!cloud)
    cloud = describe(root_ + "/" + path);
  return cloud;
}

void
FeatureStore::release(const Pair& pair)
{
  for (const std::string& path : {pair.source, pair.target})
    if (--uses_[path] == 0) {
      clouds_.erase(path);
      uses_.erase(path);
    }
}

FeatureStore::Cloud
FeatureStore::describe(const std::string& path)
{
  std::string key;
  if (cache_) {
    key = cache_->keyOf(path);
    if (const auto cached = cache_->load(key))
      return std::make_shared<DescribedCloud>(*cached);
  }
  const io::Cloud file = io::readCloud(path);
  const io::ShiftedCloud cloud = io::toPclCloud(io::coordinates(file));
  const auto described = std::make_shared<DescribedCloud>();
  described->viewpoint = Eigen::Vector3d(file.viewpoint.data());
  if (!cloud.shift.isZero(0) && described->viewpoint.isZero(0))
    described->viewpoint.setConstant(std::numeric_limits<double>::quiet_NaN());
  else
    cloud.points->sensor_origin_.head<3>() =
        (described->viewpoint - cloud.shift).cast<float>();
  const detail::Stopwatch stopwatch;
  try {
    described->keypoints = computeFpfh(*cloud.points, {}, leaf_, extractor_);
  }
  catch (const std::invalid_argument& error) {
    throw io::InputError(path + ": " + error.what());
  }
  described->features_ms = stopwatch.milliseconds();
  described->shift = cloud.shift;
  if (cache_)
    cache_->save(key, *described);
  return described;
}

} // namespace pcl_flashreg::evaluate
