// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "bindings.h"
#include "call.h"
#include "choice.h"
#include "options.h"
#include "pair_argument.h"
#include "pair_object.h"
#include "result.h"

#include <pybind11/stl.h>

namespace pcl_flashreg::python {
namespace {

using namespace py::literals;

template <typename Scalar>
PairResult
alignClouds(PairRegistration& registration,
            const PairArgument& source,
            const PairArgument& target,
            const PairOptions& options)
{
  const CloudInput<Scalar> from(*source.cloud()), to(*target.cloud());
  return run(options, [&](const PairOptions& each) {
    return registration.align(from.input, to.input, each);
  });
}

PairResult
alignScans(PairRegistration& registration,
           const PairArgument& source,
           const PairArgument& target,
           const PairOptions& options)
{
  source.requireDescriptors("source");
  target.requireDescriptors("target");
  const double resolution = resolutionBeside(source, target, options);
  const auto from = source.scanMaker(ScanContent::Descriptors);
  const auto to = target.scanMaker(ScanContent::Descriptors);
  return run(options, [&](const PairOptions& each) {
    const Scan scan = from(registration, resolution);
    if (target.index())
      return registration.align(scan, *target.index(), each);
    return registration.align(scan, to(registration, resolution), each);
  });
}

PairResult
align(PairObject& self,
      py::handle source,
      py::handle target,
      const std::optional<double>& resolution,
      py::handle parameters,
      py::handle guess,
      std::size_t neighbors,
      bool mutual,
      bool cloud_check,
      bool second_look,
      bool give_up_early)
{
  const Turn turn = self.turn();
  PairOptions options = optionsOf(resolution, parameters, guess, cloud_check);
  applyMatching(neighbors, mutual, options);
  options.second_look = second_look;
  options.give_up_early = give_up_early;
  const PairArgument from(source, "source"), to(target, "target");
  if (from.index())
    throw py::type_error("source: is a ScanIndex, which only the target can be");
  if (!from.cloud() || !to.cloud())
    return alignScans(self.registration, from, to, options);
  if (from.isDouble() || to.isDouble())
    return alignClouds<double>(self.registration, from, to, options);
  return alignClouds<float>(self.registration, from, to, options);
}

Scan
makeScan(PairObject& self, py::handle cloud, double resolution, bool descriptors)
{
  const Turn turn = self.turn();
  const PairArgument argument(cloud, "cloud");
  if (!argument.cloud())
    throw py::type_error("cloud: is a scan already");
  const auto make =
      argument.scanMaker(descriptors ? ScanContent::Descriptors : ScanContent::Surface);
  return compute(
      [&](const Cancellation&) { return make(self.registration, resolution); });
}

ScanIndex
makeIndex(PairObject& self, const Scan& scan)
{
  const Turn turn = self.turn();
  return compute(
      [&](const Cancellation&) { return self.registration.makeIndex(scan); });
}

py::tuple
match(PairObject& self,
      const Scan& source,
      const Scan& target,
      std::size_t neighbors,
      bool mutual)
{
  const Turn turn = self.turn();
  PairOptions options;
  applyMatching(neighbors, mutual, options);
  return tupleOf(compute([&](const Cancellation&) {
    return self.registration.match(source, target, options);
  }));
}

const char* const ALIGN = R"(Registers two clouds with no initial guess.

Args:
    source, target: each an N x 3 array of float32 or float64, what offers its memory as one
        (Open3D's Vector3dVector and tensors, torch's tensors on the CPU, DLPack), something
        with such points (Open3D's PointCloud), a path to a PCD, PLY or .bin file, a Cloud or
        a Scan; the target may be a ScanIndex. An array counts as seen from its origin, a
        file from where it says; a Cloud says otherwise. A cloud beside a scan is made one at
        the scan's resolution.
    resolution: voxel size, in the unit of the clouds; None to estimate it.
    parameters: of the estimator; None for the defaults.
    guess: 4 x 4, a pose that is tried like any other hypothesis.
    neighbors: target descriptors that each source descriptor is matched with.
    mutual: keep matches that hold both ways only.
    cloud_check: whether the clouds judge the hypotheses, too.
    second_look: whether to look a second time where the clouds leave the pose in doubt.
    give_up_early: whether to spend no more time once no pose can become certain.

Returns:
    A Result. The same input gives the same result to the last bit.

Raises:
    TypeError: an argument is of another type; coordinates are neither float32 nor float64.
    ValueError: an array has another shape, a parameter or option is out of range, a cloud
        whose resolution has to be estimated has fewer than two distinct finite points.
    OSError: a file can't be read.
    RuntimeError: the object is in a call of another thread.
    BackendError: the machine fails.
)";

void
bindAlign(py::class_<PairObject>& registration)
{
  registration.def("align",
                   &align,
                   "source"_a,
                   "target"_a,
                   "resolution"_a = py::none(),
                   py::kw_only(),
                   "parameters"_a = py::none(),
                   "guess"_a = py::none(),
                   "neighbors"_a = 1,
                   "mutual"_a = false,
                   "cloud_check"_a = true,
                   "second_look"_a = true,
                   "give_up_early"_a = false,
                   ALIGN);
}

void
bindScans(py::class_<PairObject>& registration)
{
  registration
      .def("make_scan",
           &makeScan,
           "cloud"_a,
           "resolution"_a,
           py::kw_only(),
           "descriptors"_a = true,
           R"(Makes a scan: keypoints, normals and descriptors.

Args:
    cloud: as the source of align().
    resolution: voxel size, in the unit of the cloud; of one with features, the spacing of
        its points.
    descriptors: False for a surface alone, which judges correspondences of the caller's.

Raises:
    As align(); ValueError: the resolution is not > 0, or too small for the cloud's extent.
)")
      .def("make_index",
           &makeIndex,
           "scan"_a,
           "Makes what scans are found in, for maps that are asked more than once.\n\n"
           "Raises:\n    ValueError: the scan has no descriptors.\n")
      .def("match",
           &match,
           "source"_a,
           "target"_a,
           py::kw_only(),
           "neighbors"_a = 1,
           "mutual"_a = false,
           R"(Each descriptor of the source with its nearest ones of the target.

Returns:
    M x 2 int32, rows of source and target keypoints; M float32, squared distances.

Raises:
    ValueError: the descriptors' dimensions differ.
)");
}

} // namespace

void
bindPairRegistration(py::module_& module)
{
  py::class_<PairObject> registration(
      module,
      "PairRegistration",
      R"(Registers pairs of clouds; keeps its threads and its memory from call to call.

Args:
    num_threads: CPU threads of all steps; 0 for as many as there are processors.
    backend: 'auto', 'cpu' or 'cuda'.

Use one object a thread: while one computes, all others of Python's go on.

Raises:
    BackendError: the backend is not to be had on this machine.
)");
  registration
      .def(py::init([](unsigned num_threads, const std::string& backend) {
             return std::make_unique<PairObject>(backend, num_threads);
           }),
           "num_threads"_a = 0,
           "backend"_a = "auto")
      .def_property_readonly(
          "backend",
          [](const PairObject& self) { return self.registration.backendName(); },
          "Name of the backend that was chosen, e.g. 'cpu-avx512'.")
      .def("__repr__", [](const PairObject& self) {
        return "PairRegistration(" + self.registration.backendName() + ")";
      });
  bindAlign(registration);
  bindEstimatePose(registration);
  bindScans(registration);
  module.def("default_parameters", [](double resolution) {
    return fieldsOf(Parameters::fromResolution(resolution));
  });
}

} // namespace pcl_flashreg::python
