// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "bindings.h"
#include "call.h"
#include "choice.h"
#include "cloud.h"
#include "result.h"
#include "scan_files.h"

#include <pcl_flashreg/impl/number_text.hpp>

#include <string_view>

namespace pcl_flashreg::python {
namespace {

using namespace py::literals;

py::array
rowsOfScan(const py::object& self, const float* data, std::size_t columns)
{
  const std::size_t size = self.cast<const Scan&>().size();
  return viewOf(
      data, {static_cast<py::ssize_t>(size), static_cast<py::ssize_t>(columns)}, self);
}

std::string
describe(const Scan& scan)
{
  if (scan.empty())
    return "Scan(empty)";
  const std::size_t values = scan.features().dimension;
  return "Scan(" + std::to_string(scan.size()) + " keypoints, resolution " +
         detail::toText(scan.spacing()) +
         (values == 0 ? ", no descriptors"
                      : ", descriptors of " + std::to_string(values) + " values") +
         ")";
}

Scan
deserialize(const py::bytes& bytes)
{
  return readingFile([&] { return Scan::deserialize(std::string_view(bytes)); });
}

void
bindArrays(py::class_<Scan>& scan)
{
  scan.def_property_readonly(
          "points",
          [](py::object self) {
            return rowsOfScan(self, self.cast<const Scan&>().points(), 3);
          },
          "N x 3 float32: keypoints relative to shift; points + shift are those of "
          "the\n"
          "caller's frame.")
      .def_property_readonly(
          "normals",
          [](py::object self) {
            return rowsOfScan(self, self.cast<const Scan&>().normals(), 3);
          },
          "N x 3 float32, unit normals; NaN where there is none.")
      .def_property_readonly(
          "curvatures",
          [](py::object self) {
            const Scan& s = self.cast<const Scan&>();
            return viewOf(s.curvatures(), {static_cast<py::ssize_t>(s.size())}, self);
          },
          "N float32: least eigenvalue of the neighbours' covariance over their sum.")
      .def_property_readonly(
          "descriptors",
          [](py::object self) {
            const FeatureView view = self.cast<const Scan&>().features();
            return rowsOfScan(self, view.data, view.dimension);
          },
          "N x D float32; D is 0 if the scan has none.")
      .def_property_readonly(
          "origins",
          [](py::object self) -> py::object {
            const Scan& s = self.cast<const Scan&>();
            if (s.origins() == nullptr)
              return py::none();
            return viewOf(s.origins(), {static_cast<py::ssize_t>(s.size())}, self);
          },
          "N int32: which point of the cloud each keypoint is; None where keypoints "
          "are\n"
          "centroids of voxels.")
      .def_property_readonly(
          "shift",
          [](const Scan& s) { return arrayOf(s.shift()); },
          "3 float64; zero unless coordinates are too large for single precision.");
}

} // namespace

void
bindScan(py::module_& module)
{
  py::class_<Scan> scan(
      module, "Scan", R"(All that a registration needs to know of one cloud.

Made by PairRegistration.make_scan(), and used in any number of registrations, by any number of
threads at a time. Never changes: its arrays can't be written to, and stay there as long as
somebody has them. Can be pickled and saved.
)");
  bindArrays(scan);
  scan.def_property_readonly(
          "resolution", &Scan::spacing, "Voxel size, in the unit of the cloud.")
      .def_property_readonly(
          "viewpoint",
          [](const Scan& s) -> py::object {
            if (!s.viewpoint())
              return py::none();
            return arrayOf(*s.viewpoint());
          },
          "Where the sensor stood, in the caller's frame; None if that is not known.")
      .def_property_readonly(
          "viewpoint_source",
          [](const Scan& s) { return wordOf(VIEWPOINT_SOURCES, s.viewpointSource()); },
          "'stated', 'points' (these say otherwise) or 'unknown'.")
      .def("without_viewpoint",
           &Scan::withoutViewpoint,
           "The same scan, of whose sensor nothing is known. Costs nothing.")
      .def(
          "within",
          [](const Scan& s, py::handle center, double radius) {
            const Eigen::Vector3d at = vectorOf(center, "center");
            return compute([&](const Cancellation&) { return s.within(at, radius); });
          },
          "center"_a,
          "radius"_a,
          "The part of the scan within a ball, in the unit and frame of the cloud.")
      .def(
          "save",
          [](const Scan& s, py::handle path) {
            writingFile([&, to = pathOf(path)] { s.save(to); });
          },
          "path"_a,
          "Writes it to a file, whole or not at all.\n\nRaises:\n    OSError: that "
          "failed.\n")
      .def_static(
          "load",
          [](py::handle path) {
            return readingFile(
                [from = readablePath(path)] { return Scan::load(from); });
          },
          "path"_a,
          "Reads what save() wrote.\n\nRaises:\n    OSError: there is no such file.\n"
          "    ValueError: it is no scan, of another version, or damaged.\n")
      .def(py::pickle([](const Scan& s) { return py::bytes(s.serialize()); },
                      &deserialize))
      .def("__copy__", [](const Scan& s) { return Scan(s); })
      .def(
          "__deepcopy__", [](const Scan& s, py::handle) { return Scan(s); }, "memo"_a)
      .def("__len__", &Scan::size)
      .def("__repr__", &describe);
}

} // namespace pcl_flashreg::python
