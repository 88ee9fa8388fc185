// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What the tests of the evaluation share: a folder of their own, made data sets in it.

#include "io/cloud_io.h"
#include "io/error.h"
#include "io/transform_io.h"
#include "support/made_correspondences.h"
#include "support/program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace pcl_flashreg::evaluate {

namespace fs = std::filesystem;

/** \brief Runs something and returns what the InputError says; empty if there is none. */
template <typename Run>
std::string
complaintOf(Run&& run)
{
  try {
    run();
  }
  catch (const io::InputError& error) {
    return error.what();
  }
  return "";
}

class EvaluateTest : public ProgramTest {
protected:
  static std::string
  matrixText(const Eigen::Isometry3d& T)
  {
    return io::formatTransform({T.linear(), T.translation()});
  }

  /** \brief The bundled indoor pair as fragments 0 (target) and 1 (source) of a scene. */
  void
  writeFragments(const std::string& scene) const
  {
    const fs::path bundled = fs::path(PCL_FLASHREG_SOURCE_DIR) / "data/indoor";
    fs::create_directories(folder_ / scene);
    fs::copy_file(bundled / "target.pcd", folder_ / scene / "cloud_bin_0.pcd");
    fs::copy_file(bundled / "source.pcd", folder_ / scene / "cloud_bin_1.pcd");
  }

  static std::string
  bundledPose()
  {
    std::ifstream stream(std::string(PCL_FLASHREG_SOURCE_DIR) +
                         "/data/indoor/T_target_source.txt");
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  /** \brief Made correspondences in MAC's layout: pair k of the folder from seed k.
   * \param[in] hopeless pairs from the first one on that have no right correspondence
   */
  void
  writeMacFolder(const std::string& scene,
                 std::size_t pairs,
                 std::size_t size,
                 std::size_t hopeless = 0) const
  {
    for (std::size_t k = 0; k < pairs; ++k) {
      made::Recipe recipe;
      recipe.size = size;
      recipe.inlier_ratio = k < hopeless ? 0 : 0.1;
      recipe.seed = k + 1;
      const made::Correspondences made = made::make(recipe);
      std::ostringstream rows;
      rows.precision(9);
      for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          rows << made.source[3 * i + axis] << ' ';
        for (std::size_t axis = 0; axis < 3; ++axis)
          rows << made.target[3 * i + axis] << (axis < 2 ? ' ' : '\n');
      }
      const std::string name = scene + "/cloud_bin_" + std::to_string(100 + k) +
                               "+cloud_bin_" + std::to_string(101 + k);
      write(name + "@corr.txt", rows.str());
      write(name + "@GTmat.txt", matrixText(made.T_target_source));
      write(name + "@label.txt", "0\n");
    }
  }
};

} // namespace pcl_flashreg::evaluate
