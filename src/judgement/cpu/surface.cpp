// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/surface.h"

namespace pcl_flashreg {

template <typename Scalar>
void
Surface::build(const CloudView<Scalar>& cloud, const Vec3& centre, float spacing)
{
  points.clear();
  normals.clear();
  const Eigen::Vector3d origin(centre.x, centre.y, centre.z);
  for (std::size_t i = 0; i < cloud.size; ++i) {
    using Row = Eigen::Matrix<Scalar, 3, 1>;
    const Eigen::Vector3d point =
        Eigen::Map<const Row>(cloud.xyz + 3 * i).template cast<double>() - origin;
    const Eigen::Map<const Eigen::Vector3f> normal(cloud.normals + 3 * i);
    if (!point.allFinite() || !normal.allFinite())
      continue;
    points.push_back(point.template cast<float>());
    normals.push_back(normal);
  }
  nearest.build(points, spacing);
  if (cloud.viewpoint && cloud.viewpoint->allFinite())
    free_space.build(
        points, (*cloud.viewpoint - origin).template cast<float>(), spacing);
  else
    free_space.clear();
  has_sides = cloud.normals_oriented && !free_space.known();
  constexpr float AROUND = 3;
  const std::vector<Eigen::Vector3f> none;
  around.build(has_sides ? points : none, AROUND * spacing);
}

template void
Surface::build(const CloudView<float>&, const Vec3&, float);
template void
Surface::build(const CloudView<double>&, const Vec3&, float);

} // namespace pcl_flashreg
