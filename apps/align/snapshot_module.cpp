// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "../drawing/picture.h"
#include "../drawing/raster.h"
#include "camera.h"
#include "modules.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::align {
namespace {

using drawing::Canvas;
using drawing::Color;
using drawing::Picture;

constexpr int kPanel = 900;
constexpr int kGap = 4;
/** \brief Points are drawn at twice the size, then halved: smooth edges. */
constexpr int kOversampling = 2;

constexpr Color kSource = {240, 130, 20};
constexpr Color kTarget = {40, 115, 215};
constexpr Color kBackground = {252, 252, 252};
constexpr Color kBetween = {170, 170, 175};
constexpr Color kInk = {50, 50, 55};

Eigen::Matrix3Xd
finitePoints(const Eigen::Map<const Eigen::Matrix3Xd>& xyz)
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

Canvas
drawClouds(const ViewDirection& direction,
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
  return canvas.halved();
}

void
addPanel(Picture& picture, int left, const std::string& title, const Canvas& clouds)
{
  constexpr double margin = 0.03 * kPanel;
  constexpr double title_size = 0.04 * kPanel;
  constexpr double label_size = 0.025 * kPanel;
  constexpr double bottom = kPanel - margin;
  const double x = left + margin;
  picture.paste(clouds, left, 0);
  picture.write(title, x, margin + 0.75 * title_size, title_size, kInk, kBackground);
  const double next =
      picture.write("source", x, bottom, label_size, kSource, kBackground);
  picture.write(
      "target", next + 0.8 * label_size, bottom, label_size, kTarget, kBackground);
}

} // namespace

} // namespace pcl_flashreg::align

void
pcl_flashreg_draw_snapshot(const pcl_flashreg::align::ShownClouds& clouds,
                           std::string& png)
{
  using namespace pcl_flashreg::align;
  const Eigen::Matrix3Xd before = finitePoints({clouds.source, 3, clouds.source_size});
  const Eigen::Matrix3Xd after =
      finitePoints({clouds.moved_source, 3, clouds.source_size});
  const Eigen::Matrix3Xd target = finitePoints({clouds.target, 3, clouds.target_size});
  const ViewDirection direction = chooseViewDirection(target);
  pcl_flashreg::drawing::Picture picture(2 * kPanel + kGap, kPanel, kBetween);
  addPanel(picture, 0, "before", drawClouds(direction, before, target));
  addPanel(picture, kPanel + kGap, "after", drawClouds(direction, after, target));
  png = picture.encode();
}
