// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "bindings.h"
#include "call.h"
#include "cloud.h"
#include "result.h"

#include <pcl_flashreg/feature_extractor.h>
#include <pcl_flashreg/resolution.h>

#include <pybind11/stl.h>

namespace pcl_flashreg::python {
namespace {

using namespace py::literals;

Eigen::Vector3d
shiftOf(const Cloud& cloud)
{
  if (isDouble(cloud.points()))
    return singlePrecisionShift(CloudInput<double>(cloud).input.points);
  return singlePrecisionShift(CloudInput<float>(cloud).input.points);
}

PointView
pointViewOf(const Rows<float>& points)
{
  return {points.data, points.size, points.stride, nullptr, 0};
}

DescribedCloud
computeFeatures(py::handle object,
                double voxel_size,
                const std::optional<double>& normal_radius,
                const std::optional<double>& feature_radius,
                unsigned num_threads)
{
  const Cloud cloud = cloudOf(object, "cloud");
  if (!shiftOf(cloud).isZero(0))
    throw py::value_error("cloud: its coordinates are too large for single precision; "
                          "PairRegistration.make_scan() takes them");
  const Rows<float> points = rowsOf<float>(cloud.points());
  FeatureParameters parameters;
  parameters.voxel_size = voxel_size;
  parameters.normal_radius = normal_radius.value_or(2 * voxel_size);
  parameters.feature_radius = feature_radius.value_or(5 * voxel_size);
  if (cloud.viewpoint())
    Eigen::Map<Eigen::Vector3f>(parameters.viewpoint) =
        cloud.viewpoint()->cast<float>();
  return compute([&](const Cancellation&) {
    return FeatureExtractor(num_threads).describe(pointViewOf(points), parameters);
  });
}

FeatureView
featuresOf(const Rows<float>& rows)
{
  return {rows.data, rows.size, rows.columns, rows.stride};
}

py::tuple
match(py::handle queries,
      py::handle targets,
      std::size_t k,
      bool mutual,
      unsigned num_threads)
{
  const auto from = rowsOf<float>(floatTable(queries, "queries", 0));
  const auto to = rowsOf<float>(floatTable(targets, "targets", 0));
  return tupleOf(compute([&](const Cancellation&) {
    FeatureMatcher matcher(num_threads);
    return mutual ? matcher.matchBothWays(featuresOf(from), featuresOf(to), k).mutual()
                  : matcher.match(featuresOf(from), featuresOf(to), k);
  }));
}

double
estimate(py::handle object)
{
  const Cloud cloud = cloudOf(object, "cloud");
  const Eigen::Vector3d shift = shiftOf(cloud);
  py::array near = cloud.points();
  if (!shift.isZero(0))
    near = near.attr("__sub__")(arrayOf(shift));
  const Rows<float> points = rowsOf<float>(near);
  return compute(
      [&](const Cancellation&) { return estimateResolution(pointViewOf(points)); });
}

/** \brief An array of the described cloud's, of so many columns. */
template <std::size_t COLUMNS>
auto
rowsOfMember(std::vector<float> DescribedCloud::*member)
{
  return [member](py::object self) {
    const auto& cloud = self.cast<const DescribedCloud&>();
    return viewOf((cloud.*member).data(),
                  {static_cast<py::ssize_t>(cloud.size), py::ssize_t{COLUMNS}},
                  self);
  };
}

void
bindDescribedCloud(py::module_& module)
{
  using D = DescribedCloud;
  py::class_<D>(module,
                "DescribedCloud",
                "Keypoints of a cloud with their normals and descriptors.")
      .def_property_readonly(
          "points", rowsOfMember<3>(&D::points), "N x 3 float32, in the cloud's frame.")
      .def_property_readonly("normals",
                             rowsOfMember<3>(&D::normals),
                             "N x 3 float32, unit normals towards the viewpoint.")
      .def_property_readonly(
          "curvatures",
          [](py::object self) {
            const auto& cloud = self.cast<const D&>();
            return viewOf(
                cloud.curvatures.data(), {static_cast<py::ssize_t>(cloud.size)}, self);
          },
          "N float32: least eigenvalue of the neighbours' covariance over their sum.")
      .def_property_readonly("descriptors",
                             rowsOfMember<33>(&D::descriptors),
                             "N x 33 float32, FPFH: three histograms of 11 bins, each\n"
                             "summing up to 100.")
      .def("__len__", [](const D& cloud) { return cloud.size; })
      .def("__repr__", [](const D& cloud) {
        return "DescribedCloud(" + std::to_string(cloud.size) + " keypoints)";
      });
}

} // namespace

void
bindFeatures(py::module_& module)
{
  bindDescribedCloud(module);
  module.def(
      "compute_features",
      &computeFeatures,
      "cloud"_a,
      "voxel_size"_a,
      py::kw_only(),
      "normal_radius"_a = py::none(),
      "feature_radius"_a = py::none(),
      "num_threads"_a = 0,
      R"(Downsamples a cloud and describes what is left by Fast Point Feature Histograms.

Args:
    cloud: as the source of align(); normals and features that it brings are not used, its
        viewpoint is what normals are turned to. Coordinates are rounded to float32.
    voxel_size: one keypoint is kept a voxel; 0 keeps every point, and needs both radii.
    normal_radius: neighbours that give a point its normal; 2 voxel_size by default.
    feature_radius: neighbours that are described; 5 voxel_size by default.
    num_threads: 0 for as many as there are processors.

All lengths are in the unit of the cloud.

Returns:
    A DescribedCloud.

Raises:
    TypeError, ValueError, OSError: as align(); ValueError where a length is out of range, or
        where float32 is too coarse for the coordinates.
)");
  module.def("match_features",
             &match,
             "queries"_a,
             "targets"_a,
             "k"_a = 1,
             py::kw_only(),
             "mutual"_a = false,
             "num_threads"_a = 0,
             R"(The k nearest target descriptors of each query descriptor.

Args:
    queries, targets: N x D and M x D, float32 (float64 is rounded). Rows with a value that is
        not finite are skipped.
    k: matches a query.
    mutual: keep those only that hold the other way round, too.
    num_threads: 0 for as many as there are processors.

Returns:
    K x 2 int32, rows of query and target, by query, then distance, then target; K float32,
    squared distances.

Raises:
    TypeError, ValueError: other numbers, other shapes, dimensions that differ, k < 1.
)");
  module.def("estimate_resolution",
             &estimate,
             "cloud"_a,
             R"(A voxel size for a cloud that nobody knows one for, in its unit.

About 5 cm for a room, 2.5 mm for a scan of a 15 cm object, 15 to 50 cm for a lidar sweep.

Raises:
    TypeError, ValueError, OSError: as align(); ValueError: there are fewer than two distinct
        finite points.
)");
}

} // namespace pcl_flashreg::python
