// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "stroke_font.h"

#include <cmath>
#include <map>
#include <vector>

namespace pcl_flashreg::align {
namespace {

/** \brief Part of an ellipse, in degrees, counter-clockwise from the right; a straight
 * line is {x0, y0} to {x1, y1} with no radius. Unit: the height of a small letter, y
 * upwards. */
struct Stroke {
  float x0, y0, x1, y1;
  float rx = 0, ry = 0;
  float from = 0, to = 0;
};

Stroke
line(float x0, float y0, float x1, float y1)
{
  return {x0, y0, x1, y1};
}

Stroke
arc(float x, float y, float rx, float ry, float from, float to)
{
  return {x, y, x, y, rx, ry, from, to};
}

struct Glyph {
  float width;
  std::vector<Stroke> strokes;
};

const std::map<char, Glyph>&
glyphs()
{
  const Stroke bowl = arc(0.42f, 0.5f, 0.42f, 0.5f, 0, 360);
  static const std::map<char, Glyph> all = {
      {'a', {0.84f, {bowl, line(0.84f, 1, 0.84f, 0)}}},
      {'b', {0.84f, {bowl, line(0, 1.6f, 0, 0)}}},
      {'c', {0.74f, {arc(0.42f, 0.5f, 0.42f, 0.5f, 45, 315)}}},
      {'e',
       {0.84f, {line(0, 0.5f, 0.84f, 0.5f), arc(0.42f, 0.5f, 0.42f, 0.5f, 0, 315)}}},
      {'f',
       {0.5f,
        {arc(0.44f, 1.3f, 0.26f, 0.3f, 70, 180),
         line(0.18f, 1.3f, 0.18f, 0),
         line(0, 1, 0.46f, 1)}}},
      {'g',
       {0.84f,
        {bowl,
         line(0.84f, 1, 0.84f, -0.1f),
         arc(0.42f, -0.1f, 0.42f, 0.4f, 220, 360)}}},
      {'o', {0.84f, {bowl}}},
      {'r', {0.54f, {line(0, 1, 0, 0), arc(0.38f, 0.58f, 0.38f, 0.42f, 65, 180)}}},
      {'s',
       {0.66f,
        {arc(0.33f, 0.76f, 0.3f, 0.24f, 30, 270),
         arc(0.33f, 0.26f, 0.33f, 0.26f, -150, 90)}}},
      {'t',
       {0.52f,
        {line(0.18f, 1.4f, 0.18f, 0.26f),
         arc(0.42f, 0.26f, 0.24f, 0.26f, 180, 290),
         line(0, 1, 0.48f, 1)}}},
      {'u',
       {0.8f,
        {line(0, 1, 0, 0.4f),
         arc(0.4f, 0.4f, 0.4f, 0.4f, 180, 360),
         line(0.8f, 1, 0.8f, 0)}}}};
  return all;
}

} // namespace

float
drawText(Canvas& canvas,
         const std::string& text,
         float x,
         float y,
         float size,
         float thickness,
         Color color)
{
  const auto draw = [&](float x0, float y0, float x1, float y1) {
    canvas.drawLine(
        x + size * x0, y - size * y0, x + size * x1, y - size * y1, thickness, color);
  };
  for (const char letter : text) {
    const auto glyph = glyphs().find(letter);
    if (glyph == glyphs().end()) {
      x += 0.7f * size;
      continue;
    }
    for (const Stroke& s : glyph->second.strokes) {
      if (s.rx == 0) {
        draw(s.x0, s.y0, s.x1, s.y1);
        continue;
      }
      constexpr int pieces = 32;
      constexpr float degree = 3.14159265f / 180;
      const auto angle = [&](int k) {
        return degree * (s.from + (s.to - s.from) * static_cast<float>(k) / pieces);
      };
      for (int k = 0; k < pieces; ++k)
        draw(s.x0 + s.rx * std::cos(angle(k)),
             s.y0 + s.ry * std::sin(angle(k)),
             s.x0 + s.rx * std::cos(angle(k + 1)),
             s.y0 + s.ry * std::sin(angle(k + 1)));
    }
    x += (glyph->second.width + 0.38f) * size;
  }
  return x;
}

} // namespace pcl_flashreg::align
