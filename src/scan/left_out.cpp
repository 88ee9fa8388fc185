// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan/left_out.h"

#include "scan/points.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace pcl_flashreg {
namespace {

using Place = Eigen::Vector3d;

/** \brief Finite points of a view that are spread over all of it. */
template <typename Scalar>
std::vector<Place>
samplesOf(const BasicPointView<Scalar>& points)
{
  constexpr std::size_t MOST = 4096;
  const std::size_t n = countOf(points);
  // Steps of the golden section: the rows of an organized cloud have no say.
  auto step = std::max<std::size_t>(
      1, static_cast<std::size_t>(0.6180339887 * static_cast<double>(n)));
  while (std::gcd(step, n) > 1)
    ++step;
  std::vector<Place> samples;
  for (std::size_t k = 0; k < std::min(n, MOST); ++k) {
    const Scalar* point = pointOf(points, k * step % n);
    if (isFinite(point))
      samples.emplace_back(point[0], point[1], point[2]);
  }
  return samples;
}

bool
comesFirst(const Place& a, const Place& b)
{
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/** \brief Points in one place that are too many to be a surface's. */
constexpr std::size_t FEWEST = 100;

/** \brief Places where many of the samples lie.
 * \param[in] points number of points that the samples stand for */
std::vector<Place>
crowdedPlaces(std::vector<Place> samples, std::size_t points)
{
  // One in 250 and a hundred in all: what a sensor measures hardly ever meets itself.
  const std::size_t hundred =
      FEWEST * samples.size() / std::max<std::size_t>(1, points);
  const std::size_t many = std::max({std::size_t{16}, hundred, samples.size() / 250});
  std::sort(samples.begin(), samples.end(), comesFirst);
  std::vector<Place> places;
  for (std::size_t begin = 0; begin < samples.size();) {
    std::size_t end = begin;
    while (end < samples.size() && samples[end] == samples[begin])
      ++end;
    if (end - begin >= many)
      places.push_back(samples[begin]);
    begin = end;
  }
  // Where there are many, points were put there on purpose: on a coarse grid.
  constexpr std::size_t MOST = 4;
  if (places.size() > MOST)
    places.clear();
  return places;
}

/** \brief The box beyond which nothing can belong to the samples. */
struct Reach {
  Place middle = Place::Zero();
  double farthest = 0;

  bool
  holds(const Place& place) const
  {
    return (place - middle).cwiseAbs().maxCoeff() <= farthest;
  }
};

double
quantile(std::vector<double>& values, double share)
{
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(
                                       share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Reach
reachOf(const std::vector<Place>& samples, const std::vector<Place>& crowded)
{
  // No sensor sees details and what lies a thousand times as far as nine in ten of them.
  constexpr double ORDERS_OF_MAGNITUDE = 1000, MOST = 0.9;
  std::vector<Place> places;
  for (const Place& sample : samples)
    if (std::find(crowded.begin(), crowded.end(), sample) == crowded.end())
      places.push_back(sample);
  Reach reach{Place::Zero(), std::numeric_limits<double>::infinity()};
  if (places.empty())
    return reach;
  std::vector<double> values(places.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < places.size(); ++i)
      values[i] = places[i][axis];
    reach.middle[axis] = quantile(values, 0.5);
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    values[i] = (places[i] - reach.middle).cwiseAbs().maxCoeff();
  const double extent = quantile(values, MOST);
  if (extent > 0)
    reach.farthest = ORDERS_OF_MAGNITUDE * extent;
  return reach;
}

} // namespace

template <typename Scalar>
LeftOutPoints
findLeftOut(const BasicPointView<Scalar>& points, std::vector<std::int32_t>& kept)
{
  const std::vector<Place> samples = samplesOf(points);
  if (samples.size() < FEWEST)
    return {};
  const std::vector<Place> crowded = crowdedPlaces(samples, countOf(points));
  const Reach reach = reachOf(samples, crowded);
  constexpr std::size_t NO_CROWD = ~std::size_t{0};
  const auto crowdOf = [&](const Place& place) {
    const auto crowd = std::find(crowded.begin(), crowded.end(), place);
    return crowd == crowded.end() ? NO_CROWD
                                  : static_cast<std::size_t>(crowd - crowded.begin());
  };
  const auto belongs = [&](const Scalar* point) {
    // Those that are not finite are left out by everybody, and not counted.
    const Place place(point[0], point[1], point[2]);
    return !isFinite(point) || (reach.holds(place) && crowdOf(place) == NO_CROWD);
  };
  const std::size_t n = countOf(points);
  std::size_t first = 0;
  while (first < n && belongs(pointOf(points, first)))
    ++first;
  if (first == n)
    return {};

  LeftOutPoints left_out;
  std::vector<std::size_t> crowds(crowded.size(), 0);
  kept.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const Scalar* point = pointOf(points, i);
    if (i < first || belongs(point)) {
      kept.push_back(static_cast<std::int32_t>(indexOf(points, i)));
      continue;
    }
    const std::size_t crowd = crowdOf(Place(point[0], point[1], point[2]));
    if (crowd == NO_CROWD)
      ++left_out.stray;
    else
      ++crowds[crowd];
  }
  left_out.repeated = std::accumulate(crowds.begin(), crowds.end(), std::size_t{0});
  if (!crowds.empty()) {
    const auto largest = std::max_element(crowds.begin(), crowds.end());
    left_out.place = crowded[static_cast<std::size_t>(largest - crowds.begin())];
  }
  return left_out;
}

template LeftOutPoints
findLeftOut(const BasicPointView<float>&, std::vector<std::int32_t>&);
template LeftOutPoints
findLeftOut(const BasicPointView<double>&, std::vector<std::int32_t>&);

} // namespace pcl_flashreg
