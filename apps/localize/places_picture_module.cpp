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
/** \brief Okabe and Ito's blue and vermilion: color-blind people tell them apart. */
constexpr Color TRUSTED = {0, 114, 178}, NOT_TRUSTED = {213, 94, 0};

constexpr drawing::LabelStyle STYLE = {LABEL, INK, PAPER};

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
    // What is trusted on top, and no line over a dot.
    const std::vector<Mark> marks = marksOf();
    for (const Mark& mark : marks) {
      picture_.drawLine(mark.at, mark.ahead, 5, PAPER);
      picture_.drawLine(mark.at, mark.ahead, 2.5, colorOf(mark.trusted));
    }
    for (const Mark& mark : marks)
      drawing::drawDot(picture_, mark.at, colorOf(mark.trusted), PAPER);
    writeLabels(marks);
    drawFoot();
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

  /** \brief A place in pixels. */
  struct Mark {
    std::string label;
    Eigen::Vector2d at, ahead;
    bool trusted;
  };

  static Color
  colorOf(bool trusted)
  {
    return trusted ? TRUSTED : NOT_TRUSTED;
  }

  /** \brief Those within the picture; what is trusted comes last. */
  std::vector<Mark>
  marksOf() const
  {
    std::vector<Mark> marks;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const DrawnPlace& place = drawing_.places[i];
      const Eigen::Vector2d at =
          scale_.pixelOf(flatPlace(flat_, place.T_map_scan.translation));
      if (at.x() >= 0 && at.y() >= 0 && at.x() < scale_.width && at.y() < scale_.height)
        marks.push_back({labels_[i],
                         at,
                         at + HEADING * aheadOf(place.T_map_scan.rotation),
                         place.trusted});
    }
    std::stable_partition(
        marks.begin(), marks.end(), [](const Mark& mark) { return !mark.trusted; });
    return marks;
  }

  void
  writeLabels(const std::vector<Mark>& marks)
  {
    std::vector<drawing::Label> labels;
    std::vector<Eigen::AlignedBox2d> lines;
    for (const Mark& mark : marks) {
      labels.push_back({mark.label, mark.at});
      lines.push_back(Eigen::AlignedBox2d(mark.at.cwiseMin(mark.ahead),
                                          mark.at.cwiseMax(mark.ahead)));
    }
    drawing::writeLabels(picture_, labels, 0, scale_.width, STYLE, lines);
  }

  /** \brief The scale, and what the colors mean. */
  void
  drawFoot()
  {
    const double bottom = scale_.height + 0.5 * FOOT;
    drawing::drawScaleBar(
        picture_, scale_.pixels_per_unit, {MARGIN, bottom}, 0.25 * scale_.width, STYLE);
    double right = scale_.width - MARGIN;
    const bool all_trusted =
        std::all_of(drawing_.places.begin(),
                    drawing_.places.end(),
                    [](const DrawnPlace& place) { return place.trusted; });
    if (!all_trusted)
      right = writeLegend("best guess, not trusted", false, right, bottom);
    writeLegend(drawing_.caption, true, right, bottom);
  }

  /** \return where the next one to the left ends */
  double
  writeLegend(const std::string& text, bool trusted, double right, double y)
  {
    constexpr double GAP = 24;
    const double left = right - picture_.widthOf(text, LABEL);
    picture_.write(text, left, y + 0.35 * LABEL, LABEL, INK, PAPER);
    drawing::drawDot(picture_, {left - 12, y}, colorOf(trusted), PAPER);
    return left - GAP - 12;
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
};

} // namespace
} // namespace pcl_flashreg::localize

void
pcl_flashreg_draw_places(const pcl_flashreg::localize::PlacesDrawing& drawing,
                         std::string& png)
{
  png = pcl_flashreg::localize::PlacesPicture(drawing).draw();
}
