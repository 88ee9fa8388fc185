// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace pcl_flashreg {

/** \brief Where a ray from the middle of a cube meets its faces. */
struct CubePlace {
  int face = 0;
  /** \brief On the face, in [0, 1]. */
  float row = 0, column = 0;
};

/** \return the first face's corner for a ray of no length */
inline CubePlace
cubePlaceOf(const Eigen::Vector3f& ray)
{
  Eigen::Index axis = 0;
  const float largest = ray.cwiseAbs().maxCoeff(&axis);
  if (!(largest > 0))
    return {};
  const auto along = [&](Eigen::Index a) { return 0.5f * (ray[a] / largest + 1); };
  return {2 * static_cast<int>(axis) + (ray[axis] > 0 ? 0 : 1),
          along(axis == 0 ? 1 : 0),
          along(axis == 2 ? 1 : 2)};
}

/** \brief The pixel of a place in an image of faces with so many pixels an edge. */
inline int
cubePixelOf(const CubePlace& place, int edge)
{
  const auto number = [&](float share) {
    const float along = share * static_cast<float>(edge);
    // What overflows is no number here: it is put into the first column.
    return std::min(edge - 1, along > 0 ? static_cast<int>(along) : 0);
  };
  return (place.face * edge + number(place.row)) * edge + number(place.column);
}

/** \brief Of each pixel of such an image the least value in it and the pixels around it on its
 * face. */
inline void
leastAround(const std::vector<float>& image, int edge, std::vector<float>& least)
{
  constexpr int FACES = 6;
  least.resize(image.size());
  for (int face = 0; face < FACES; ++face)
    for (int row = 0; row < edge; ++row)
      for (int column = 0; column < edge; ++column) {
        const auto at = [&](int r, int c) {
          return static_cast<std::size_t>((face * edge + r) * edge + c);
        };
        float value = image[at(row, column)];
        for (int r = std::max(0, row - 1); r <= std::min(edge - 1, row + 1); ++r)
          for (int c = std::max(0, column - 1); c <= std::min(edge - 1, column + 1);
               ++c)
            value = std::min(value, image[at(r, c)]);
        least[at(row, column)] = value;
      }
}

} // namespace pcl_flashreg
