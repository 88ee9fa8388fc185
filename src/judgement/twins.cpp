// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/twins.h"

#include "math/cell.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief Turns that are looked at, and by what angle (5 degrees) they differ. */
constexpr std::size_t TURNS = 8;
constexpr double ALIKE = 0.0873;

/** \brief Cells of most shifts whose neighbours are looked at, over the places wanted. */
constexpr std::size_t CELLS_A_PLACE = 8;

bool
turnsAlike(const Pose& a, const Pose& b)
{
  double trace = 0;
  for (int i = 0; i < 9; ++i)
    trace += a.r[i] * b.r[i];
  return trace > 1 + 2 * std::cos(ALIKE);
}

std::vector<Pose>
differentTurns(const std::vector<Pose>& poses)
{
  std::vector<Pose> turns;
  for (const Pose& pose : poses)
    if (turns.size() < TURNS &&
        std::none_of(turns.begin(), turns.end(), [&](const Pose& other) {
          return turnsAlike(pose, other);
        }))
      turns.push_back(pose);
  return turns;
}

/** \brief Shifts in one cell: their number and their sum. */
struct Bin {
  Cell cell;
  double count;
  Eigen::Vector3d sum;
};

bool
isBefore(const Bin& bin, const Cell& cell)
{
  return bin.cell < cell;
}

/** \brief The shifts that take each source point, turned, onto its target point; by cell. */
std::vector<Bin>
binsOf(const Problem& problem, const Pose& turn, float side)
{
  std::vector<std::pair<Cell, Eigen::Vector3d>> shifts;
  for (std::size_t i = 0; i < problem.size; ++i) {
    const Vec3 shift = problem.target(i) - rotate(turn.r, problem.source(i));
    const Eigen::Vector3d t(shift.x, shift.y, shift.z);
    shifts.emplace_back(cellOf(t.cast<float>(), side), t);
  }
  std::stable_sort(shifts.begin(), shifts.end(), [](const auto& a, const auto& b) {
    return a.first < b.first;
  });
  std::vector<Bin> bins;
  for (const auto& [cell, shift] : shifts)
    if (!bins.empty() && bins.back().cell == cell) {
      bins.back().count += 1;
      bins.back().sum += shift;
    }
    else {
      bins.push_back({cell, 1, shift});
    }
  return bins;
}

/** \brief The same of a cell and those around it. */
Bin
around(const std::vector<Bin>& bins, const Cell& cell)
{
  Bin all{cell, 0, Eigen::Vector3d::Zero()};
  forEachAround(cell, 1, [&](const Cell& other) {
    const auto found = std::lower_bound(bins.begin(), bins.end(), other, isBefore);
    if (found != bins.end() && found->cell == other) {
      all.count += found->count;
      all.sum += found->sum;
    }
  });
  return all;
}

} // namespace

std::vector<Pose>
twinsOf(const Problem& correspondences,
        const std::vector<Pose>& known,
        float inlier_distance,
        std::size_t most)
{
  const auto more = [](const Bin& a, const Bin& b) { return a.count > b.count; };
  std::vector<Pose> twins;
  for (const Pose& turn : differentTurns(known)) {
    const std::vector<Bin> bins = binsOf(correspondences, turn, inlier_distance);
    std::vector<Bin> fullest = bins;
    std::stable_sort(fullest.begin(), fullest.end(), more);
    fullest.resize(std::min(fullest.size(), CELLS_A_PLACE * most));
    for (Bin& bin : fullest)
      bin = around(bins, bin.cell);
    std::stable_sort(fullest.begin(), fullest.end(), more);
    const std::size_t first = twins.size();
    for (const Bin& bin : fullest) {
      const Eigen::Vector3d shift = bin.sum / bin.count;
      const auto isNear = [&](const Pose& other) {
        return (Eigen::Map<const Eigen::Vector3d>(other.t) - shift).norm() <
               2 * inlier_distance;
      };
      const auto begin = twins.begin() + static_cast<std::ptrdiff_t>(first);
      if (twins.size() == first + most || std::any_of(begin, twins.end(), isNear))
        continue;
      twins.push_back(turn);
      Eigen::Map<Eigen::Vector3d>(twins.back().t) = shift;
    }
  }
  return twins;
}

} // namespace pcl_flashreg
