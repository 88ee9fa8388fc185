// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../datasets/pair.h"
#include "descriptors.h"
#include "stored_scan.h"
#include "feature_cache.h"

#include <pcl_flashreg/pair_registration.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief Features of clouds, computed once for all the pairs that a cloud belongs to and
 * let go after the last of them. */
class FeatureStore {
public:
  using Cloud = std::shared_ptr<const StoredScan>;

  /** \param[in] cache_folder keeps features on disk; empty for not at all
   * \param[in] bin_fields see DataSet
   * \throws io::InputError if the cache's folder cannot be made
   */
  FeatureStore(std::string root,
               double leaf,
               unsigned threads,
               const std::string& cache_folder,
               Descriptors descriptors = Descriptors::Native,
               std::size_t bin_fields = 0);

  /** \brief Announces a pair that get() will be called for. */
  void
  expect(const Pair& pair);

  /** \throws io::InputError with the path */
  Cloud
  get(const std::string& path, ScanContent content = ScanContent::Descriptors);

  /** \brief The pair is done: clouds that no other announced pair needs are dropped. */
  void
  release(const Pair& pair);

  /** \brief Clouds held at the moment. */
  std::size_t
  size() const
  {
    return clouds_.size();
  }

private:
  Cloud
  describe(const std::string& path, ScanContent content);
  Scan
  make(const ScanInput<double>& input, ScanContent content);

  std::string root_;
  double leaf_;
  PairRegistration maker_;
  Descriptors descriptors_;
  std::size_t bin_fields_;
  std::optional<FeatureCache> cache_;
  std::map<std::string, std::size_t> uses_;
  std::map<std::pair<std::string, ScanContent>, Cloud> clouds_;
};

} // namespace pcl_flashreg::evaluate
