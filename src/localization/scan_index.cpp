// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "localization/scan_index_data.h"

#include "scan/scan_view.h"

#include <stdexcept>
#include <utility>

namespace pcl_flashreg {
namespace {

void
indexFeatures(const Scan& scan, std::optional<FeatureIndex>& index, ThreadPool& pool)
{
  DistinctFeatures features(scan.features());
  if (features.size() > 0)
    index.emplace(std::move(features), pool);
}

} // namespace

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
  const CloudView<float> view = viewOf(scan);
  data->middle = middleOf(view) + shiftOf(scan);
  data->surface.build(view,
                      data->middle - shiftOf(scan),
                      static_cast<float>(scan.spacing()),
                      /* in_order */ true);
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
