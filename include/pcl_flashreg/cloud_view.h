// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>

namespace pcl_flashreg {

/** \brief A cloud as evidence for or against a pose; nothing is copied or owned.
 * \tparam Scalar float or double
 */
template <typename Scalar>
struct CloudView {
  /** \brief size x 3, row-major: evenly spread points (one a voxel) of the surface. Those
   * with a coordinate or normal that is not finite are left out. */
  const Scalar* xyz = nullptr;
  /** \brief size x 3, row-major: unit normals; towards the sensor, where there is a
   * viewpoint. */
  const float* normals = nullptr;
  std::size_t size = 0;
  /** \brief Where the sensor stood, in the frame of the cloud: what lies between it and
   * the points is taken to be empty. Nothing if that is not known. */
  std::optional<Eigen::Vector3d> viewpoint;
  /** \brief Whether normals point to the side from which the surface was seen even where there
   * is no viewpoint. */
  bool normals_oriented = false;
};

/** \brief The clouds that correspondences come from. */
template <typename Scalar>
struct CloudPairView {
  CloudView<Scalar> source;
  CloudView<Scalar> target;
  /** \brief Distance of neighbouring points (the voxel size), > 0, in the unit of the
   * clouds: every length of the check is a multiple of it. */
  double spacing = 0;
};

/** \brief How two clouds get on with each other under a pose: shares of the points of
 * both, each in [0, 1], and how well they fit. */
struct CloudAgreement {
  /** \brief Points that lie on the other cloud's surface and face the same way, each
   * weighted by how well it does. */
  double matched = 0;
  /** \brief Points that lie where the other cloud's sensor saw that nothing is, or before a
   * side of its surfaces that was seen. 0 if neither is known. */
  double contradicted = 0;
  /** \brief Distance of the points that match from the other cloud's tangent planes, root
   * mean square, in spacings. No share; 0 if none matches. */
  double residual = 0;
};

} // namespace pcl_flashreg
