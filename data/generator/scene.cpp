// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl_flashreg::generator {
namespace {

using Eigen::Vector3d;

/** \brief Where a ray crosses a unit shape: the nearest distance > 0 and the outward
 * normal there, both in the shape's own scaled coordinates. */
struct LocalHit {
  double distance;
  Vector3d normal;
};

std::optional<LocalHit>
hitBox(const Vector3d& origin, const Vector3d& direction)
{
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0.0) {
      if (std::abs(origin[i]) > 1.0)
        return std::nullopt;
      continue;
    }
    const double a = (-1.0 - origin[i]) / direction[i];
    const double b = (1.0 - origin[i]) / direction[i];
    if (std::min(a, b) > enter) {
      enter = std::min(a, b);
      axis = i;
    }
    leave = std::min(leave, std::max(a, b));
  }
  if (axis < 0 || enter > leave)
    return std::nullopt;
  Vector3d normal = Vector3d::Zero();
  normal[axis] = direction[axis] > 0.0 ? -1.0 : 1.0;
  return LocalHit{enter, normal};
}

/** \brief Smaller root of |o + t d|^2 = 1 over the first `Dimension` axes. */
template <int Dimension>
std::optional<double>
enterRound(const Vector3d& origin, const Vector3d& direction)
{
  const auto o = origin.head<Dimension>();
  const auto d = direction.head<Dimension>();
  const double a = d.squaredNorm();
  const double b = o.dot(d);
  const double discriminant = b * b - a * (o.squaredNorm() - 1.0);
  if (a == 0.0 || discriminant < 0.0)
    return std::nullopt;
  return (-b - std::sqrt(discriminant)) / a;
}

std::optional<LocalHit>
hitEllipsoid(const Vector3d& origin, const Vector3d& direction)
{
  const auto t = enterRound<3>(origin, direction);
  if (!t || *t <= 0.0)
    return std::nullopt;
  return LocalHit{*t, origin + *t * direction};
}

std::optional<LocalHit>
hitCylinder(const Vector3d& origin, const Vector3d& direction)
{
  const auto side = enterRound<2>(origin, direction);
  if (side && *side > 0.0) {
    const Vector3d p = origin + *side * direction;
    if (std::abs(p.z()) <= 1.0)
      return LocalHit{*side, Vector3d(p.x(), p.y(), 0.0)};
  }
  if (direction.z() == 0.0)
    return std::nullopt;
  const double cap = direction.z() > 0.0 ? -1.0 : 1.0;
  const double t = (cap - origin.z()) / direction.z();
  const Vector3d p = origin + t * direction;
  if (t <= 0.0 || p.head<2>().squaredNorm() > 1.0)
    return std::nullopt;
  return LocalHit{t, Vector3d(0.0, 0.0, cap)};
}

std::optional<Hit>
hitShape(const Shape& shape, const Vector3d& origin, const Vector3d& direction)
{
  const Vector3d o =
      (shape.pose.linear().transpose() * (origin - shape.pose.translation()))
          .cwiseQuotient(shape.half);
  const Vector3d d =
      (shape.pose.linear().transpose() * direction).cwiseQuotient(shape.half);
  const auto hit = shape.kind == ShapeKind::Box        ? hitBox(o, d)
                   : shape.kind == ShapeKind::Cylinder ? hitCylinder(o, d)
                                                       : hitEllipsoid(o, d);
  if (!hit)
    return std::nullopt;
  const Vector3d normal =
      shape.pose.linear() * hit->normal.cwiseQuotient(shape.half).normalized();
  return Hit{hit->distance, normal, shape.return_probability};
}

Eigen::AlignedBox3d
bounds(const Shape& shape)
{
  const Vector3d reach = shape.pose.linear().cwiseAbs() * shape.half;
  return {shape.pose.translation() - reach, shape.pose.translation() + reach};
}

bool
crosses(const Eigen::AlignedBox3d& box,
        const Vector3d& origin,
        const Vector3d& inverse_direction,
        double max_distance)
{
  double enter = 0.0;
  double leave = max_distance;
  for (int i = 0; i < 3; ++i) {
    const double a = (box.min()[i] - origin[i]) * inverse_direction[i];
    const double b = (box.max()[i] - origin[i]) * inverse_direction[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

} // namespace

void
Scene::add(const Shape& shape)
{
  shapes_.push_back(shape);
}

void
Scene::build()
{
  nodes_.clear();
  nodes_.reserve(2 * shapes_.size());
  if (!shapes_.empty())
    buildNode(0, static_cast<int>(shapes_.size()));
}

int
Scene::buildNode(int first, int last)
{
  constexpr int leaf_size = 4;
  Eigen::AlignedBox3d box;
  Eigen::AlignedBox3d centers;
  for (int i = first; i < last; ++i) {
    box.extend(bounds(shapes_[i]));
    centers.extend(shapes_[i].pose.translation());
  }
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({box, first, last - first});
  if (last - first <= leaf_size)
    return node;

  int axis = 0;
  centers.sizes().maxCoeff(&axis);
  const int middle = (first + last) / 2;
  std::nth_element(shapes_.begin() + first,
                   shapes_.begin() + middle,
                   shapes_.begin() + last,
                   [axis](const Shape& a, const Shape& b) {
                     return a.pose.translation()[axis] < b.pose.translation()[axis];
                   });
  buildNode(first, middle);
  const int second = buildNode(middle, last);
  nodes_[node].first = second;
  nodes_[node].count = 0;
  return node;
}

std::optional<Hit>
Scene::cast(const Vector3d& origin,
            const Vector3d& direction,
            double max_distance) const
{
  std::optional<Hit> nearest;
  if (nodes_.empty())
    return nearest;
  const Vector3d inverse_direction = direction.cwiseInverse();
  // Halving the shapes at each level keeps the tree, and so this stack, shallow.
  int stack[64];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const int index = stack[--depth];
    const Node& node = nodes_[index];
    if (!crosses(node.box, origin, inverse_direction, max_distance))
      continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = index + 1;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      const auto hit = hitShape(shapes_[i], origin, direction);
      if (hit && hit->distance < max_distance) {
        max_distance = hit->distance;
        nearest = hit;
      }
    }
  }
  return nearest;
}

Placer
Placer::at(double x, double y, double z, double yaw) const
{
  Placer placer = *this;
  placer.pose_.translate(Vector3d(x, y, z))
      .rotate(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
  return placer;
}

Placer
Placer::turned(double angle, const Vector3d& axis) const
{
  Placer placer = *this;
  placer.pose_.rotate(Eigen::AngleAxisd(angle, axis));
  return placer;
}

Placer
Placer::seenWith(double return_probability) const
{
  Placer placer = *this;
  placer.return_probability_ = return_probability;
  return placer;
}

void
Placer::box(const Vector3d& center, const Vector3d& size) const
{
  add(ShapeKind::Box, center, 0.5 * size);
}

void
Placer::cylinder(const Vector3d& center, double radius, double height) const
{
  add(ShapeKind::Cylinder, center, {radius, radius, 0.5 * height});
}

void
Placer::ellipsoid(const Vector3d& center, const Vector3d& radii) const
{
  add(ShapeKind::Ellipsoid, center, radii);
}

void
Placer::add(ShapeKind kind, const Vector3d& center, const Vector3d& half) const
{
  Eigen::Isometry3d pose = pose_;
  pose.translate(center);
  scene_->add({kind, pose, half, return_probability_});
}

} // namespace pcl_flashreg::generator
