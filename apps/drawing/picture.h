// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "raster.h"

#include <Eigen/Core>
#include <cairo.h>

#include <memory>
#include <string>

namespace pcl_flashreg::drawing {

/** \brief Canvases, with lines and text on top of them. */
class Picture {
public:
  /** \throws std::runtime_error if there is not enough memory */
  Picture(int width, int height, Color background);

  /** \brief Puts a canvas, all of which has room, into the picture.
   * \param[in] x, y the pixel that its upper left one covers */
  void
  paste(const Canvas& canvas, int x, int y);

  /** \brief A straight line with round ends; a dot where these are one.
   * \param[in] width in pixels
   * \param[in] opacity (0, 1] */
  void
  drawLine(const Eigen::Vector2d& from,
           const Eigen::Vector2d& to,
           double width,
           Color color,
           double opacity = 1);

  /** \brief How far write() would get. */
  double
  widthOf(const std::string& text, double size);

  /** \brief Writes a word with a halo in which it can be read on top of points, too.
   * \param[in] x, y left end of the base line, in pixels
   * \param[in] size of the font, in pixels
   * \return where the next letter would begin
   */
  double
  write(const std::string& text,
        double x,
        double y,
        double size,
        Color color,
        Color halo);

  /** \brief The bytes of a PNG file.
   * \throws std::runtime_error if anything could not be drawn or encoded
   */
  std::string
  encode() const;

private:
  struct Release {
    void
    operator()(cairo_surface_t* surface) const
    {
      cairo_surface_destroy(surface);
    }

    void
    operator()(cairo_t* context) const
    {
      cairo_destroy(context);
    }
  };

  void
  setColor(Color color, double opacity = 1);

  std::unique_ptr<cairo_surface_t, Release> surface_;
  std::unique_ptr<cairo_t, Release> context_;
};

} // namespace pcl_flashreg::drawing
