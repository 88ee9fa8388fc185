// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/free_space.h"
#include "judgement/cpu/nearest_point_grid.h"
#include "math/pose.h"
#include "support/array.h"

#include <pcl_flashreg/cloud_view.h>

#include <cstdint>
#include <optional>

namespace pcl_flashreg {

/** \brief A cloud made ready for the check: finite points, centred, in single precision,
 * with what answers questions about them. */
struct Surface {
  Array<Eigen::Vector3f> points;
  Array<Eigen::Vector3f> normals;
  NearestPointGrid nearest;
  /** \brief The same of wider cells, three spacings; empty unless it has sides. */
  NearestPointGrid around;
  FreeSpace free_space;
  /** \brief Of each point the zOrderKey() of its cell, ascending, where points are in that
   * order; with the side of these cells and the corner that they are counted from. */
  Array<std::uint64_t> keys;
  float key_side = 1;
  Eigen::Vector3f key_corner = Eigen::Vector3f::Zero();
  /** \brief Whether the viewpoint is not known, but normals point to the side from which the
   * surface was seen. */
  bool has_sides = false;

  /** \brief Whether the signs of normals tell anything. */
  bool
  oriented() const
  {
    return has_sides || free_space.known();
  }

  /** \param[in] centre what is subtracted from every coordinate
   * \param[in] in_order whether points are to be sorted, for a Vicinity: of such a cloud sides
   * tell nothing, as it was put together from several views */
  template <typename Scalar>
  void
  build(const CloudView<Scalar>& cloud,
        const Vec3& centre,
        float spacing,
        bool in_order = false);

  /** \brief What lies between the points and where they were seen from is empty, unless that
   * is not known.
   * \param[in] viewpoint in the frame of the cloud
   * \param[in] centre see build() */
  void
  lookFrom(const std::optional<Eigen::Vector3d>& viewpoint,
           const Vec3& centre,
           float spacing);

  /** \brief Of memory. */
  std::size_t
  bytes() const
  {
    return points.bytes() + normals.bytes() + nearest.bytes() + around.bytes() +
           free_space.bytes() + keys.bytes();
  }

private:
  /** \brief Sorts points that were filled in. */
  void
  putInOrder(float spacing);
};

/** \brief The middle of the box around the points that are finite; 0 if there are none. */
template <typename Scalar>
Vec3
middleOf(const CloudView<Scalar>& cloud);

extern template Vec3
middleOf(const CloudView<float>&);
extern template Vec3
middleOf(const CloudView<double>&);
extern template void
Surface::build(const CloudView<float>&, const Vec3&, float, bool);
extern template void
Surface::build(const CloudView<double>&, const Vec3&, float, bool);

} // namespace pcl_flashreg
