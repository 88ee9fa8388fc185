// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan/many_viewpoints.h"

#include "math/cell.h"
#include "math/cube_image.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <unordered_map>

namespace pcl_flashreg {
namespace {

/** \brief How far a place looks, how far places are from each other, and how near to a surface
 * nobody stands; in spacings. */
constexpr float REACH = 80, STEP = 15, TOO_NEAR = 3;
/** \brief Who sees so little stands outside. */
constexpr std::size_t FEWEST_POINTS = 200;
constexpr double LEAST_SIGHT = 0.15;
/** \brief Pixels along the edge of a face of the cube around a place: a few spacings wide at
 * half its reach. */
constexpr int EDGE = 32, PIXELS = 6 * EDGE * EDGE;
/** \brief Points are hidden that lie farther than the nearest around by more than this. */
constexpr float SLOPE = 1.1f, MARGIN = 2;

struct CellHash {
  std::size_t
  operator()(const Cell& cell) const
  {
    std::uint64_t hash = 0;
    for (const std::int64_t number : cell)
      hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15ull;
    return hash ^ (hash >> 29);
  }
};

/** \brief What a place sees. */
struct Sight {
  /** \brief Share of directions in which there is a surface. */
  double share = 0;
  struct Seen {
    std::uint32_t point;
    /** \brief Of its normal and the way to the place. */
    float cosine;
  };
  std::vector<Seen> seen;
};

/** \brief Looks around from places. One object a thread. */
class Observer {
public:
  Observer(const std::vector<Eigen::Vector3f>& points,
           const std::vector<Eigen::Vector3f>& normals,
           const std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash>& cells,
           float spacing)
      : points_(points), normals_(normals), cells_(cells), spacing_(spacing)
  {
  }

  /** \return nothing seen, if from too near or by nobody who stands among surfaces */
  const Sight&
  lookFrom(const Eigen::Vector3f& place)
  {
    sight_.share = 0;
    sight_.seen.clear();
    if (!gather(place))
      return sight_;
    leastAround(own_, EDGE, around_);
    const auto count = std::count_if(
        around_.begin(), around_.end(), [](float range) { return range < UNSEEN; });
    sight_.share = static_cast<double>(count) / PIXELS;
    if (sight_.share < LEAST_SIGHT)
      return sight_;
    for (const Ray& ray : rays_) {
      if (ray.range > SLOPE * around_[ray.pixel] + MARGIN * spacing_)
        continue;
      const Eigen::Vector3f back = (place - points_[ray.point]) / ray.range;
      sight_.seen.push_back({ray.point, normals_[ray.point].dot(back)});
    }
    return sight_;
  }

private:
  static constexpr float UNSEEN = std::numeric_limits<float>::max();

  struct Ray {
    std::uint32_t point;
    std::size_t pixel;
    float range;
  };

  bool
  gather(const Eigen::Vector3f& place)
  {
    own_.assign(PIXELS, UNSEEN);
    rays_.clear();
    float nearest = UNSEEN;
    const float reach = REACH * spacing_;
    forEachAround(cellOf(place, 0.5f * reach), 2, [&](const Cell& cell) {
      const auto found = cells_.find(cell);
      if (found == cells_.end())
        return;
      for (const std::uint32_t point : found->second) {
        const Eigen::Vector3f ray = points_[point] - place;
        const float range = ray.norm();
        nearest = std::min(nearest, range);
        if (range > reach || !(range > 0))
          continue;
        const auto pixel =
            static_cast<std::size_t>(cubePixelOf(cubePlaceOf(ray), EDGE));
        own_[pixel] = std::min(own_[pixel], range);
        rays_.push_back({point, pixel, range});
      }
    });
    return rays_.size() >= FEWEST_POINTS && nearest > TOO_NEAR * spacing_;
  }

  const std::vector<Eigen::Vector3f>& points_;
  const std::vector<Eigen::Vector3f>& normals_;
  const std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash>& cells_;
  float spacing_;
  /** \brief Ranges, of each pixel the nearest; and of those around it. */
  std::vector<float> own_, around_;
  std::vector<Ray> rays_;
  Sight sight_;
};

/** \brief Free places among the points and just around them, in order. */
std::vector<Eigen::Vector3f>
placesAmong(const std::vector<Eigen::Vector3f>& points, float step)
{
  constexpr int AROUND = 2;
  std::set<Cell> occupied, cells;
  for (const Eigen::Vector3f& point : points)
    occupied.insert(cellOf(point, step));
  for (const Cell& cell : occupied)
    forEachAround(cell, AROUND, [&](const Cell& other) { cells.insert(other); });
  std::vector<Eigen::Vector3f> places;
  for (const Cell& cell : cells)
    places.push_back(step * Eigen::Vector3f(static_cast<float>(cell[0]) + 0.5f,
                                            static_cast<float>(cell[1]) + 0.5f,
                                            static_cast<float>(cell[2]) + 0.5f));
  return places;
}

/** \brief For the side that normals point to if above 0; sums of integers, so that their order
 * does not matter. */
using Votes = std::vector<std::atomic<std::int64_t>>;

/** \brief Share of fronts among what is seen, each by its cosine. */
double
shareOfFronts(const Sight& sight, const Votes& votes)
{
  double fronts = 0, all = 0;
  for (const Sight::Seen& seen : sight.seen) {
    const auto cosine = static_cast<double>(seen.cosine);
    const std::int64_t vote = votes[seen.point].load(std::memory_order_relaxed);
    fronts += (cosine > 0) == (vote > 0) ? std::abs(cosine) : 0;
    all += std::abs(cosine);
  }
  return all > 0 ? fronts / all : 0;
}

} // namespace

std::vector<bool>
facingAway(const std::vector<Eigen::Vector3f>& points,
           const std::vector<Eigen::Vector3f>& normals,
           float spacing,
           ThreadPool& pool)
{
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells;
  for (std::size_t i = 0; i < points.size(); ++i)
    cells[cellOf(points[i], 0.5f * REACH * spacing)].push_back(
        static_cast<std::uint32_t>(i));
  const std::vector<Eigen::Vector3f> places = placesAmong(points, STEP * spacing);
  const auto everybodyVotes = [&](Votes& votes, const auto& weightOf) {
    constexpr std::size_t A_TASK = 16;
    constexpr double UNIT = 1 << 30;
    pool.forEach((places.size() + A_TASK - 1) / A_TASK, [&](std::size_t task, auto) {
      Observer observer(points, normals, cells, spacing);
      const std::size_t end = std::min(places.size(), (task + 1) * A_TASK);
      for (std::size_t i = task * A_TASK; i < end; ++i) {
        const Sight& sight = observer.lookFrom(places[i]);
        const double weight = sight.seen.empty() ? 0 : UNIT * weightOf(sight);
        for (const Sight::Seen& seen : sight.seen)
          votes[seen.point].fetch_add(
              std::llround(weight * static_cast<double>(seen.cosine)),
              std::memory_order_relaxed);
      }
    });
  };
  Votes first(points.size()), second(points.size());
  everybodyVotes(first, [](const Sight& sight) { return std::pow(sight.share, 6); });
  everybodyVotes(second, [&](const Sight& sight) {
    const double lead = std::max(0.0, 2 * shareOfFronts(sight, first) - 1);
    return std::pow(sight.share, 2) * std::pow(lead, 4);
  });
  std::vector<bool> away(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    away[i] = (second[i] != 0 ? second[i] : first[i]) < 0;
  return away;
}

} // namespace pcl_flashreg
