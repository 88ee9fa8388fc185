// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "localization/places.h"

#include "judgement/cpu/vicinity.h"
#include "math/cell.h"
#include "math/quantile.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief Of the keypoints so many lie within the radius of a scan. */
constexpr double SHARE_WITHIN = 0.9;

Eigen::Vector3f
pointOf(const Scan& scan, std::size_t i)
{
  return Eigen::Map<const Eigen::Vector3f>(scan.points() + 3 * i);
}

/** \brief Of the sphere about their mean that most keypoints lie in. */
float
radiusOf(const Scan& scan)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < scan.size(); ++i)
    mean += pointOf(scan, i).cast<double>();
  mean /= static_cast<double>(scan.size());
  std::vector<float> squared;
  for (std::size_t i = 0; i < scan.size(); ++i)
    squared.push_back((pointOf(scan, i) - mean.cast<float>()).squaredNorm());
  return std::sqrt(quantileOf(squared, SHARE_WITHIN));
}

/** \brief Matches by the cell of their keypoint in the map; the matches of a keypoint of the
 * scan follow each other, the nearest first. */
using Cells = std::map<Cell, std::vector<FeatureMatch>>;

Cells
sortIntoCells(const Scan& map, const std::vector<FeatureMatch>& matches, float side)
{
  Cells cells;
  for (const FeatureMatch& match : matches)
    cells[cellOf(pointOf(map, static_cast<std::size_t>(match.match)), side)].push_back(
        match);
  return cells;
}

/** \brief Matches in a cell and those around it: of each keypoint of the scan the nearest. */
std::vector<FeatureMatch>
matchesAround(const Cells& cells, const Cell& cell)
{
  std::vector<FeatureMatch> here;
  forEachAround(cell, 1, [&](const Cell& other) {
    const auto found = cells.find(other);
    if (found != cells.end())
      here.insert(here.end(), found->second.begin(), found->second.end());
  });
  std::sort(here.begin(), here.end(), [](const auto& a, const auto& b) {
    return std::tie(a.query, a.squared_distance, a.match) <
           std::tie(b.query, b.squared_distance, b.match);
  });
  return firstOfEach(std::move(here));
}

/** \brief Whether cells are so near that the places around them are nearly the same. */
bool
touching(const Cell& a, const Cell& b)
{
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]) <= 1;
}

} // namespace

std::vector<FeatureMatch>
firstOfEach(std::vector<FeatureMatch> matches)
{
  const auto sameQuery = [](const FeatureMatch& a, const FeatureMatch& b) {
    return a.query == b.query;
  };
  matches.erase(std::unique(matches.begin(), matches.end(), sameQuery), matches.end());
  return matches;
}

bool
isMapFor(const Scan& map, const Scan& scan)
{
  return Vicinity::isMuchLarger(map.size(), scan.size());
}

std::vector<std::vector<FeatureMatch>>
matchesByPlace(const Scan& scan,
               const Scan& map,
               const std::vector<FeatureMatch>& matches,
               std::size_t most)
{
  // Of keypoints in one place, too, a place is some way across.
  const float side = std::max(radiusOf(scan), static_cast<float>(map.spacing()));
  const Cells cells = sortIntoCells(map, matches, side);
  struct Place {
    Cell cell;
    std::vector<FeatureMatch> matches;
  };
  std::vector<Place> places;
  for (const auto& [cell, own] : cells)
    places.push_back({cell, matchesAround(cells, cell)});
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) {
    return a.matches.size() > b.matches.size();
  });
  std::vector<Cell> taken;
  std::vector<std::vector<FeatureMatch>> result;
  for (Place& place : places) {
    if (result.size() == most)
      break;
    if (std::any_of(taken.begin(), taken.end(), [&](const Cell& other) {
          return touching(place.cell, other);
        }))
      continue;
    taken.push_back(place.cell);
    result.push_back(std::move(place.matches));
  }
  return result;
}

} // namespace pcl_flashreg
