// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Changes of both clouds of a pair of which it is known what they do to the pose, whatever
// that is: who registers the changed pair has to find the pose so changed, and to trust it
// as before.

#include "support/made_correspondences.h"

#include <pcl_flashreg/pair_registration.h>

#include <cmath>
#include <functional>
#include <vector>

namespace pcl_flashreg {
namespace relations {

using Pose = Eigen::Isometry3d;

/** \brief Points and where the sensor stood. */
struct Cloud {
  std::vector<double> xyz;
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();

  std::size_t
  size() const
  {
    return xyz.size() / 3;
  }

  Eigen::Map<Eigen::Matrix3Xd>
  points()
  {
    return {xyz.data(), 3, static_cast<Eigen::Index>(size())};
  }

  Eigen::Map<const Eigen::Matrix3Xd>
  points() const
  {
    return {xyz.data(), 3, static_cast<Eigen::Index>(size())};
  }

  ScanInput<double>
  input() const
  {
    ScanInput<double> input;
    input.points.data = xyz.data();
    input.points.size = size();
    input.viewpoint = viewpoint;
    input.viewpoint_known = true;
    return input;
  }
};

struct Pair {
  Cloud source, target;
  double resolution = 0;
};

/** \brief A changed pair, and how its pose becomes that of the pair as it was. */
struct Changed {
  Pair pair;
  std::function<Pose(const Pose&)> back = [](const Pose& T) { return T; };
};

inline void
move(Cloud& cloud, const Pose& motion)
{
  cloud.points() = (motion * cloud.points()).eval();
  cloud.viewpoint = motion * cloud.viewpoint;
}

/** \brief Moves each cloud by a motion of its own: T' = B T A^-1. */
inline Changed
moved(const Pair& pair, const Pose& A, const Pose& B)
{
  Changed changed{pair};
  move(changed.pair.source, A);
  move(changed.pair.target, B);
  changed.back = [=](const Pose& T) { return B.inverse() * T * A; };
  return changed;
}

/** \brief Turned any way, and set off by up to 20 voxels: over their borders. */
inline Changed
turned(const Pair& pair, made::Random& random)
{
  const Pose A = random.pose(20 * pair.resolution);
  return moved(pair, A, random.pose(20 * pair.resolution));
}

inline Changed
shifted(const Pair& pair, made::Random& random)
{
  const auto shift = [&] {
    return Pose(Eigen::Translation3d(random.inCube(20 * pair.resolution)));
  };
  const Pose A = shift();
  return moved(pair, A, shift());
}

/** \brief By a quarter turn about an axis and by whole voxels: voxels become voxels. */
inline Changed
turnedOnGrid(const Pair& pair, made::Random& random)
{
  const auto motion = [&] {
    Pose T = Pose::Identity();
    const int axis = static_cast<int>(random.next() % 3);
    T.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::Unit(axis))
                     .toRotationMatrix()
                     .array()
                     .round();
    for (double& coordinate : T.translation())
      coordinate = pair.resolution * static_cast<double>(random.next() % 64);
    return T;
  };
  const Pose A = motion();
  return moved(pair, A, motion());
}

inline Changed
swapped(const Pair& pair, made::Random&)
{
  return {{pair.target, pair.source, pair.resolution},
          [](const Pose& T) { return T.inverse(); }};
}

inline void
permute(Cloud& cloud, made::Random& random)
{
  for (std::size_t i = cloud.size(); i > 1; --i)
    cloud.points()
        .col(static_cast<Eigen::Index>(i - 1))
        .swap(cloud.points().col(static_cast<Eigen::Index>(random.next() % i)));
}

inline Changed
permuted(const Pair& pair, made::Random& random)
{
  Changed changed{pair};
  permute(changed.pair.source, random);
  permute(changed.pair.target, random);
  return changed;
}

/** \brief The same in another unit. */
inline Changed
scaled(const Pair& pair, double factor)
{
  Changed changed{pair};
  for (Cloud* cloud : {&changed.pair.source, &changed.pair.target}) {
    cloud->points() *= factor;
    cloud->viewpoint *= factor;
  }
  changed.pair.resolution *= factor;
  changed.back = [=](const Pose& T) {
    Pose result = T;
    result.translation() /= factor;
    return result;
  };
  return changed;
}

/** \brief Every point twice. */
inline Changed
doubled(const Pair& pair, made::Random&)
{
  Changed changed{pair};
  for (Cloud* cloud : {&changed.pair.source, &changed.pair.target})
    cloud->xyz.insert(cloud->xyz.end(), cloud->xyz.begin(), cloud->xyz.end());
  return changed;
}

/** \brief Stray points, `far` to ten times as far from the middle of the cloud as its
 * outermost point. */
inline void
addClutter(Cloud& cloud, double far, made::Random& random)
{
  const Eigen::Vector3d middle = cloud.points().rowwise().mean();
  const double reach = (cloud.points().colwise() - middle).colwise().norm().maxCoeff();
  for (int i = 0; i < 30; ++i) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    const Eigen::Vector3d stray = middle + random.uniform(far, 10 * far) * reach *
                                               Eigen::Vector3d(x, y, z).normalized();
    cloud.xyz.insert(cloud.xyz.end(), stray.data(), stray.data() + 3);
  }
}

inline Changed
cluttered(const Pair& pair, double far, made::Random& random)
{
  Changed changed{pair};
  addClutter(changed.pair.source, far, random);
  addClutter(changed.pair.target, far, random);
  return changed;
}

/** \brief How far apart two poses take the points of the source: the mean. */
inline double
displacement(const Cloud& source, const Pose& a, const Pose& b)
{
  return ((a * source.points()) - (b * source.points())).colwise().norm().mean();
}

} // namespace relations
} // namespace pcl_flashreg
