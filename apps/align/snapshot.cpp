// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "snapshot.h"

#include "../io/error.h"
#include "../io/file.h"
#include "camera.h"
#include "raster.h"
#include "stroke_font.h"

#include <png.h>

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::align {
namespace {

constexpr int kPanel = 900;
constexpr int kGap = 4;
/** \brief Everything is drawn at twice the size, then halved: smooth edges. */
constexpr int kOversampling = 2;

constexpr Color kSource = {240, 130, 20};
constexpr Color kTarget = {40, 115, 215};
constexpr Color kBackground = {252, 252, 252};
constexpr Color kInk = {50, 50, 55};

Eigen::Matrix3Xd
finitePoints(const Eigen::Matrix3Xd& xyz)
{
  Eigen::Matrix3Xd finite(3, xyz.cols());
  Eigen::Index n = 0;
  for (const auto& p : xyz.colwise())
    if (p.allFinite())
      finite.col(n++) = p;
  return finite.leftCols(n);
}

Eigen::Matrix3Xd
joined(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b)
{
  Eigen::Matrix3Xd both(3, a.cols() + b.cols());
  both << a, b;
  return both;
}

/** \brief Radius in pixels at which the points cover a good part of a panel. */
double
discRadius(Eigen::Index points)
{
  constexpr double cover = 1.2;
  const double area = cover * kPanel * kPanel / std::max<double>(1, double(points));
  return kOversampling * std::clamp(0.5 * std::sqrt(area), 0.8, 4.0);
}

void
drawPoints(Canvas& canvas,
           const Camera& camera,
           const Eigen::Matrix3Xd& xyz,
           double radius,
           Color color)
{
  const double half = 0.5 * canvas.width();
  for (const auto& p : xyz.colwise()) {
    const Eigen::Vector3d seen = camera.project(p);
    // What is right before the viewer would hide everything else.
    if (seen.z() < 0.05 * camera.distance())
      continue;
    const double near = std::clamp(camera.distance() / seen.z(), 0.6, 2.0);
    canvas.drawDisc(static_cast<float>(half * (1 + seen.x())),
                    static_cast<float>(half * (1 - seen.y())),
                    static_cast<float>(radius * near),
                    static_cast<float>(seen.z()),
                    color);
  }
}

/** \brief Text that can be read on top of points, too. */
float
label(
    Canvas& canvas, const std::string& text, float x, float y, float size, Color color)
{
  constexpr float stroke = 0.2f;
  constexpr float halo = 0.7f;
  drawText(canvas, text, x, y, size, halo * size, kBackground);
  return drawText(canvas, text, x, y, size, stroke * size, color);
}

Canvas
drawPanel(const std::string& title,
          const ViewDirection& direction,
          const Eigen::Matrix3Xd& source,
          const Eigen::Matrix3Xd& target)
{
  constexpr int size = kPanel * kOversampling;
  Canvas canvas(size, size, kBackground);
  const Camera camera(direction, joined(source, target));
  const double radius = discRadius(source.cols() + target.cols());
  drawPoints(canvas, camera, target, radius, kTarget);
  drawPoints(canvas, camera, source, radius, kSource);
  canvas.shadeByDepth(2 * kOversampling, 60);
  label(canvas, title, 0.03f * size, 0.06f * size, 0.022f * size, kInk);
  const float next =
      label(canvas, "source", 0.03f * size, 0.972f * size, 0.014f * size, kSource);
  label(canvas, "target", next + 0.02f * size, 0.972f * size, 0.014f * size, kTarget);
  return canvas.halved();
}

std::string
encodePng(const Canvas& canvas)
{
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(canvas.width());
  image.height = static_cast<png_uint_32>(canvas.height());
  image.format = PNG_FORMAT_RGB;
  static_assert(sizeof(Color) == 3);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(
          &image, bytes.data(), &size, 0, canvas.pixels(), 0, nullptr))
    throw io::InputError(std::string("the picture can't be encoded: ") + image.message);
  bytes.resize(size);
  return bytes;
}

} // namespace

const bool kSnapshotBuiltIn = true;

void
writeSnapshot(const std::string& path,
              const Eigen::Matrix3Xd& source,
              const Eigen::Matrix3Xd& target,
              const RigidTransform& T_target_source)
{
  const Eigen::Matrix3Xd before = finitePoints(source);
  const Eigen::Matrix3Xd still = finitePoints(target);
  const Eigen::Matrix3Xd after =
      (T_target_source.rotation * before).colwise() + T_target_source.translation;
  const ViewDirection direction = chooseViewDirection(still);
  Canvas picture(2 * kPanel + kGap, kPanel, {170, 170, 175});
  picture.paste(drawPanel("before", direction, before, still), 0);
  picture.paste(drawPanel("after", direction, after, still), kPanel + kGap);
  io::writeFile(path, encodePng(picture));
}

} // namespace pcl_flashreg::align
