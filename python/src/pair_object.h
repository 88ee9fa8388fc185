// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "call.h"
#include "choice.h"

#include <pcl_flashreg/pair_registration.h>

#include <pybind11/pybind11.h>

#include <atomic>
#include <string>

namespace pcl_flashreg::python {

/** \brief A PairRegistration that knows whether it is at work. */
struct PairObject {
  PairObject(const std::string& backend, unsigned threads)
      : registration(choose(BACKENDS, backend, "backend"), threads)
  {
  }

  Turn
  turn()
  {
    return {busy, "PairRegistration"};
  }

  PairRegistration registration;
  std::atomic<bool> busy{false};
};

/** \brief Runs a registration that is left before its next step once nobody waits. */
template <typename Align>
PairResult
run(PairOptions options, const Align& align)
{
  return compute([&](const Cancellation& cancellation) {
    options.on_step = [&](const PairProgress&) { cancellation.check(); };
    PairResult result = align(options);
    return result;
  });
}

/** \brief The method estimate_pose(). */
void
bindEstimatePose(py::class_<PairObject>& registration);

} // namespace pcl_flashreg::python
