// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "map_view.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pcl_flashreg::map {
namespace {

constexpr double DEGREE = 3.14159265358979323846 / 180;
/** \brief Share of the points on either side that need not be in the picture. */
constexpr double OUTSIDE = 0.003;

/** \brief The x axes of scans that are held level are all perpendicular to it; null if they
 * do not say. */
std::optional<Eigen::Vector3d>
uprightOf(const std::vector<Eigen::Matrix3d>& axes)
{
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Matrix3d& R : axes)
    spread += R.col(0) * R.col(0).transpose() / static_cast<double>(axes.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  constexpr double LEVEL = 0.05, SPREAD = 0.1;
  if (solver.eigenvalues()[0] > LEVEL || solver.eigenvalues()[1] < SPREAD)
    return std::nullopt;
  return solver.eigenvectors().col(0);
}

Eigen::Vector3d
thinnestOf(const Eigen::Matrix3Xf& points)
{
  const Eigen::Matrix3Xd centred =
      (points.colwise() - points.rowwise().mean()).cast<double>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      Eigen::Matrix3d(centred * centred.transpose()));
  const Eigen::Vector3d up = solver.eigenvectors().col(0);
  return std::abs(up.z()) > std::cos(30 * DEGREE) ? Eigen::Vector3d::UnitZ() : up;
}

/** \brief Nearer to the normals of floors, and further from those of walls. */
Eigen::Vector3d
turnedToNormals(Eigen::Vector3d up, const Eigen::Matrix3Xf& normals)
{
  constexpr double ENOUGH = 0.1;
  for (const double angle : {20.0, 10.0, 5.0}) {
    const double near = std::sin(angle * DEGREE);
    Eigen::Matrix3d levels = Eigen::Matrix3d::Zero();
    Eigen::Index used = 0;
    for (Eigen::Index i = 0; i < normals.cols(); ++i) {
      const Eigen::Vector3d n = normals.col(i).cast<double>();
      const double along = std::abs(up.dot(n));
      const bool of_wall = along<near, of_floor = along * along> 1 - near * near;
      if (of_wall || of_floor) {
        levels += (of_floor ? 1 : -1) * (n * n.transpose());
        ++used;
      }
    }
    if (static_cast<double>(used) < ENOUGH * static_cast<double>(normals.cols()) ||
        used == 0)
      return up;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(levels);
    const Eigen::Vector3d turned = solver.eigenvectors().col(2);
    // Normals that do not agree on anything turn it further than they were looked for.
    if (std::abs(turned.dot(up)) < std::cos(angle * DEGREE))
      return up;
    up = turned.dot(up) < 0 ? Eigen::Vector3d(-turned) : turned;
  }
  return up;
}

/** \brief The right way up. */
Eigen::Vector3d
withSign(const Eigen::Vector3d& up, const std::vector<Eigen::Matrix3d>& axes)
{
  double along_z = 0, along_y = 0;
  for (const Eigen::Matrix3d& R : axes) {
    along_z += R.col(2).dot(up);
    along_y += R.col(1).dot(up);
  }
  const double sign = std::abs(along_z) >= std::abs(along_y) ? along_z : -along_y;
  return sign < 0 ? Eigen::Vector3d(-up) : up;
}

/** \brief The box that holds nearly all of the points, turned by an angle. */
Eigen::AlignedBox2d
boxOf(const Eigen::Matrix2Xf& points, double angle)
{
  const Eigen::Matrix2f R = Eigen::Rotation2Df(static_cast<float>(angle)).matrix();
  Eigen::AlignedBox2d box;
  box.setEmpty();
  if (points.cols() == 0)
    return box;
  Eigen::Vector2d low, high;
  for (int axis = 0; axis < 2; ++axis) {
    Eigen::VectorXf values = (R.row(axis) * points).transpose();
    const auto at = [&](double share) {
      const auto k = static_cast<Eigen::Index>(share * double(values.size() - 1));
      std::nth_element(values.data(), values.data() + k, values.data() + values.size());
      return values[k];
    };
    low[axis] = at(OUTSIDE);
    high[axis] = at(1 - OUTSIDE);
  }
  return {low, high};
}

double
angleOfSmallestBox(const Eigen::Matrix2Xf& points)
{
  double best = 0, smallest = std::numeric_limits<double>::infinity();
  for (int degree = 0; degree < 90; ++degree) {
    const Eigen::Vector2d sizes = boxOf(points, degree * DEGREE).sizes();
    const double area = sizes.prod();
    if (area < smallest) {
      smallest = area;
      best = degree * DEGREE + (sizes.x() < sizes.y() ? 90 * DEGREE : 0);
    }
  }
  return best;
}

/** \brief Every so manyth column, of at least one. */
template <typename Matrix>
Matrix
thinned(const Matrix& columns, Eigen::Index most)
{
  const Eigen::Index step =
      std::max<Eigen::Index>(1, (columns.cols() + most - 1) / most);
  Matrix kept(columns.rows(), (columns.cols() + step - 1) / step);
  for (Eigen::Index i = 0; i < kept.cols(); ++i)
    kept.col(i) = columns.col(i * step);
  return kept;
}

