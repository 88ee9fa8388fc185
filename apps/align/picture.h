// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "raster.h"

#include <cairo.h>

#include <memory>
#include <string>

namespace pcl_flashreg::align {

/** \brief Canvases side by side, with text on top of them. */
class Picture {
public:
  /** \throws std::runtime_error if there is not enough memory */
  Picture(int width, int height, Color background);

  /** \brief Puts a canvas as high as the picture into it, its left edge at column x. */
  void
  paste(const Canvas& canvas, int x);

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
  setColor(Color color);

  std::unique_ptr<cairo_surface_t, Release> surface_;
  std::unique_ptr<cairo_t, Release> context_;
};

} // namespace pcl_flashreg::align
