// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "labels.h"

#include <pcl_flashreg/impl/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::drawing {
namespace {

/** \brief 1, 2 or 5 times a power of ten. */
double
roundLength(double length)
{
  const double ten = std::pow(10, std::floor(std::log10(length)));
  const double times = length / ten;
  return ten * (times >= 5 ? 5 : times >= 2 ? 2 : 1);
}

} // namespace

void
drawDot(Picture& picture, const Eigen::Vector2d& at, Color color, Color rim)
{
  picture.drawLine(at, at, 9, rim);
  picture.drawLine(at, at, 6, color);
}

void
writeLabels(Picture& picture,
            const std::vector<Label>& labels,
            double left,
            double right,
            const LabelStyle& style,
            std::vector<Eigen::AlignedBox2d> covered)
{
  const double size = style.size;
  for (const Label& label : labels) {
    const double width = picture.widthOf(label.text, size);
    // To the right and to the left, above and below.
    for (const Eigen::Vector2d& from :
         {Eigen::Vector2d(7, 0.35 * size),
          Eigen::Vector2d(-7 - width, 0.35 * size),
          Eigen::Vector2d(-0.5 * width, -8),
          Eigen::Vector2d(-0.5 * width, 8 + 0.8 * size)}) {
      const Eigen::Vector2d start = label.at + from;
      const Eigen::AlignedBox2d box(start - Eigen::Vector2d(2, 0.85 * size),
                                    start + Eigen::Vector2d(width + 2, 0.2 * size));
      const bool covers =
          std::any_of(covered.begin(), covered.end(), [&](const auto& other) {
            return box.intersects(other);
          });
      if (covers || start.x() < left || start.x() + width > right)
        continue;
      picture.write(label.text, start.x(), start.y(), size, style.ink, style.paper);
      covered.push_back(box);
      break;
    }
  }
}

void
drawScaleBar(Picture& picture,
             double pixels_per_unit,
             const Eigen::Vector2d& from,
             double most,
             const LabelStyle& style)
{
  const double length = roundLength(most / pixels_per_unit);
  const Eigen::Vector2d to = from + Eigen::Vector2d(length * pixels_per_unit, 0);
  picture.drawLine(from, to, 3, style.ink);
  for (const Eigen::Vector2d& end : {from, to})
    picture.drawLine(
        end - Eigen::Vector2d(0, 5), end + Eigen::Vector2d(0, 5), 3, style.ink);
  picture.write(detail::toText(length) + (length == 1 ? " unit" : " units"),
                to.x() + 12,
                to.y() + 0.35 * style.size,
                style.size,
                style.ink,
                style.paper);
}

} // namespace pcl_flashreg::drawing
