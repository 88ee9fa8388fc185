// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "picture.h"

#include <cstdint>
#include <new>
#include <stdexcept>

namespace pcl_flashreg::drawing {
namespace {

void
check(cairo_status_t status)
{
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("the picture can't be drawn: ") +
                             cairo_status_to_string(status));
}

/** \brief Called by C: no exception may leave it. */
cairo_status_t
append(void* png, const unsigned char* bytes, unsigned int size)
{
  try {
    static_cast<std::string*>(png)->append(reinterpret_cast<const char*>(bytes), size);
    return CAIRO_STATUS_SUCCESS;
  }
  catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
}

} // namespace

Picture::Picture(int width, int height, Color background)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
      context_(cairo_create(surface_.get()))
{
  check(cairo_status(context_.get()));
  setColor(background);
  cairo_paint(context_.get());
  cairo_select_font_face(
      context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
  // Else the user's settings would move the letters.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context_.get(), options);
  cairo_font_options_destroy(options);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
}

void
Picture::setColor(Color color, double opacity)
{
  cairo_set_source_rgba(context_.get(),
                        color.red / 255.0,
                        color.green / 255.0,
                        color.blue / 255.0,
                        opacity);
}

void
Picture::paste(const Canvas& canvas, int x, int y)
{
  cairo_surface_flush(surface_.get());
  unsigned char* bytes = cairo_image_surface_get_data(surface_.get()) +
                         y * cairo_image_surface_get_stride(surface_.get());
  const Color* color = canvas.pixels();
  for (int row = 0; row < canvas.height(); ++row) {
    auto* pixel = reinterpret_cast<std::uint32_t*>(bytes) + x;
    for (int column = 0; column < canvas.width(); ++column, ++color)
      *pixel++ = static_cast<std::uint32_t>(color->red) << 16 |
                 static_cast<std::uint32_t>(color->green) << 8 | color->blue;
    bytes += cairo_image_surface_get_stride(surface_.get());
  }
  cairo_surface_mark_dirty(surface_.get());
}

void
Picture::drawLine(const Eigen::Vector2d& from,
                  const Eigen::Vector2d& to,
                  double width,
                  Color color,
                  double opacity)
{
  cairo_t* context = context_.get();
  setColor(color, opacity);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_width(context, width);
  cairo_move_to(context, from.x(), from.y());
  cairo_line_to(context, to.x(), to.y());
  cairo_stroke(context);
}

double
Picture::widthOf(const std::string& text, double size)
{
  cairo_set_font_size(context_.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

double
Picture::write(
    const std::string& text, double x, double y, double size, Color color, Color halo)
{
  cairo_t* context = context_.get();
  cairo_set_font_size(context, size);
  cairo_move_to(context, x, y);
  cairo_text_path(context, text.c_str());
  cairo_get_current_point(context, &x, &y);
  setColor(halo);
  cairo_set_line_width(context, 0.4 * size);
  cairo_stroke_preserve(context);
  setColor(color);
  cairo_fill(context);
  return x;
}

std::string
Picture::encode() const
{
  check(cairo_status(context_.get()));
  std::string png;
  check(cairo_surface_write_to_png_stream(surface_.get(), append, &png));
  return png;
}

} // namespace pcl_flashreg::drawing
