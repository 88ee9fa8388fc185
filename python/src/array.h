// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What comes from Python as numbers, and goes there as such.

#include <pcl_flashreg/result.h>

#include <Eigen/Core>
#include <pybind11/numpy.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace pcl_flashreg::python {

namespace py = pybind11;

/** \brief Rows of numbers in an array that is held as long as this is. */
template <typename Scalar>
struct Rows {
  py::array array;
  const Scalar* data = nullptr;
  std::size_t size = 0;
  std::size_t columns = 0;
  /** \brief Numbers from one row to the next. */
  std::size_t stride = 0;
};

/** \brief Whether rows may lie apart from each other. */
enum class RowLayout { Strided, Packed };

/** \brief Whether an object is an array, or says itself how to be one. */
bool
isArrayLike(py::handle object);

/** \brief The array that an object is or offers: numpy arrays, the buffer protocol,
 * __array__, __array_interface__, DLPack, a method numpy(), lists. Nothing is copied where it
 * offers its memory.
 * \throws TypeError in the name of the argument if it offers none */
py::array
arrayOf(py::handle object, const char* name);

/** \brief arrayOf() of float32 or float64 in two dimensions, as a view of its own: somebody may
 * give the array another shape.
 * \param[in] columns how many there have to be; 0 for any number, but one at least */
py::array
floatTable(py::handle object, const char* name, std::size_t columns);

bool
isDouble(const py::array& array);

/** \brief A floatTable() as numbers of this type. It is copied where its numbers are of the
 * other type or byte order, not aligned, or where those of a row don't follow each other. */
template <typename Scalar>
Rows<Scalar>
rowsOf(py::array table, RowLayout layout = RowLayout::Strided);

/** \brief One float32 a row; those of float64 are rounded. */
Rows<float>
columnOf(py::handle object, const char* name);

/** \brief Three finite numbers. */
Eigen::Vector3d
vectorOf(py::handle object, const char* name);

/** \brief A 4 x 4 matrix that is a rigid transform. */
RigidTransform
transformOf(py::handle object, const char* name);

/** \brief 4 x 4 float64. */
py::array
matrixOf(const RigidTransform& transform);

py::array
arrayOf(const Eigen::Vector3d& vector);

/** \brief Memory of `owner`, which lives as long as the array does; not to be written to. */
template <typename T>
py::array
viewOf(const T* data,
       std::vector<py::ssize_t> shape,
       py::handle owner,
       std::vector<py::ssize_t> strides = {})
{
  // Without an address numpy would make an array of its own.
  static const T NOTHING{};
  py::array view(py::dtype::of<T>(),
                 std::move(shape),
                 std::move(strides),
                 data != nullptr ? data : &NOTHING,
                 owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

} // namespace pcl_flashreg::python
