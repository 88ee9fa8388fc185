// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cloud.h"

#include "bindings.h"
#include "call.h"

#include <io/cloud_io.h>
#include <io/error.h>

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace pcl_flashreg::python {
namespace {

using namespace py::literals;

/** \brief Rows that belong to points. */
std::optional<Rows<float>>
rowsBeside(const py::array& points,
           py::handle object,
           const char* name,
           std::size_t columns)
{
  if (object.is_none())
    return std::nullopt;
  Rows<float> rows = rowsOf<float>(floatTable(object, name, columns));
  if (rows.size != static_cast<std::size_t>(points.shape(0)))
    throw py::value_error(std::string(name) + ": are " + std::to_string(rows.size) +
                          ", but there are " + std::to_string(points.shape(0)) +
                          " points");
  return rows;
}

/** \brief Coordinates as an array that owns them. */
py::array
pointsOf(Eigen::Matrix3Xd&& xyz)
{
  auto* kept = new Eigen::Matrix3Xd(std::move(xyz));
  const py::capsule owner(kept,
                          [](void* p) { delete static_cast<Eigen::Matrix3Xd*>(p); });
  return py::array_t<double>({kept->cols(), py::ssize_t{3}}, kept->data(), owner);
}

Cloud
readCloud(py::handle file, std::size_t bin_fields)
{
  const std::string path = pathOf(file);
  requireReadableFile(path);
  Eigen::Matrix3Xd xyz;
  io::Cloud cloud;
  try {
    compute([&](const Cancellation&) {
      cloud = io::readCloud(path, bin_fields);
      xyz = io::coordinates(cloud);
      return true;
    });
  }
  catch (const io::InputError& error) {
    const std::string what = error.what();
    throw py::value_error(what.find(path) == 0 ? what : path + ": " + what);
  }
  for (const std::string& note : cloud.notes)
    if (PyErr_WarnEx(PyExc_UserWarning, (path + ": " + note).c_str(), 1) != 0)
      throw py::error_already_set();
  const Eigen::Vector3d viewpoint(cloud.viewpoint.data());
  return Cloud(
      pointsOf(std::move(xyz)), py::none(), py::none(), arrayOf(viewpoint), false);
}

py::object
arrayOrNone(const std::optional<Rows<float>>& rows)
{
  return rows ? py::object(rows->array) : py::none();
}

std::string
describe(const Cloud& cloud)
{
  const py::array& points = cloud.points();
  std::string text = "Cloud(" + std::to_string(points.shape(0)) + " points, " +
                     std::string(py::str(points.dtype()));
  if (cloud.normals())
    text += ", normals";
  if (cloud.features())
    text += ", features of " + std::to_string(cloud.features()->columns) + " values";
  return text + ")";
}

} // namespace

Cloud::Cloud(py::handle points,
             py::handle normals,
             py::handle features,
             py::handle viewpoint,
             bool many_viewpoints,
             const char* name)
    : points_(floatTable(points, name, 3)),
      normals_(rowsBeside(points_, normals, "normals", 3)),
      features_(rowsBeside(points_, features, "features", 0)),
      many_viewpoints_(many_viewpoints)
{
  if (!viewpoint.is_none())
    viewpoint_ = vectorOf(viewpoint, "viewpoint");
}

template <typename Scalar>
CloudInput<Scalar>::CloudInput(const Cloud& cloud)
    : points(rowsOf<Scalar>(cloud.points())),
      normals(cloud.normals()),
      features(cloud.features())
{
  input.points = {points.data, points.size, points.stride, nullptr, 0};
  if (normals) {
    input.normals = normals->data;
    input.normal_stride = normals->stride;
  }
  if (features)
    input.features = {
        features->data, features->size, features->columns, features->stride};
  input.viewpoint_known = cloud.viewpoint().has_value();
  input.viewpoint = cloud.viewpoint().value_or(Eigen::Vector3d::Zero());
  input.many_viewpoints = cloud.manyViewpoints();
}

template struct CloudInput<float>;
template struct CloudInput<double>;

Cloud
cloudOf(py::handle object, const char* name)
{
  if (py::isinstance<Cloud>(object))
    return object.cast<const Cloud&>();
  if (py::isinstance<py::str>(object) || py::hasattr(object, "__fspath__"))
    return readCloud(object, 0);
  py::object points = py::reinterpret_borrow<py::object>(object);
  if (!isArrayLike(object) && py::hasattr(object, "points"))
    points = object.attr("points");
  return Cloud(points, py::none(), py::none(), py::make_tuple(0, 0, 0), false, name);
}

std::string
pathOf(py::handle path)
{
  PyObject* bytes = nullptr;
  if (PyUnicode_FSConverter(path.ptr(), &bytes) == 0)
    throw py::error_already_set();
  return py::reinterpret_steal<py::bytes>(bytes);
}

void
requireReadableFile(const std::string& path)
{
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode))
    errno = EISDIR;
  else if (::access(path.c_str(), R_OK) == 0)
    return;
  PyErr_SetFromErrnoWithFilename(PyExc_OSError, path.c_str());
  throw py::error_already_set();
}

