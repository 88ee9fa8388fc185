// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "feature_store.h"

#include "../../io/cloud_io.h"
#include "../../io/error.h"
#include "../../io/scan_input.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

namespace pcl_flashreg::evaluate {

FeatureStore::FeatureStore(std::string root,
                           double leaf,
                           unsigned threads,
                           const std::string& cache_folder,
                           Descriptors descriptors,
                           std::size_t bin_fields)
    : root_(std::move(root)),
      leaf_(leaf),
      maker_(BackendKind::Cpu, threads),
      descriptors_(descriptors),
      bin_fields_(bin_fields)
{
  if (!cache_folder.empty())
    cache_.emplace(cache_folder, leaf, descriptors, bin_fields);
}

void
FeatureStore::expect(const Pair& pair)
{
  ++uses_[pair.source];
  ++uses_[pair.target];
}

FeatureStore::Cloud
FeatureStore::get(const std::string& path, ScanContent content)
{
  Cloud& cloud = clouds_[{path, content}];
  if (!cloud)
    cloud = describe(root_ + "/" + path, content);
  return cloud;
}

void
FeatureStore::release(const Pair& pair)
{
  for (const std::string& path : {pair.source, pair.target})
    if (--uses_[path] == 0) {
      clouds_.erase({path, ScanContent::Descriptors});
      clouds_.erase({path, ScanContent::Surface});
      uses_.erase(path);
    }
}

Scan
FeatureStore::make(const ScanInput<double>& input, ScanContent content)
{
  if (descriptors_ == Descriptors::Native || content == ScanContent::Surface)
    return maker_.makeScan(input, leaf_, content);
  return describeAnew(
      maker_.makeScan(input, leaf_, ScanContent::Surface), descriptors_, maker_);
}

FeatureStore::Cloud
FeatureStore::describe(const std::string& path, ScanContent content)
{
  std::string key;
  if (cache_) {
    key = cache_->keyOf(path, content);
    if (const auto cached = cache_->load(key))
      return std::make_shared<StoredScan>(*cached);
  }
  const io::Cloud file = io::readCloud(path, bin_fields_);
  const Eigen::Matrix3Xd xyz = io::coordinates(file);
  const auto stored = std::make_shared<StoredScan>();
  const detail::Stopwatch stopwatch;
  try {
    stored->scan = make(io::scanInput(file, xyz), content);
  }
  catch (const std::invalid_argument& error) {
    throw io::InputError(path + ": " + error.what());
  }
  stored->features_ms = stopwatch.milliseconds();
  if (cache_)
    cache_->save(key, *stored);
  return stored;
}

} // namespace pcl_flashreg::evaluate
