// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/feature_matching.h>

#include "matching/search.h"

namespace pcl_flashreg {

class FeatureMatcher::Impl {
public:
  explicit Impl(unsigned num_threads) : pool(num_threads) {}

  ThreadPool pool;
};

FeatureMatcher::FeatureMatcher(unsigned num_threads)
    : impl_(std::make_unique<Impl>(num_threads))
{
}

FeatureMatcher::~FeatureMatcher() = default;
FeatureMatcher::FeatureMatcher(FeatureMatcher&&) noexcept = default;
FeatureMatcher&
FeatureMatcher::operator=(FeatureMatcher&&) noexcept = default;

std::vector<FeatureMatch>
FeatureMatcher::match(const FeatureView& queries,
                      const FeatureView& targets,
                      std::size_t k)
{
  return searchFeatures(queries, targets, k, false, impl_->pool).forward;
}

MutualMatches
FeatureMatcher::matchBothWays(const FeatureView& queries,
                              const FeatureView& targets,
                              std::size_t k)
{
  return searchFeatures(queries, targets, k, true, impl_->pool);
}

std::vector<FeatureMatch>
matchFeatures(const FeatureView& queries,
              const FeatureView& targets,
              std::size_t k,
              unsigned num_threads)
{
  return FeatureMatcher(num_threads).match(queries, targets, k);
}

MutualMatches
matchFeaturesBothWays(const FeatureView& queries,
                      const FeatureView& targets,
                      std::size_t k,
                      unsigned num_threads)
{
  return FeatureMatcher(num_threads).matchBothWays(queries, targets, k);
}

} // namespace pcl_flashreg
