// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_flashreg::drawing {

struct Color {
  std::uint8_t red, green, blue;
};

/** \brief Pixels with a depth each, row by row from the top. */
class Canvas {
public:
  Canvas(int width, int height, Color background);

  int
  width() const
  {
    return width_;
  }

  int
  height() const
  {
    return height_;
  }

  const Color*
  pixels() const
  {
    return colors_.data();
  }

  void
  setPixel(int x, int y, Color color)
  {
    colors_[at(x, y)] = color;
  }

  /** \brief A disc that faces the viewer, where nothing nearer has been drawn.
   * \param[in] x, y centre in pixels
   * \param[in] radius in pixels
   * \param[in] depth distance from the viewer, > 0
   */
  void
  drawDisc(float x, float y, float radius, float depth, Color color);

  /** \brief Darkens pixels next to which something is nearer, so that the shapes of
   * clouds without normals can be seen (eye-dome lighting).
   * \param[in] radius how far the neighbours are looked for, in pixels
   * \param[in] strength how dark a step of depth makes it
   */
  void
  shadeByDepth(int radius, float strength);

  /** \brief Half the size: every pixel the mean of four. */
  Canvas
  halved() const;

private:
  std::size_t
  at(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  std::vector<Color> colors_;
  /** \brief Infinite where nothing has been drawn. */
  std::vector<float> depths_;
};

} // namespace pcl_flashreg::drawing