template <typename Matrix>
Matrix
joined(const std::vector<Matrix>& parts)
{
  Eigen::Index columns = 0;
  for (const Matrix& part : parts)
    columns += part.cols();
  Matrix all(parts.front().rows(), columns);
  columns = 0;
  for (const Matrix& part : parts) {
    all.middleCols(columns, part.cols()) = part;
    columns += part.cols();
  }
  return all;
}

/** \brief Scans in the frame of their group, relative to the middle of the first one, so
 * that single precision suffices. */
struct Solid {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Matrix3d> axes;
  std::vector<Eigen::Matrix3Xf> points, normals;
  std::vector<Eigen::Vector3d> viewpoints, middles;
};

void
add(Solid& solid, const Scan& scan, const RigidTransform& pose, std::size_t most)
{
  const auto size = static_cast<Eigen::Index>(scan.size());
  const Eigen::Map<const Eigen::Matrix3Xf> xyz(scan.points(), 3, size);
  const Eigen::Vector3d middle =
      size == 0 ? Eigen::Vector3d::Zero()
                : Eigen::Vector3d(xyz.cast<double>().rowwise().mean());
  const auto moved = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return pose.rotation * p + pose.translation;
  };
  if (solid.points.empty())
    solid.origin = moved(middle + scan.shift());
  const Eigen::Matrix3f R = pose.rotation.cast<float>();
  const Eigen::Vector3f t = (moved(scan.shift()) - solid.origin).cast<float>();
  const auto kept = static_cast<Eigen::Index>(most);
  solid.axes.push_back(pose.rotation);
  solid.points.push_back((R * thinned<Eigen::Matrix3Xf>(xyz, kept)).colwise() + t);
  Eigen::Matrix3Xf normals = thinned<Eigen::Matrix3Xf>(
      Eigen::Map<const Eigen::Matrix3Xf>(scan.normals(), 3, size), 20000);
  for (auto n : normals.colwise())
    if (!n.allFinite())
      n.setZero();
  solid.normals.push_back(R * normals);
  solid.middles.push_back(moved(middle + scan.shift()) - solid.origin);
  solid.viewpoints.push_back(scan.viewpoint() ? moved(*scan.viewpoint()) - solid.origin
                                              : solid.middles.back());
}

} // namespace

Eigen::Vector3d
upwards(const std::vector<Eigen::Matrix3d>& axes,
        const Eigen::Matrix3Xf& points,
        const Eigen::Matrix3Xf& normals)
{
  const std::optional<Eigen::Vector3d> upright = uprightOf(axes);
  return withSign(turnedToNormals(upright ? *upright : thinnestOf(points), normals),
                  axes);
}

FlatGroup
seenFromAbove(const std::vector<std::size_t>& members,
              const MultiviewResult& result,
              const MultiviewRegistration::ScanSource& scans,
              std::size_t most)
{
  const std::size_t of_each = std::max<std::size_t>(1, most / members.size());
  FlatGroup group;
  Solid solid;
  std::size_t all = 0;
  for (const std::size_t i : members) {
    const Scan scan = scans(i);
    add(solid, scan, result.scans[i].T_group_scan, of_each);
    group.spacing = std::max(group.spacing, scan.spacing());
    all += scan.size();
  }
  const Eigen::Matrix3Xf points = thinned(joined(solid.points), 200000);
  const Eigen::Vector3d up = upwards(solid.axes, points, joined(solid.normals));
  Eigen::Matrix<double, 2, 3> view;
  view.row(0) = up.unitOrthogonal();
  view.row(1) = up.cross(Eigen::Vector3d(view.row(0)));
  const double angle = angleOfSmallestBox(view.cast<float>() * thinned(points, 20000));
  view = (Eigen::Rotation2Dd(angle).matrix() * view).eval();
  group.view = view;
  group.origin = solid.origin;

  group.box = boxOf(view.cast<float>() * points, 0);
  const Eigen::Vector2d around = 0.25 * group.box.sizes();
  const Eigen::AlignedBox2d near(group.box.min() - around, group.box.max() + around);
  const bool from_within =
      std::all_of(solid.viewpoints.begin(), solid.viewpoints.end(), [&](const auto& p) {
        return near.contains(Eigen::Vector2d(view * p));
      });
  const std::vector<Eigen::Vector3d>& places =
      from_within ? solid.viewpoints : solid.middles;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < members.size(); ++k) {
    FlatScan flat;
    flat.scan = members[k];
    flat.points = view.cast<float>() * solid.points[k];
    flat.place = view * places[k];
    group.box.extend(flat.place);
    kept += static_cast<std::size_t>(flat.points.cols());
    group.scans.push_back(std::move(flat));
  }
  if (kept > 0)
    group.weight = static_cast<double>(all) / static_cast<double>(kept);
  return group;
}

} // namespace pcl_flashreg::map
