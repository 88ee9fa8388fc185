// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../drawing/raster.h"
#include "map_view.h"

#include <vector>

namespace pcl_flashreg::map {

/** \brief From lengths to pixels of a canvas. */
struct Scale {
  double pixels_per_unit = 1;
  /** \brief What the middle of the canvas shows. */
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  int width = 1, height = 1;

  Eigen::Vector2d
  pixelOf(const Eigen::Vector2d& point) const
  {
    return {0.5 * width + pixels_per_unit * (point.x() - middle.x()),
            0.5 * height - pixels_per_unit * (point.y() - middle.y())};
  }
};

/** \brief Points as a density: a pixel has the color of the scan with the most points
 * there, the stronger the more points of all scans there are. The densest few in a hundred of
 * the pixels that have any get the full color.
 * \param[in] colors of all scans, by their numbers
 * \param[in] paper the color where there is no point */
drawing::Canvas
densityOf(const FlatGroup& group,
          const Scale& scale,
          const std::vector<drawing::Color>& colors,
          drawing::Color paper);

} // namespace pcl_flashreg::map