void
bindCloud(py::module_& module)
{
  py::class_<Cloud>(module, "Cloud", R"(What is known of one cloud; nothing is copied.

Args:
    points: N x 3, float32 or float64; an array, or what offers its memory as one. Points
        with a coordinate that is not finite are skipped.
    normals: N x 3, of any length. Where one is missing, NaN or zero, it is computed; of those
        in one voxel the mean is taken, so they have to point to the same side of a surface.
    features: N x D, descriptors: the points are then the keypoints.
    viewpoint: where the sensor is said to have stood, in the frame of the points; None where
        nobody knows. The points have the last word.
    many_viewpoints: whether the points were seen from many places, as those of a map.

float64 of normals and features is rounded to float32. The arrays must not be changed while a
call uses them.

Raises:
    TypeError: the numbers are neither float32 nor float64.
    ValueError: an array has another shape.
)")
      .def(py::init<py::handle, py::handle, py::handle, py::handle, bool>(),
           "points"_a,
           py::kw_only(),
           "normals"_a = py::none(),
           "features"_a = py::none(),
           "viewpoint"_a = py::make_tuple(0, 0, 0),
           "many_viewpoints"_a = false)
      .def_property_readonly(
          "points",
          [](const Cloud& cloud) { return cloud.points().attr("view")(); },
          "A view of the array that was given, N x 3.")
      .def_property_readonly(
          "normals",
          [](const Cloud& cloud) { return arrayOrNone(cloud.normals()); },
          "N x 3 float32, or None.")
      .def_property_readonly(
          "features",
          [](const Cloud& cloud) { return arrayOrNone(cloud.features()); },
          "N x D float32, or None.")
      .def_property_readonly(
          "viewpoint",
          [](const Cloud& cloud) -> py::object {
            if (!cloud.viewpoint())
              return py::none();
            return arrayOf(*cloud.viewpoint());
          },
          "x, y, z in the frame of the points, or None.")
      .def_property_readonly(
          "many_viewpoints", &Cloud::manyViewpoints, "As it was given.")
      .def("__len__", [](const Cloud& cloud) { return cloud.points().shape(0); })
      .def("__repr__", &describe);

  module.def("read_cloud",
             &readCloud,
             "path"_a,
             py::kw_only(),
             "bin_fields"_a = 0,
             R"(Reads a PCD or PLY file, or a raw .bin scan (KITTI, nuScenes, ...).

Args:
    path: a str or a path.
    bin_fields: float32 values in a row of a raw scan; 0 to tell it from the values.

Returns:
    A Cloud with points of float64, seen from where the file says. What the reader had to
    guess is a UserWarning.

Raises:
    OSError: there is no such file, or it can't be read.
    ValueError: it is no cloud, or damaged.
)");
}

} // namespace pcl_flashreg::python
