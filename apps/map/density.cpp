// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "density.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pcl_flashreg::map {
namespace {

using drawing::Canvas;
using drawing::Color;

/** \brief A number a pixel. */
class Layer {
public:
  Layer(int width, int height)
      : width_(width),
        height_(height),
        values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
  {
  }

  /** \brief A tent around a place, the sum of whose values is `weight`, as far as it lies
   * within. */
  void
  addTent(double x, double y, double radius, double weight)
  {
    const int left = std::max(0, static_cast<int>(std::ceil(x - radius)));
    const int right = std::min(width_ - 1, static_cast<int>(std::floor(x + radius)));
    const int top = std::max(0, static_cast<int>(std::ceil(y - radius)));
    const int bottom = std::min(height_ - 1, static_cast<int>(std::floor(y + radius)));
    const double scale = weight / (radius * radius);
    for (int row = top; row <= bottom; ++row) {
      const double across = scale * (1 - std::abs(row - y) / radius);
      for (int column = left; column <= right; ++column)
        values_[at(column, row)] +=
            static_cast<float>(across * (1 - std::abs(column - x) / radius));
    }
  }

  std::vector<float>&
  values()
  {
    return values_;
  }

private:
  std::size_t
  at(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_, height_;
  std::vector<float> values_;
};

/** \brief What is drawn in full color. */
float
fullExposure(const std::vector<float>& density)
{
  constexpr double SHARE = 0.96;
  std::vector<float> values;
  std::copy_if(density.begin(),
               density.end(),
               std::back_inserter(values),
               [](float value) { return value > 0; });
  if (values.empty())
    return 1;
  const auto k = static_cast<std::ptrdiff_t>(SHARE * double(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

std::uint8_t
mixed(std::uint8_t paper, std::uint8_t ink, float share)
{
  return static_cast<std::uint8_t>(
      std::lround(float(paper) + share * (float(ink) - float(paper))));
}

} // namespace

Canvas
densityOf(const FlatGroup& group,
          const Scale& scale,
          const std::vector<Color>& colors,
          Color paper)
{
  constexpr double SHARPNESS = 0.5, MAX_RADIUS = 6;
  constexpr float GAMMA = 0.6f;
  const double spacing = scale.pixels_per_unit * group.spacing;
  const double radius = std::clamp(SHARPNESS * spacing, 1.0, MAX_RADIUS);
  Layer all(scale.width, scale.height), most(scale.width, scale.height);
  std::vector<std::size_t> owner(all.values().size());
  for (const FlatScan& scan : group.scans) {
    Layer own(scale.width, scale.height);
    for (const auto& point : scan.points.colwise()) {
      const Eigen::Vector2d pixel = scale.pixelOf(point.cast<double>());
      own.addTent(pixel.x(), pixel.y(), radius, group.weight);
    }
    for (std::size_t i = 0; i < owner.size(); ++i) {
      all.values()[i] += own.values()[i];
      if (own.values()[i] > most.values()[i]) {
        most.values()[i] = own.values()[i];
        owner[i] = scan.scan;
      }
    }
  }
  const float full = fullExposure(all.values());
  Canvas canvas(scale.width, scale.height, paper);
  for (int y = 0, i = 0; y < scale.height; ++y)
    for (int x = 0; x < scale.width; ++x, ++i) {
      const auto pixel = static_cast<std::size_t>(i);
      const float share = std::pow(std::min(1.0f, all.values()[pixel] / full), GAMMA);
      const Color ink = colors[owner[pixel]];
      canvas.setPixel(x,
                      y,
                      {mixed(paper.red, ink.red, share),
                       mixed(paper.green, ink.green, share),
                       mixed(paper.blue, ink.blue, share)});
    }
  return canvas;
}

} // namespace pcl_flashreg::map
