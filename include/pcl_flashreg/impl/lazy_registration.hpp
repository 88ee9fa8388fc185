// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/pair_registration.h>

#include <memory>

namespace pcl_flashreg {
namespace detail {

/** \brief What does the work of a class, with its threads and memory, kept from call to
 * call. It is made when it is first needed, so that a backend which can't be had is
 * reported by the computation and not by a constructor; a copy makes its own. */
class LazyRegistration {
public:
  LazyRegistration() = default;
  LazyRegistration(const LazyRegistration& other)
      : backend_(other.backend_), num_threads_(other.num_threads_)
  {
  }
  LazyRegistration&
  operator=(const LazyRegistration& other)
  {
    configure(other.backend_, other.num_threads_);
    return *this;
  }

  void
  configure(BackendKind backend, unsigned num_threads)
  {
    backend_ = backend;
    num_threads_ = num_threads;
    registration_.reset();
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

  /** \throws BackendError, std::invalid_argument as PairRegistration's constructor */
  PairRegistration&
  get()
  {
    if (!registration_)
      registration_ = std::make_unique<PairRegistration>(backend_, num_threads_);
    return *registration_;
  }

private:
  BackendKind backend_ = BackendKind::Auto;
  unsigned num_threads_ = 0;
  std::unique_ptr<PairRegistration> registration_;
};

} // namespace detail
} // namespace pcl_flashreg
