// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "bindings.h"
#include "call.h"
#include "choice.h"
#include "multiview_result.h"
#include "options.h"

#include <pcl_flashreg/multiview_registration.h>

#include <pybind11/stl.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace pcl_flashreg::python {
namespace {

using namespace py::literals;

/** \brief A MultiviewRegistration that knows whether it is at work. */
struct Registration {
  Registration(const std::string& backend, unsigned threads)
      : registration(choose(BACKENDS, backend, "backend"), threads)
  {
  }

  MultiviewRegistration registration;
  std::atomic<bool> busy{false};
};

/** \brief The whole of it, left at the next pair or look at a scan once nobody waits. */
MultiviewResult
run(MultiviewRegistration& registration,
    const std::vector<Scan>& scans,
    MultiviewOptions options,
    const py::object& progress)
{
  const bool tells = !progress.is_none();
  return compute([&](const Cancellation& cancellation) {
    const auto source = [&](std::size_t i) {
      cancellation.check();
      return scans[i];
    };
    options.on_relation = [&](const ScanRelation&, std::size_t done, std::size_t all) {
      cancellation.check();
      if (!tells)
        return;
      const py::gil_scoped_acquire python;
      progress(done, all);
    };
    const auto relate = [&](const std::vector<MultiviewRegistration::ScanPair>& pairs) {
      return registration.relate(source, pairs, options);
    };
    return registration.align(scans.size(), source, relate, options);
  });
}

MultiviewResult
align(Registration& self,
      const std::vector<Scan>& scans,
      double min_confidence,
      std::size_t alike,
      std::size_t all_pairs_up_to,
      bool sequence,
      py::handle parameters,
      bool give_up_early,
      const py::object& progress)
{
  const Turn turn(self.busy, "MultiviewRegistration");
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0)
    throw py::type_error("progress: has to be a function, or None");
  MultiviewOptions options;
  applyParameters(parameters, options.pair);
  options.pair.give_up_early = give_up_early;
  options.min_confidence = min_confidence;
  options.alike = alike;
  options.all_pairs_up_to = all_pairs_up_to;
  options.sequence = sequence;
  return run(self.registration, scans, std::move(options), progress);
}

const char* const ALIGN =
    R"(Registers scans with each other, in any order and with no guess.

Args:
    scans: made by PairRegistration.make_scan(), all at about the same resolution.
    min_confidence: how certain a bond between groups has to be; in (0, 1).
    alike: how many others each scan is tried with at first; >= 1.
    all_pairs_up_to: up to so many scans, all pairs that the map does not tie to each other
        are tried after that.
    sequence: whether the scans are in the order in which they were made.
    parameters: of the estimator, for each pair; None for the defaults.
    give_up_early: whether to spend no more time on a pair that can't become certain.
    progress: called with how many pairs of how many are done, a round at a time, from any
        thread; what it raises ends the call.

Returns:
    A MultiviewResult, the same to the last bit on any number of threads.

Raises:
    TypeError: an argument is of another type.
    ValueError: an option or a parameter is out of range.
    RuntimeError: the object is in a call of another thread.
)";

} // namespace

void
bindMultiviewRegistration(py::module_& module)
{
  bindMultiviewResult(module);
  py::class_<Registration>(
      module, "MultiviewRegistration", R"(Makes maps of any number of scans.

Args:
    num_threads: pairs that are registered at a time; 0 for as many as there are processors.
    backend: 'auto', 'cpu' or 'cuda'.

Raises:
    BackendError: the backend is not to be had on this machine.
)")
      .def(py::init([](unsigned num_threads, const std::string& backend) {
             return std::make_unique<Registration>(backend, num_threads);
           }),
           "num_threads"_a = 0,
           "backend"_a = "auto")
      .def("align",
           &align,
           "scans"_a,
           py::kw_only(),
           "min_confidence"_a = MultiviewOptions().min_confidence,
           "alike"_a = MultiviewOptions().alike,
           "all_pairs_up_to"_a = MultiviewOptions().all_pairs_up_to,
           "sequence"_a = false,
           "parameters"_a = py::none(),
           "give_up_early"_a = false,
           "progress"_a = py::none(),
           ALIGN);
}

} // namespace pcl_flashreg::python
