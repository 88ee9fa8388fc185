// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "picture.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace pcl_flashreg::drawing {

/** \brief How small text looks. */
struct LabelStyle {
  /** \brief Of the font, in pixels. */
  double size;
  Color ink, paper;
};

/** \brief What a place is called, in pixels. */
struct Label {
  std::string text;
  Eigen::Vector2d at;
};

/** \brief A place, with a rim. */
void
drawDot(Picture& picture, const Eigen::Vector2d& at, Color color, Color rim);

/** \brief Writes labels beside their places, but for those that would cover what is
 * written already, wherever they went.
 * \param[in] left, right columns between which they stay
 * \param[in] covered what they must not cover either */
void
writeLabels(Picture& picture,
            const std::vector<Label>& labels,
            double left,
            double right,
            const LabelStyle& style,
            std::vector<Eigen::AlignedBox2d> covered = {});

/** \brief A bar of a round length, and how long it is.
 * \param[in] from its left end
 * \param[in] most pixels */
void
drawScaleBar(Picture& picture,
             double pixels_per_unit,
             const Eigen::Vector2d& from,
             double most,
             const LabelStyle& style);

} // namespace pcl_flashreg::drawing
