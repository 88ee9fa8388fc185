// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What somebody has of one cloud, as Python gives it.

#include "array.h"

#include <pcl_flashreg/scan.h>

#include <optional>
#include <string>

namespace pcl_flashreg::python {

/** \brief ScanInput, with the arrays that it looks at. */
class Cloud {
public:
  Cloud(py::handle points,
        py::handle normals,
        py::handle features,
        py::handle viewpoint,
        bool many_viewpoints,
        const char* name = "points");

  /** \brief N x 3, float32 or float64. */
  const py::array&
  points() const
  {
    return points_;
  }

  const std::optional<Rows<float>>&
  normals() const
  {
    return normals_;
  }

  const std::optional<Rows<float>>&
  features() const
  {
    return features_;
  }

  const std::optional<Eigen::Vector3d>&
  viewpoint() const
  {
    return viewpoint_;
  }

  bool
  manyViewpoints() const
  {
    return many_viewpoints_;
  }

private:
  py::array points_;
  std::optional<Rows<float>> normals_, features_;
  std::optional<Eigen::Vector3d> viewpoint_;
  bool many_viewpoints_;
};

/** \brief A cloud as the core takes it, in numbers of one type; holds the arrays. */
template <typename Scalar>
struct CloudInput {
  explicit CloudInput(const Cloud& cloud);

  Rows<Scalar> points;
  std::optional<Rows<float>> normals, features;
  ScanInput<Scalar> input;
};

/** \brief The cloud that an argument is: a Cloud, an array, a path, something with points,
 * as Open3D's PointCloud. */
Cloud
cloudOf(py::handle object, const char* name);

/** \brief The bytes of a path; None of its type is a TypeError. */
std::string
pathOf(py::handle path);

/** \throws FileNotFoundError and its kind, if there is no file that can be read */
void
requireReadableFile(const std::string& path);

} // namespace pcl_flashreg::python
