// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "../drawing/labels.h"
#include "../drawing/picture.h"
#include "../map/density.h"
#include "../map/map_view.h"
#include "../map/short_names.h"
#include "places_picture.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::localize {
namespace {

using drawing::Color;
using drawing::Picture;

/** \brief Pixels. */
constexpr int WIDTH = 1800, HEIGHT = 1400, MARGIN = 36, FOOT = 60, LEAST_WIDTH = 800;
constexpr double LABEL = 15, HEADING = 22;

constexpr Color PAPER = {255, 255, 255};
constexpr Color INK = {45, 45, 50};
constexpr Color MAP = {120, 120, 128};
/** \brief Okabe and Ito's blue and vermilion: they differ for color-blind people, too. */
constexpr Color TRUSTED = {0, 114, 178}, NOT_TRUSTED = {213, 94, 0};

map::FlatGroup
mapFromAbove(const Scan& scan)
{
  MultiviewResult alone;
  alone.scans.resize(1);
  alone.groups = {{0}};
  return map::seenFromAbove({0}, alone, [&](std::size_t) { return scan; });
}

/** \brief At which all of the box fits. */
map::Scale
scaleOf(const Eigen::AlignedBox2d& box)
{
  map::Scale scale;
  const Eigen::Vector2d sizes = box.sizes().cwiseMax(1e-12);
  scale.pixels_per_unit =
      std::min((WIDTH - 2 * MARGIN) / sizes.x(), (HEIGHT - 2 * MARGIN) / sizes.y());
  scale.middle = box.center();
  const Eigen::Vector2d pixels = scale.pixels_per_unit * sizes;
  scale.width =
      std::max(LEAST_WIDTH, static_cast<int>(std::ceil(pixels.x())) + 2 * MARGIN);
  scale.height = static_cast<int>(std::ceil(pixels.y())) + 2 * MARGIN;
  return scale;
}

class PlacesPicture {
public:
  explicit PlacesPicture(const PlacesDrawing& drawing)
      : drawing_(drawing),
        labels_(labelsOf(drawing.places)),
        flat_(mapFromAbove(drawing.map)),
        scale_(scaleOf(boxOf(flat_, drawing.places))),
        picture_(scale_.width, scale_.height + FOOT, PAPER)
  {
  }

  std::string
  draw()
  {
    picture_.paste(map::densityOf(flat_, scale_, {MAP}, PAPER), 0, 0);
    drawPlaces(/* trusted */ false);
    drawPlaces(/* trusted */ true);
    const drawing::LabelStyle style{LABEL, INK, PAPER};
    drawing::writeLabels(picture_, written_, 0, scale_.width, style, lines_);
    const double bottom = scale_.height + 0.5 * FOOT;
    drawing::drawScaleBar(
        picture_, scale_.pixels_per_unit, {MARGIN, bottom}, 0.25 * scale_.width, style);
    const std::string& caption = drawing_.caption;
    picture_.write(caption,
                   scale_.width - MARGIN - picture_.widthOf(caption, LABEL),
                   bottom + 0.35 * LABEL,
                   LABEL,
                   INK,
                   PAPER);
    return picture_.encode();
  }

private:
  static std::vector<std::string>
  labelsOf(const std::vector<DrawnPlace>& places)
  {
    std::vector<std::string> names;
    for (const DrawnPlace& place : places)
      names.push_back(place.name);
    return map::shortNames(names);
  }

  static Eigen::Vector2d
  flatPlace(const map::FlatGroup& flat, const Eigen::Vector3d& point)
  {
    return flat.view * (point - flat.origin);
  }

  /** \brief Of the map and of all that is trusted: what is not may be anywhere. */
  static Eigen::AlignedBox2d
  boxOf(const map::FlatGroup& flat, const std::vector<DrawnPlace>& places)
  {
    Eigen::AlignedBox2d box = flat.box;
    for (const DrawnPlace& place : places)
      if (place.trusted)
        box.extend(flatPlace(flat, place.T_map_scan.translation));
    return box;
  }

  void
  drawPlaces(bool trusted)
  {
    const Color color = trusted ? TRUSTED : NOT_TRUSTED;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const DrawnPlace& place = drawing_.places[i];
      const Eigen::Vector2d at =
          scale_.pixelOf(flatPlace(flat_, place.T_map_scan.translation));
      const bool inside =
          at.x() >= 0 && at.y() >= 0 && at.x() < scale_.width && at.y() < scale_.height;
      if (place.trusted != trusted || !inside)
        continue;
      const Eigen::Vector2d end = at + HEADING * aheadOf(place.T_map_scan.rotation);
      picture_.drawLine(at, end, 5, PAPER);
      picture_.drawLine(at, end, 2.5, color);
      lines_.push_back(Eigen::AlignedBox2d(at.cwiseMin(end), at.cwiseMax(end)));
      drawing::drawDot(picture_, at, color, PAPER);
      written_.push_back({labels_[i], at});
    }
  }

  /** \brief In pixels, of length 1, or shorter where it leads up or down. */
  Eigen::Vector2d
  aheadOf(const Eigen::Matrix3d& R) const
  {
    const Eigen::Matrix<double, 2, 3> axes = flat_.view * R;
    const bool z_is_upright = axes.col(2).norm() < axes.col(1).norm();
    const Eigen::Vector2d ahead = axes.col(z_is_upright ? 0 : 2);
    return {ahead.x(), -ahead.y()};
  }

  const PlacesDrawing& drawing_;
  std::vector<std::string> labels_;
  map::FlatGroup flat_;
  map::Scale scale_;
  Picture picture_;
  std::vector<drawing::Label> written_;
  std::vector<Eigen::AlignedBox2d> lines_;
};

} // namespace
} // namespace pcl_flashreg::localize

void
pcl_flashreg_draw_places(const pcl_flashreg::localize::PlacesDrawing& drawing,
                         std::string& png)
{
  png = pcl_flashreg::localize::PlacesPicture(drawing).draw();
}
