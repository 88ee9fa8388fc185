// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "../drawing/labels.h"
#include "../drawing/picture.h"
#include "density.h"
#include "groups.h"
#include "map_picture.h"
#include "map_view.h"
#include "scan_colors.h"
#include "short_names.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::map {
namespace {

using drawing::Color;
using drawing::Picture;

/** \brief Pixels. */
constexpr int WIDTH = 1800, HEIGHT = 1400, MARGIN = 36, LEAST = 90;
constexpr int FOOT = 60, LEAST_WIDTH = 800;
constexpr double TITLE = 22, LABEL = 15;
/** \brief Groups that are drawn; smaller ones would fill pages. */
constexpr std::size_t MOST_GROUPS = 24;

constexpr Color PAPER = {255, 255, 255};
constexpr Color INK = {45, 45, 50};

/** \brief A group and its place in the picture. */
struct Panel {
  FlatGroup group;
  /** \brief Upper left corner. */
  int left = 0, top = 0;
  Scale scale;

  Eigen::Vector2d
  pixelOf(const Eigen::Vector2d& point) const
  {
    return Eigen::Vector2d(left, top) + scale.pixelOf(point);
  }
};

std::vector<Panel>
makePanels(const MapDrawing& drawing)
{
  std::vector<Panel> panels;
  for (const std::vector<std::size_t>& members : drawing.result.groups) {
    if (members.size() < 2 || panels.size() == MOST_GROUPS)
      break;
    panels.emplace_back();
    panels.back().group = seenFromAbove(members, drawing.result, drawing.scans);
  }
  return panels;
}

/** \brief One scale for all, at which the largest group fits. */
double
pixelsPerUnit(const std::vector<Panel>& panels)
{
  double scale = 1e12;
  for (const Panel& panel : panels) {
    const Eigen::Vector2d sizes = panel.group.box.sizes();
    scale = std::min({scale,
                      (WIDTH - 2 * MARGIN) / std::max(1e-12, sizes.x()),
                      (HEIGHT - 2 * MARGIN) / std::max(1e-12, sizes.y())});
  }
  return scale;
}

/** \brief Puts panels side by side, in rows like text.
 * \return height of them all */
int
arrange(std::vector<Panel>& panels, double scale)
{
  const int heading = panels.size() > 1 ? static_cast<int>(1.6 * TITLE) : 0;
  int x = 0, y = 0, row_height = 0;
  for (Panel& panel : panels) {
    const Eigen::Vector2d sizes = scale * panel.group.box.sizes();
    panel.scale = {scale,
                   panel.group.box.center(),
                   std::max(LEAST, static_cast<int>(std::ceil(sizes.x()))) + 2 * MARGIN,
                   std::max(LEAST, static_cast<int>(std::ceil(sizes.y()))) +
                       2 * MARGIN};
    if (x > 0 && x + panel.scale.width > WIDTH) {
      y += row_height;
      x = row_height = 0;
    }
    panel.left = x;
    panel.top = y + heading;
    x += panel.scale.width;
    row_height = std::max(row_height, panel.scale.height + heading);
  }
  return y + row_height;
}

/** \brief At a scale at which not even many groups are much higher than the largest may
 * be.
 * \return height of them all */
int
arrange(std::vector<Panel>& panels)
{
  constexpr double SMALLER = 0.9, SMALLEST = 0.4;
  const double largest = pixelsPerUnit(panels);
  for (double scale = largest;; scale *= SMALLER) {
    const int height = arrange(panels, scale);
    if (height <= 1.1 * HEIGHT || scale < SMALLEST * largest)
      return height;
  }
}

/** \brief Many edges are drawn in a light gray, which leaves the points to be seen. */
void
drawEdges(Picture& picture, const Panel& panel, const MultiviewResult& result)
{
  std::vector<const FlatScan*> drawn(result.scans.size(), nullptr);
  for (const FlatScan& scan : panel.group.scans)
    drawn[scan.scan] = &scan;
  std::vector<const MapEdge*> edges;
  for (const MapEdge& edge : result.edges)
    if (edge.fate == EdgeFate::Used && drawn[edge.source] && drawn[edge.target])
      edges.push_back(&edge);
  const double few = 3 * static_cast<double>(panel.group.scans.size()) /
                     static_cast<double>(edges.size());
  for (const MapEdge* edge : edges)
    picture.drawLine(panel.pixelOf(drawn[edge->source]->place),
                     panel.pixelOf(drawn[edge->target]->place),
                     1,
                     INK,
                     0.35 * std::clamp(few, 0.15, 1.0));
}

/** \brief Dots where the scans are, and what they are called. */
void
drawLabels(Picture& picture,
           const Panel& panel,
           const std::vector<std::string>& labels,
           const std::vector<Color>& colors)
{
  std::vector<drawing::Label> written;
  for (const FlatScan& scan : panel.group.scans) {
    const Eigen::Vector2d at = panel.pixelOf(scan.place);
    drawing::drawDot(picture, at, colors[scan.scan], PAPER);
    written.push_back({labels[scan.scan], at});
  }
  drawing::writeLabels(picture,
                       written,
                       panel.left,
                       panel.left + panel.scale.width,
                       {LABEL, INK, PAPER});
}

std::string
captionOf(const MultiviewResult& result, std::size_t drawn)
{
  const std::size_t groups = numberOfMaps(result);
  std::string text = std::to_string(result.placed()) + " of " +
                     std::to_string(result.scans.size()) + " scans placed";
  if (groups > 1)
    text += ", in " + std::to_string(groups) + " maps";
  if (groups > drawn)
    text += ", of which " + std::to_string(drawn) + " are drawn";
  return text;
}

std::string
draw(const MapDrawing& drawing)
{
  std::vector<Panel> panels = makePanels(drawing);
  const int height = (panels.empty() ? 0 : arrange(panels)) + FOOT;
  int width = LEAST_WIDTH;
  for (const Panel& panel : panels)
    width = std::max(width, panel.left + panel.scale.width);
  Picture picture(width, height, PAPER);
  const std::vector<Color> colors = scanColors(drawing.result);
  const std::vector<std::string> labels = shortNames(drawing.names);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Panel& panel = panels[k];
    picture.paste(
        densityOf(panel.group, panel.scale, colors, PAPER), panel.left, panel.top);
    drawEdges(picture, panel, drawing.result);
    drawLabels(picture, panel, labels, colors);
    if (panels.size() > 1)
      picture.write("map " + std::to_string(k + 1) + ": " +
                        std::to_string(panel.group.scans.size()) + " scans",
                    panel.left + MARGIN,
                    panel.top,
                    TITLE,
                    INK,
                    PAPER);
  }
  const double bottom = height - 0.5 * FOOT;
  if (!panels.empty())
    drawing::drawScaleBar(picture,
                          panels.front().scale.pixels_per_unit,
                          {MARGIN, bottom},
                          0.25 * width,
                          {LABEL, INK, PAPER});
  const std::string caption = captionOf(drawing.result, panels.size());
  picture.write(caption,
                width - MARGIN - picture.widthOf(caption, LABEL),
                bottom + 0.35 * LABEL,
                LABEL,
                INK,
                PAPER);
  return picture.encode();
}

} // namespace
} // namespace pcl_flashreg::map

void
pcl_flashreg_draw_map(const pcl_flashreg::map::MapDrawing& drawing, std::string& png)
{
  png = pcl_flashreg::map::draw(drawing);
}
