// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/estimator.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <vector>

namespace pcl_flashreg {
namespace made {

/** \brief A small generator that gives the same numbers with every standard library
 * (SplitMix64, Steele, Lea and Flood 2014). */
class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t
  next()
  {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }

  /** \brief Uniform in [low, high). */
  double
  uniform(double low, double high)
  {
    return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53);
  }

  Eigen::Vector3d
  inCube(double side)
  {
    const double x = uniform(0, side), y = uniform(0, side), z = uniform(0, side);
    return {x, y, z};
  }

  /** \brief Mean 0, standard deviation 1. */
  double
  normal()
  {
    const double radius = std::sqrt(-2 * std::log(uniform(1e-300, 1)));
    return radius * std::cos(uniform(0, 2 * 3.14159265358979323846));
  }

  Eigen::Isometry3d
  pose(double reach)
  {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    const double w = normal(), x = normal(), y = normal(), z = normal();
    T.linear() = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
    T.translation() = inCube(reach);
    return T;
  }

private:
  std::uint64_t state_;
};

/** \brief How correspondences are made. */
struct Recipe {
  std::size_t size = 1000;
  double inlier_ratio = 0.05;
  /** \brief Side of the cube that points are uniform in. */
  double side = 3.0;
  /** \brief Standard deviation of an inlier's target coordinates. */
  double noise = 0.002;
  std::uint64_t seed = 1;
};

/** \brief Correspondences with a known pose; inliers lie scattered among the others. */
struct Correspondences {
  std::vector<double> source, target;
  std::vector<char> is_inlier;
  Eigen::Isometry3d T_target_source;

  CorrespondenceView<double>
  view() const
  {
    return {source.data(), target.data(), source.size() / 3, nullptr};
  }
};

inline Correspondences
make(const Recipe& recipe)
{
  Random random(recipe.seed);
  Correspondences made;
  made.T_target_source = random.pose(recipe.side);
  for (std::size_t i = 0; i < recipe.size; ++i) {
    const Eigen::Vector3d source = random.inCube(recipe.side);
    const bool inlier = random.uniform(0, 1) < recipe.inlier_ratio;
    Eigen::Vector3d target = made.T_target_source * random.inCube(recipe.side);
    if (inlier) {
      const double x = random.normal(), y = random.normal(), z = random.normal();
      target = made.T_target_source * source + recipe.noise * Eigen::Vector3d(x, y, z);
    }
    made.source.insert(made.source.end(), source.data(), source.data() + 3);
    made.target.insert(made.target.end(), target.data(), target.data() + 3);
    made.is_inlier.push_back(inlier);
  }
  return made;
}

/** \brief Angle between two rotations in degrees. */
inline double
rotationError(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b)
{
  return Eigen::AngleAxisd(a.transpose() * b).angle() * 180 / 3.14159265358979323846;
}

} // namespace made
} // namespace pcl_flashreg
