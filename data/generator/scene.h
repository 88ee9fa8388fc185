// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace pcl_flashreg::generator {

/** \brief Radians. */
constexpr double degree = 0.017453292519943295;

/** \brief What a ray met first. */
struct Hit {
  /** \brief Along the ray, in lengths of its direction. */
  double distance;
  /** \brief Unit length, world frame, against the ray. */
  Eigen::Vector3d normal;
  /** \brief How likely a sensor sees this surface at all: below 1 for glass and the
   * like. */
  double return_probability;
};

enum class ShapeKind { Box, Cylinder, Ellipsoid };

/** \brief A unit shape (half edge or radius 1, cylinder axis z) that is scaled, turned
 * and moved to its place. */
struct Shape {
  ShapeKind kind;
  /** \brief World from local, a rotation and a translation. */
  Eigen::Isometry3d pose;
  /** \brief Half extents along the local axes, metres. */
  Eigen::Vector3d half;
  double return_probability;
};

/** \brief Shapes in world coordinates (metres, z up) and the first hit of a ray on
 * them. */
class Scene {
public:
  void
  add(const Shape& shape);

  /** \brief Sorts the shapes into a bounding volume hierarchy; call once after the last
   * add() and before the first cast(). */
  void
  build();

  /** \brief First hit nearer than max_distance.
   * \param[in] direction need not have unit length; distances are in lengths of it */
  std::optional<Hit>
  cast(const Eigen::Vector3d& origin,
       const Eigen::Vector3d& direction,
       double max_distance) const;

  std::size_t
  size() const
  {
    return shapes_.size();
  }

private:
  struct Node {
    Eigen::AlignedBox3d box;
    /** \brief Leaf: shapes [first, first + count). Inner node: count is 0, children are
     * the next node and node first. */
    int first;
    int count;
  };

  int
  buildNode(int first, int last);

  std::vector<Shape> shapes_;
  std::vector<Node> nodes_;
};

/** \brief Adds shapes to a scene in the coordinates of an object: furniture and houses
 * are written once, around their own origin, and then placed. */
class Placer {
public:
  Placer(Scene& scene, const Eigen::Isometry3d& pose) : scene_(&scene), pose_(pose) {}

  /** \brief A frame inside this one. \param[in] yaw about z, radians */
  Placer
  at(double x, double y, double z, double yaw = 0.0) const;

  /** \brief This frame turned. \param[in] angle radians, about an axis of this frame */
  Placer
  turned(double angle, const Eigen::Vector3d& axis) const;

  /** \brief This frame, adding shapes that return only this share of the rays. */
  Placer
  seenWith(double return_probability) const;

  /** \param[in] size full edge lengths */
  void
  box(const Eigen::Vector3d& center, const Eigen::Vector3d& size) const;

  /** \brief Axis along z. */
  void
  cylinder(const Eigen::Vector3d& center, double radius, double height) const;

  void
  ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii) const;

private:
  void
  add(ShapeKind kind, const Eigen::Vector3d& center, const Eigen::Vector3d& half) const;

  Scene* scene_;
  Eigen::Isometry3d pose_;
  double return_probability_ = 1.0;
};

} // namespace pcl_flashreg::generator
