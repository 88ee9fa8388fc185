// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "sensors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace pcl_flashreg::generator {
namespace {

using Eigen::Vector3d;

/** \brief True depths of a camera's pixels, 0 where nothing is seen. */
struct DepthImage {
  int columns;
  int rows;
  std::vector<double> depth;

  double
  at(int row, int column) const
  {
    return depth[static_cast<std::size_t>(row) * columns + column];
  }
};

/** \brief Ray of a simulated pixel with depth 1 in the camera frame. */
Vector3d
pixelRay(const DepthCamera& camera, int row, int column)
{
  return {(column * camera.stride - 0.5 * camera.width) / camera.focal_length_px,
          (row * camera.stride - 0.5 * camera.height) / camera.focal_length_px,
          1.0};
}

DepthImage
render(const DepthCamera& camera,
       const Scene& scene,
       const Eigen::Isometry3d& T_world_camera,
       Random& random)
{
  DepthImage image{camera.width / camera.stride, camera.height / camera.stride, {}};
  image.depth.reserve(static_cast<std::size_t>(image.columns) * image.rows);
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      const Vector3d direction =
          T_world_camera.linear() * pixelRay(camera, row, column);
      const auto hit =
          scene.cast(T_world_camera.translation(), direction, 2.0 * camera.max_depth);
      // One draw a pixel, hit or not: a ray that another platform rounds to the other
      // side of an edge doesn't shift what all later pixels draw.
      const double draw = random.uniform();
      const bool seen =
          hit && draw < hit->return_probability &&
          -hit->normal.dot(direction) > camera.grazing_cosine * direction.norm();
      image.depth.push_back(seen ? hit->distance : 0.0);
    }
  }
  return image;
}

/** \brief Depth of the neighbour that differs most; pixels at the border have
 * themselves. */
double
farthestNeighbor(const DepthImage& image, int row, int column)
{
  const double depth = image.at(row, column);
  double farthest = depth;
  constexpr std::array<std::array<int, 2>, 4> steps{
      {{{-1, 0}}, {{1, 0}}, {{0, -1}}, {{0, 1}}}};
  for (const auto& step : steps) {
    const int r = std::clamp(row + step[0], 0, image.rows - 1);
    const int c = std::clamp(column + step[1], 0, image.columns - 1);
    if (std::abs(image.at(r, c) - depth) > std::abs(farthest - depth))
      farthest = image.at(r, c);
  }
  return farthest;
}

/** \brief What the camera reports for a true depth; 0 for nothing. */
double
measure(const DepthCamera& camera, double depth, double neighbor, Random& random)
{
  const double edge_draw = random.uniform();
  const double mix_draw = random.uniform();
  const double noise_draw = random.normal();
  if (depth == 0.0)
    return 0.0;
  if (std::abs(neighbor - depth) > camera.edge_jump * depth) {
    if (edge_draw < camera.edge_dropout)
      return 0.0;
    if (neighbor > 0.0 && edge_draw < camera.edge_dropout + camera.edge_mixing)
      depth += mix_draw * (neighbor - depth);
  }
  if (depth < camera.min_depth || depth > camera.max_depth)
    return 0.0;
  const double sigma =
      camera.noise_floor + camera.noise_growth * (depth - 0.4) * (depth - 0.4);
  const double step = camera.quantisation * depth * depth;
  return std::round((depth + sigma * noise_draw) / step) * step;
}

/** \brief Chance that a lidar gets an echo from a hit. */
double
echoProbability(const Lidar& lidar, const Hit& hit, const Vector3d& direction)
{
  if (-hit.normal.dot(direction) < lidar.grazing_cosine)
    return 0.0;
  const double far_share = hit.distance / lidar.max_range;
  const double lost =
      lidar.dropout_near + (lidar.dropout_far - lidar.dropout_near) * far_share;
  return hit.return_probability * (1.0 - lost);
}

} // namespace

Points
capture(const DepthCamera& camera,
        const Scene& scene,
        const Eigen::Isometry3d& T_world_camera,
        Random& random)
{
  const DepthImage image = render(camera, scene, T_world_camera, random);
  Points points;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      const double depth = measure(
          camera, image.at(row, column), farthestNeighbor(image, row, column), random);
      if (depth > 0.0)
        points.emplace_back((depth * pixelRay(camera, row, column)).cast<float>());
    }
  }
  return points;
}

Points
capture(const Lidar& lidar,
        const Scene& scene,
        const Eigen::Isometry3d& T_world_lidar,
        Random& random)
{
  const int columns = static_cast<int>(std::lround(360.0 / lidar.azimuth_step_deg));
  const double elevation_step =
      (lidar.max_elevation_deg - lidar.min_elevation_deg) / (lidar.rings - 1);
  Points points;
  for (int ring = 0; ring < lidar.rings; ++ring) {
    const double elevation = (lidar.min_elevation_deg + ring * elevation_step) * degree;
    for (int column = 0; column < columns; ++column) {
      const double azimuth = column * 360.0 / columns * degree;
      const Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                         std::cos(elevation) * std::sin(azimuth),
                         std::sin(elevation));
      const Vector3d direction = T_world_lidar.linear() * ray;
      const auto hit =
          scene.cast(T_world_lidar.translation(), direction, lidar.max_range);
      // The same number of draws for each ray, for the reason given in render().
      const double echo_draw = random.uniform();
      const double noise = lidar.range_noise * random.normal();
      if (!hit || hit->distance < lidar.min_range ||
          echo_draw >= echoProbability(lidar, *hit, direction))
        continue;
      points.emplace_back(((hit->distance + noise) * ray).cast<float>());
    }
  }
  return points;
}

Points
thin(const Points& points, float cell_size, std::size_t min_points)
{
  using Cell = std::array<std::int32_t, 3>;
  std::vector<std::pair<Cell, std::size_t>> cells;
  cells.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] = static_cast<std::int32_t>(std::floor(points[i][axis] / cell_size));
    cells.emplace_back(cell, i);
  }
  std::sort(cells.begin(), cells.end());

  Points thinned;
  for (std::size_t first = 0; first < cells.size();) {
    Vector3d sum = Vector3d::Zero();
    std::size_t last = first;
    for (; last < cells.size() && cells[last].first == cells[first].first; ++last)
      sum += points[cells[last].second].cast<double>();
    if (last - first >= min_points)
      thinned.emplace_back((sum / static_cast<double>(last - first)).cast<float>());
    first = last;
  }
  return thinned;
}

} // namespace pcl_flashreg::generator
