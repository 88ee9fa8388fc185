// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan_pair.h"

#include "scenes.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace pcl_flashreg::generator {
namespace {

/** \brief Which stream of the seed each random thing has. */
enum Stream : std::uint64_t {
  scene_stream,
  viewpoint_stream,
  source_stream,
  target_stream
};

using Eigen::Vector3d;

/** \brief World from camera, for a camera at one point that looks at another. */
Eigen::Isometry3d
lookAt(const Vector3d& eye, const Vector3d& focus)
{
  const Vector3d forward = (focus - eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << right, forward.cross(right), forward;
  pose.translation() = eye;
  return pose;
}

Vector3d
jitter(Random& random, double scale)
{
  const double x = random.uniform(-scale, scale);
  const double y = random.uniform(-scale, scale);
  const double z = random.uniform(-scale, scale);
  return {x, y, z};
}

/** \brief Images along a short arc around T_world_fragment, fused in that camera's
 * frame, as a person makes a fragment with a camera in the hand. */
Points
captureFragment(const Scene& room,
                const Eigen::Isometry3d& T_world_fragment,
                Random& random)
{
  constexpr int images = 9;
  constexpr float cell_size = 0.025f;
  constexpr std::size_t min_points = 3;
  const DepthCamera camera;
  Points fused;
  for (int i = 0; i < images; ++i) {
    const double along = 2.0 * i / (images - 1) - 1.0;
    Eigen::Isometry3d T_fragment_camera = Eigen::Isometry3d::Identity();
    T_fragment_camera.translate(Vector3d(0.2 * along, 0, 0) + jitter(random, 0.04));
    T_fragment_camera.rotate(Eigen::AngleAxisd(9 * degree * along, Vector3d::UnitY()));
    T_fragment_camera.rotate(
        Eigen::AngleAxisd(random.uniform(-5.0, 5.0) * degree, Vector3d::UnitX()));
    for (const auto& point :
         capture(camera, room, T_world_fragment * T_fragment_camera, random))
      fused.emplace_back((T_fragment_camera * point.cast<double>()).cast<float>());
  }
  return thin(fused, cell_size, min_points);
}

ScanPair
makeIndoorPair(std::uint64_t seed)
{
  Random scene_random(seed, scene_stream);
  Random viewpoint(seed, viewpoint_stream);
  Random source_random(seed, source_stream);
  Random target_random(seed, target_stream);
  const Scene room = makeRoom(scene_random);
  const Vector3d source_eye = Vector3d(4.1, 1.7, 1.5) + jitter(viewpoint, 0.1);
  const Vector3d target_eye = Vector3d(2.3, 1.6, 1.45) + jitter(viewpoint, 0.1);
  const auto T_world_source =
      lookAt(source_eye, Vector3d(2.9, 4.2, 0.75) + jitter(viewpoint, 0.1));
  const auto T_world_target =
      lookAt(target_eye, Vector3d(3.9, 4.2, 0.75) + jitter(viewpoint, 0.1));
  return {captureFragment(room, T_world_source, source_random),
          captureFragment(room, T_world_target, target_random),
          T_world_target.inverse() * T_world_source};
}

/** \brief World from lidar for a car on the street, its lidar 1.73 m above the road;
 * the suspension gives a little. */
Eigen::Isometry3d
onStreet(double x, double y, double yaw, Random& random)
{
  Eigen::Isometry3d pose(
      Eigen::AngleAxisd(-std::atan(street_slope), Vector3d::UnitY()));
  pose.translate(Vector3d(x, y, 1.73) + jitter(random, 0.03));
  pose.rotate(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
  pose.rotate(Eigen::AngleAxisd(random.uniform(-1.0, 1.0) * degree, Vector3d::UnitY()));
  pose.rotate(Eigen::AngleAxisd(random.uniform(-1.0, 1.0) * degree, Vector3d::UnitX()));
  return pose;
}

ScanPair
makeStreetPair(std::uint64_t seed)
{
  Random scene_random(seed, scene_stream);
  Random viewpoint(seed, viewpoint_stream);
  Random source_random(seed, source_stream);
  Random target_random(seed, target_stream);
  const Scene street = makeStreet(scene_random);
  const auto T_world_source = onStreet(5.0, -1.0, 20.0 * degree, viewpoint);
  const auto T_world_target = onStreet(-5.0, -1.5, 1.5 * degree, viewpoint);
  const Lidar lidar;
  return {capture(lidar, street, T_world_source, source_random),
          capture(lidar, street, T_world_target, target_random),
          T_world_target.inverse() * T_world_source};
}

} // namespace

ScanPair
makeScanPair(const std::string& scene, std::uint64_t seed)
{
  if (scene == "indoor")
    return makeIndoorPair(seed);
  if (scene == "street")
    return makeStreetPair(seed);
  throw std::invalid_argument("scene is \"" + scene +
                              "\"; known are indoor and street");
}

} // namespace pcl_flashreg::generator
