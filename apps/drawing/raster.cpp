// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_flashreg::drawing {
namespace {

/** \brief The pixels from a - r to a + r that lie in [0, size). */
struct Range {
  int begin, end;

  Range(float a, float r, int size)
      : begin(static_cast<int>(std::clamp(std::floor(a - r), 0.0f, float(size)))),
        end(static_cast<int>(std::clamp(std::ceil(a + r) + 1, 0.0f, float(size))))
  {
  }
};

std::uint8_t
scaled(std::uint8_t value, float factor)
{
  return static_cast<std::uint8_t>(std::lround(static_cast<float>(value) * factor));
}

} // namespace

Canvas::Canvas(int width, int height, Color background)
    : width_(width),
      height_(height),
      colors_(static_cast<std::size_t>(width) * height, background),
      depths_(colors_.size(), std::numeric_limits<float>::infinity())
{
}

void
Canvas::drawDisc(float x, float y, float radius, float depth, Color color)
{
  const Range rows(y, radius, height_);
  const Range columns(x, radius, width_);
  for (int row = rows.begin; row < rows.end; ++row)
    for (int column = columns.begin; column < columns.end; ++column) {
      const float dx = static_cast<float>(column) - x;
      const float dy = static_cast<float>(row) - y;
      const std::size_t i = at(column, row);
      if (dx * dx + dy * dy <= radius * radius && depth < depths_[i]) {
        depths_[i] = depth;
        colors_[i] = color;
      }
    }
}

void
Canvas::shadeByDepth(int radius, float strength)
{
  const int offsets[8][2] = {{radius, 0},
                             {-radius, 0},
                             {0, radius},
                             {0, -radius},
                             {radius, radius},
                             {radius, -radius},
                             {-radius, radius},
                             {-radius, -radius}};
  std::vector<float> logs(depths_.size());
  std::transform(depths_.begin(), depths_.end(), logs.begin(), [](float depth) {
    return std::log2(depth);
  });
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const std::size_t i = at(x, y);
      if (!std::isfinite(depths_[i]))
        continue;
      float nearer = 0;
      for (const auto& offset : offsets) {
        const int column = x + offset[0];
        const int row = y + offset[1];
        if (column >= 0 && column < width_ && row >= 0 && row < height_)
          nearer += std::max(0.0f, logs[i] - logs[at(column, row)]);
      }
      constexpr float darkest = 0.3f;
      const float light = darkest + (1 - darkest) * std::exp(-strength * nearer / 8);
      Color& color = colors_[i];
      color = {scaled(color.red, light),
               scaled(color.green, light),
               scaled(color.blue, light)};
    }
}

Canvas
Canvas::halved() const
{
  Canvas half(width_ / 2, height_ / 2, {0, 0, 0});
  const auto mean = [](int a, int b, int c, int d) {
    return static_cast<std::uint8_t>((a + b + c + d + 2) / 4);
  };
  for (int y = 0; y < half.height_; ++y)
    for (int x = 0; x < half.width_; ++x) {
      const Color& a = colors_[at(2 * x, 2 * y)];
      const Color& b = colors_[at(2 * x + 1, 2 * y)];
      const Color& c = colors_[at(2 * x, 2 * y + 1)];
      const Color& d = colors_[at(2 * x + 1, 2 * y + 1)];
      half.colors_[half.at(x, y)] = {mean(a.red, b.red, c.red, d.red),
                                     mean(a.green, b.green, c.green, d.green),
                                     mean(a.blue, b.blue, c.blue, d.blue)};
    }
  return half;
}

} // namespace pcl_flashreg::drawing
