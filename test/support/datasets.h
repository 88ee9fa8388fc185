// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace pcl_flashreg {
namespace datasets {

/** \brief The folder of real data sets: the environment variable PCL_FLASHREG_DATASETS,
 * else the CMake variable, else ../shared/data beside the sources. */
inline std::string
folder()
{
  if (const char* given = std::getenv("PCL_FLASHREG_DATASETS"))
    return given;
  const std::string configured = PCL_FLASHREG_DEFAULT_DATASETS;
  return configured.empty() ? std::string(PCL_FLASHREG_SOURCE_DIR) + "/../shared/data"
                            : configured;
}

inline bool
exists(const std::string& file)
{
  return std::ifstream(folder() + "/" + file).good();
}

/** \brief All numbers of a text file in that folder. */
inline std::vector<double>
readNumbers(const std::string& file)
{
  std::ifstream in(folder() + "/" + file);
  std::vector<double> numbers;
  for (double x; in >> x;)
    numbers.push_back(x);
  return numbers;
}

} // namespace datasets
} // namespace pcl_flashreg

/** \brief Skips a test, and says so, where a data set is absent. */
#define PCL_FLASHREG_NEEDS_DATA(file)                                                  \
  if (!pcl_flashreg::datasets::exists(file))                                           \
  GTEST_SKIP() << "no " << file << " in " << pcl_flashreg::datasets::folder()          \
               << " (set PCL_FLASHREG_DATASETS)"
