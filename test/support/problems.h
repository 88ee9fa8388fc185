// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// The table of problems that every backend has to agree on.

#include "support/made_correspondences.h"

#include <limits>
#include <string>
#include <vector>

namespace pcl_flashreg {
namespace made {

/** \brief A problem with a name, and the parameters that suit it. */
struct NamedProblem {
  std::string name;
  Correspondences correspondences;
  Parameters parameters;
};

inline NamedProblem
sized(std::size_t size, double inlier_ratio)
{
  Recipe recipe;
  recipe.size = size;
  recipe.inlier_ratio = inlier_ratio;
  recipe.seed = size + 1;
  return {"n" + std::to_string(size) + "_inliers" +
              std::to_string(static_cast<int>(100 * inlier_ratio)),
          make(recipe),
          {}};
}

/** \brief No two correspondences are compatible: distances grow on one side only. */
inline NamedProblem
emptyGraph()
{
  NamedProblem problem = sized(200, 0);
  for (std::size_t i = 0; i < problem.correspondences.target.size(); ++i)
    problem.correspondences.target[i] = 1000 * problem.correspondences.source[i];
  problem.name = "empty_graph";
  return problem;
}

/** \brief Rows with more neighbours than the bounded layout keeps. */
inline NamedProblem
longRows()
{
  NamedProblem problem = sized(400, 0.9);
  problem.parameters.row_capacity = 20;
  problem.parameters.pool_capacity = 5;
  problem.name = "rows_over_capacity";
  return problem;
}

/** \brief Points on a grid: distances tie by the thousand, and so do scores. */
inline NamedProblem
tiedGrid()
{
  NamedProblem problem{"ties_on_a_grid", {}, {}};
  problem.parameters = Parameters::fromResolution(0.05);
  problem.parameters.pivots = 300;
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 6; ++y)
      for (int z = 0; z < 5; ++z)
        for (const double value : {0.25 * x, 0.25 * y, 0.25 * z}) {
          problem.correspondences.source.push_back(value);
          problem.correspondences.target.push_back(value + 1);
        }
  problem.correspondences.T_target_source =
      Eigen::Isometry3d(Eigen::Translation3d(1, 1, 1));
  problem.correspondences.is_inlier.assign(210, 1);
  return problem;
}

/** \brief Coordinates that are not finite, and duplicates. */
inline NamedProblem
dirty()
{
  NamedProblem problem = sized(300, 0.3);
  std::vector<double>& source = problem.correspondences.source;
  source[3 * 5] = std::numeric_limits<double>::quiet_NaN();
  source[3 * 17 + 1] = std::numeric_limits<double>::infinity();
  problem.correspondences.target[3 * 40 + 2] = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
    source[3 * 100 + k] = source[3 * 99 + k];
  problem.name = "not_finite";
  return problem;
}

/** \brief An extent so large for the tolerance that rounding leaves nearly every pair to
 * the exact test, or puts the filter out of use. */
inline NamedProblem
farApart(double side)
{
  Recipe recipe;
  recipe.size = 300;
  recipe.inlier_ratio = 0.3;
  recipe.side = side;
  NamedProblem problem{
      "side_" + std::to_string(static_cast<long>(side)), make(recipe), {}};
  return problem;
}

/** \brief The same, of an upright motion.
 * \param[in] error of the target's gravity, in degrees
 * \param[in] max_tilt see Parameters */
inline NamedProblem
upright(NamedProblem problem, double error, float max_tilt)
{
  const Eigen::Vector3d source(0.3, -2, 1);
  const Eigen::Vector3d across = source.unitOrthogonal();
  const Eigen::Matrix3d off =
      Eigen::AngleAxisd(error * 3.14159265358979323846 / 180, across)
          .toRotationMatrix();
  const Eigen::Vector3f target =
      (problem.correspondences.T_target_source.linear() * off * source).cast<float>();
  problem.name += "_upright" + std::to_string(static_cast<int>(error));
  problem.parameters.motion = MotionModel::Upright;
  problem.parameters.max_tilt = max_tilt;
  problem.parameters.source_gravity = {0.3f, -2, 1};
  problem.parameters.target_gravity = {target.x(), target.y(), target.z()};
  return problem;
}

inline std::vector<NamedProblem>
problems()
{
  std::vector<NamedProblem> all;
  for (const std::size_t n :
       {0, 1, 2, 3, 4, 31, 32, 33, 63, 64, 65, 127, 128, 129, 511, 512, 513, 1000})
    all.push_back(sized(n, 0.3));
  all.push_back(sized(64, 1));
  all.push_back(sized(700, 1));
  all.push_back(sized(1000, 0.02));
  all.push_back(emptyGraph());
  all.push_back(longRows());
  all.push_back(tiedGrid());
  all.push_back(dirty());
  all.push_back(farApart(300));
  all.push_back(farApart(30000));
  all.push_back(farApart(3e7));
  for (const std::size_t n : {0, 2, 3, 64, 129, 513, 1000})
    all.push_back(upright(sized(n, 0.3), 2, 3));
  all.push_back(upright(sized(700, 1), 1, 0.5f)); // turned back in every stage
  all.push_back(upright(sized(300, 0.9), 20, 15));
  all.push_back(upright(sized(300, 0.9), 180, 30));
  all.push_back(upright(emptyGraph(), 0, 3));
  all.push_back(upright(longRows(), 2, 3));
  all.push_back(upright(tiedGrid(), 3, 2));
  all.push_back(upright(dirty(), 0, 1e-6f));
  all.push_back(upright(farApart(300), 1, 2));
  all.push_back(upright(farApart(30000), 1, 2));
  all.push_back(upright(farApart(3e7), 1, 2));
  return all;
}

} // namespace made
} // namespace pcl_flashreg
