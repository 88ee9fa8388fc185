// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "array.h"

#include <io/error.h>
#include <io/transform_io.h>

#include <string>

namespace pcl_flashreg::python {
namespace {

[[noreturn]] void
throwTypeError(const std::string& what)
{
  throw py::type_error(what);
}

std::string
typeNameOf(py::handle object)
{
  return py::str(py::type::handle_of(object).attr("__name__"));
}

std::string
shapeOf(const py::array& array)
{
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    text += (i == 0 ? "" : " x ") + std::to_string(array.shape(i));
  return array.ndim() == 1 ? "of length " + text : text.empty() ? "one number" : text;
}

void
requireFloats(const py::array& array, const char* name)
{
  const char kind = array.dtype().kind();
  if (kind == 'f' && (array.itemsize() == 4 || array.itemsize() == 8))
    return;
  const std::string type = py::str(array.dtype());
  const bool numbers = kind == 'f' || kind == 'i' || kind == 'u';
  throwTypeError(std::string(name) + ": is of " + type +
                 ", but has to be of float32 or " + "float64" +
                 (numbers ? "; .astype(float) converts it" : ""));
}

/** \brief What helps where points are not N x 3. */
std::string
adviceOn(const py::array& array, std::size_t columns)
{
  const auto wanted = static_cast<py::ssize_t>(columns);
  if (array.ndim() != 2)
    return "";
  const std::string slice = "[:, :" + std::to_string(columns) + "]";
  if (array.shape(1) > wanted)
    return "; take " + slice + " of it, which copies nothing";
  if (array.shape(0) == wanted)
    return "; take its transpose, .T";
  return "";
}

/** \brief Whether the numbers can be read where they are. */
template <typename Scalar>
bool
isReadable(const py::array& table, RowLayout layout)
{
  constexpr py::ssize_t SIZE = sizeof(Scalar);
  const bool aligned = (table.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
  if (!py::isinstance<py::array_t<Scalar>>(table) || !aligned)
    return false;
  const py::ssize_t row = table.shape(1) * SIZE;
  const bool whole_rows = table.shape(1) == 1 || table.strides(1) == SIZE;
  const bool rows_follow =
      layout == RowLayout::Packed
          ? table.strides(0) == row
          : table.strides(0) >= row && table.strides(0) % SIZE == 0;
  return whole_rows && (table.shape(0) <= 1 || rows_follow);
}

} // namespace

bool
isArrayLike(py::handle object)
{
  return PyObject_CheckBuffer(object.ptr()) != 0 ||
         py::hasattr(object, "__array_interface__") ||
         py::hasattr(object, "__array__") || py::isinstance<py::list>(object) ||
         py::isinstance<py::tuple>(object);
}

py::array
arrayOf(py::handle object, const char* name)
{
  const py::module_ numpy = py::module_::import("numpy");
  if (py::isinstance(object, numpy.attr("ma").attr("MaskedArray")))
    throwTypeError(std::string(name) + ": is a masked array, whose mask would be lost; "
                                       "leave out what it masks, or fill it with NaN");
  if (py::isinstance<py::array>(object) || isArrayLike(object))
    return numpy.attr("asarray")(object);
  if (py::hasattr(object, "__dlpack__"))
    return numpy.attr("from_dlpack")(object);
  // Open3D's tensors.
  if (py::hasattr(object, "numpy"))
    return numpy.attr("asarray")(object.attr("numpy")());
  throwTypeError(std::string(name) + ": is a " + typeNameOf(object) +
                 ", but has to be an array");
}

py::array
floatTable(py::handle object, const char* name, std::size_t columns)
{
  py::array array = arrayOf(object, name);
  requireFloats(array, name);
  const bool fits =
      array.ndim() == 2 &&
      (columns == 0 ? array.shape(1) > 0
                    : array.shape(1) == static_cast<py::ssize_t>(columns));
  if (!fits)
    throw py::value_error(
        std::string(name) + ": is " + shapeOf(array) + ", but has to be N x " +
        (columns == 0 ? "D" : std::to_string(columns)) + adviceOn(array, columns));
  return array.attr("view")();
}

bool
isDouble(const py::array& array)
{
  return array.itemsize() == sizeof(double);
}

template <typename Scalar>
Rows<Scalar>
rowsOf(py::array table, RowLayout layout)
{
  if (!isReadable<Scalar>(table, layout))
    table = table.attr("astype")(
        py::dtype::of<Scalar>(), py::arg("order") = "C", py::arg("subok") = false);
  Rows<Scalar> rows;
  rows.data = static_cast<const Scalar*>(table.data());
  rows.size = static_cast<std::size_t>(table.shape(0));
  rows.columns = static_cast<std::size_t>(table.shape(1));
  rows.stride = rows.size > 1
                    ? static_cast<std::size_t>(table.strides(0)) / sizeof(Scalar)
                    : rows.columns;
  rows.array = std::move(table);
  return rows;
}

template Rows<float>
rowsOf(py::array table, RowLayout layout);
template Rows<double>
rowsOf(py::array table, RowLayout layout);

Rows<float>
columnOf(py::handle object, const char* name)
{
  const py::array array = arrayOf(object, name);
  requireFloats(array, name);
  if (array.ndim() != 1)
    throw py::value_error(std::string(name) + ": is " + shapeOf(array) +
                          ", but has to be a number a row");
  const py::array table = array.attr("reshape")(py::make_tuple(-1, 1));
  return rowsOf<float>(table, RowLayout::Packed);
}

Eigen::Vector3d
vectorOf(py::handle object, const char* name)
{
  const auto array =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(
          arrayOf(object, name));
  if (!array) {
    PyErr_Clear();
    throwTypeError(std::string(name) + ": has to be three numbers");
  }
  if (array.ndim() != 1 || array.shape(0) != 3)
    throw py::value_error(std::string(name) + ": is " + shapeOf(array) +
                          ", but has to be three numbers");
  const Eigen::Vector3d vector(array.data());
  if (!vector.allFinite())
    throw py::value_error(std::string(name) + ": has a number that is not finite");
  return vector;
}

RigidTransform
transformOf(py::handle object, const char* name)
{
  const py::array array = floatTable(object, name, 4);
  if (array.shape(0) != 4)
    throw py::value_error(std::string(name) + ": is " + shapeOf(array) +
                          ", but has to be 4 x 4");
  const Rows<double> rows = rowsOf<double>(array, RowLayout::Packed);
  using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  try {
    return io::toRigidTransform(Eigen::Map<const Matrix>(rows.data));
  }
  catch (const io::InputError& error) {
    throw py::value_error(std::string(name) + ": " + error.what());
  }
}

py::array
matrixOf(const RigidTransform& transform)
{
  py::array_t<double> array({4, 4});
  using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  Eigen::Map<Matrix>(array.mutable_data()) = transform.toMatrix<double>();
  return std::move(array);
}

py::array
arrayOf(const Eigen::Vector3d& vector)
{
  return py::array_t<double>(3, vector.data());
}

} // namespace pcl_flashreg::python
