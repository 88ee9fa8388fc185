// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "ply_camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>

namespace pcl_flashreg::io {
namespace {

using RowMajorMatrix3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr std::array<const char*, 3> kPlace = {"view_px", "view_py", "view_pz"};
constexpr std::array<const char*, 9> kAxes = {"x_axisx",
                                              "x_axisy",
                                              "x_axisz",
                                              "y_axisx",
                                              "y_axisy",
                                              "y_axisz",
                                              "z_axisx",
                                              "z_axisy",
                                              "z_axisz"};

/** \brief The properties of those names of the last camera; false if one is missing. */
template <std::size_t N>
bool
valuesOf(const Cloud& cameras,
         const std::array<const char*, N>& names,
         std::array<double, N>& values)
{
  for (std::size_t k = 0; k < N; ++k) {
    const Field* field = cameras.find(names[k]);
    if (field == nullptr)
      return false;
    values[k] = loadValue(cameras.point(cameras.size() - 1), *field);
  }
  return true;
}

bool
isRotation(const Eigen::Matrix3d& matrix)
{
  constexpr double tolerance = 1e-2;
  return matrix.allFinite() && matrix.determinant() > 0 &&
         (matrix.transpose() * matrix).isIdentity(tolerance);
}

template <typename T>
void
append(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

std::int32_t
asInt(std::size_t value)
{
  constexpr std::int32_t largest = std::numeric_limits<std::int32_t>::max();
  return value > static_cast<std::size_t>(largest) ? largest
                                                   : static_cast<std::int32_t>(value);
}

} // namespace

void
takeCamera(const Cloud& cameras, Cloud& cloud)
{
  if (cameras.size() == 0)
    return;
  cloud.notes.insert(cloud.notes.end(), cameras.notes.begin(), cameras.notes.end());
  if (cameras.size() > 1)
    cloud.notes.push_back("has " + std::to_string(cameras.size()) +
                          " cameras: the last one is taken for the sensor, as by PCL");
  std::array<double, 3> place{};
  if (valuesOf(cameras, kPlace, place)) {
    if (Eigen::Vector3d(place.data()).allFinite())
      std::copy(place.begin(), place.end(), cloud.viewpoint.begin());
    else
      cloud.notes.push_back(
          "the place of its camera is not finite: the sensor is taken "
          "to have stood at the origin");
  }
  std::array<double, 9> axes{};
  if (valuesOf(cameras, kAxes, axes)) {
    const Eigen::Matrix3d rotation = Eigen::Map<const RowMajorMatrix3d>(axes.data());
    if (isRotation(rotation)) {
      const auto q = Eigen::Quaterniond(rotation).normalized();
      const std::array<double, 4> wxyz = {q.w(), q.x(), q.y(), q.z()};
      std::copy(wxyz.begin(), wxyz.end(), cloud.viewpoint.begin() + 3);
    }
    else
      cloud.notes.push_back(
          "the axes of its camera are no rotation: they are left out");
  }
}

PlyCamera
cameraOf(const Cloud& cloud)
{
  const auto& v = cloud.viewpoint;
  Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
  const Eigen::Vector3d place(v.data());
  if (!place.allFinite() || !q.coeffs().allFinite())
    return {};
  q = q.norm() > 0 ? q.normalized() : Eigen::Quaterniond::Identity();
  const RowMajorMatrix3d rotation = q.toRotationMatrix();
  if (place.isZero(0) && rotation.isIdentity(0))
    return {};
  const Field* x = cloud.find("x");
  const bool is_double = x != nullptr && x->type == ScalarType::Float64;
  PlyCamera camera;
  camera.header = "element camera 1\n";
  const auto add = [&](const std::string& name, double value) {
    camera.header +=
        std::string("property ") + (is_double ? "double " : "float ") + name + '\n';
    if (is_double)
      append(camera.row, value);
    else
      append(camera.row, static_cast<float>(value));
  };
  for (std::size_t k = 0; k < kPlace.size(); ++k)
    add(kPlace[k], place[static_cast<Eigen::Index>(k)]);
  for (std::size_t k = 0; k < kAxes.size(); ++k)
    add(kAxes[k], rotation.data()[k]);
  // No perspective camera: PCL, too, writes zeros.
  for (const char* name : {"focal", "scalex", "scaley", "centerx", "centery"})
    add(name, 0);
  // PCL gives the cloud that it reads this width and height.
  camera.header += "property int viewportx\nproperty int viewporty\n";
  append(camera.row, asInt(cloud.width));
  append(camera.row, asInt(cloud.height));
  for (const char* name : {"k1", "k2"})
    add(name, 0);
  return camera;
}

} // namespace pcl_flashreg::io
