// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/estimator.h>
#include <pcl_flashreg/feature_extractor.h>
#include <pcl_flashreg/feature_matching.h>

#include <memory>

namespace pcl_flashreg {
namespace detail {

/** \brief What does the work of a class, with its threads and memory, kept from call to
 * call. Each part is made when it is first needed, so that one which can't be had is
 * reported by the computation and not by a constructor; a copy makes its own. */
class LazyWorkers {
public:
  LazyWorkers() = default;
  LazyWorkers(const LazyWorkers& other)
      : backend_(other.backend_), num_threads_(other.num_threads_)
  {
  }
  LazyWorkers&
  operator=(const LazyWorkers& other)
  {
    configure(other.backend_, other.num_threads_);
    return *this;
  }

  void
  configure(BackendKind backend, unsigned num_threads)
  {
    backend_ = backend;
    num_threads_ = num_threads;
    estimator_.reset();
    extractor_.reset();
    matcher_.reset();
  }

  BackendKind
  backend() const
  {
    return backend_;
  }

  unsigned
  numThreads() const
  {
    return num_threads_;
  }

  /** \throws BackendError, std::invalid_argument as Estimator's constructor */
  Estimator&
  estimator()
  {
    if (!estimator_)
      estimator_ = std::make_unique<Estimator>(backend_, num_threads_);
    return *estimator_;
  }

  /** \throws BackendError, std::invalid_argument as FeatureExtractor's constructor */
  FeatureExtractor&
  extractor()
  {
    if (!extractor_)
      extractor_ = std::make_unique<FeatureExtractor>(num_threads_);
    return *extractor_;
  }

  FeatureMatcher&
  matcher()
  {
    if (!matcher_)
      matcher_ = std::make_unique<FeatureMatcher>(num_threads_);
    return *matcher_;
  }

private:
  BackendKind backend_ = BackendKind::Auto;
  unsigned num_threads_ = 0;
  std::unique_ptr<Estimator> estimator_;
  std::unique_ptr<FeatureExtractor> extractor_;
  std::unique_ptr<FeatureMatcher> matcher_;
};

} // namespace detail
} // namespace pcl_flashreg
