// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/free_space.h"
#include "judgement/cpu/nearest_point_grid.h"
#include "math/pose.h"

#include <pcl_flashreg/cloud_view.h>

#include <vector>

namespace pcl_flashreg {

/** \brief A cloud made ready for the check: finite points, centred, in single precision,
 * with what answers questions about them. */
struct Surface {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
  NearestPointGrid nearest;
  /** \brief The same of wider cells, three spacings; empty unless it has sides. */
  NearestPointGrid around;
  FreeSpace free_space;
  /** \brief Whether the viewpoint is not known, but normals point to the side from which the
   * surface was seen. */
  bool has_sides = false;

  /** \brief Whether the signs of normals tell anything. */
  bool
  oriented() const
  {
    return has_sides || free_space.known();
  }

  /** \param[in] centre what is subtracted from every coordinate */
  template <typename Scalar>
  void
  build(const CloudView<Scalar>& cloud, const Vec3& centre, float spacing);

  /** \brief Of memory. */
  std::size_t
  bytes() const
  {
    return (points.capacity() + normals.capacity()) * sizeof(Eigen::Vector3f) +
           nearest.bytes() + around.bytes() + free_space.bytes();
  }
};

extern template void
Surface::build(const CloudView<float>&, const Vec3&, float);
extern template void
Surface::build(const CloudView<double>&, const Vec3&, float);

} // namespace pcl_flashreg
