// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "provenance.h"

#include <fstream>
#include <thread>

namespace pcl_flashreg::benchmark {

std::string
processorName()
{
  std::string name = "unknown processor";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) {
      name = line.substr(line.find(':') + 2);
      break;
    }
  return name + " x " + std::to_string(std::thread::hardware_concurrency());
}

const char*
buildType()
{
  return PCL_FLASHREG_BUILD;
}

} // namespace pcl_flashreg::benchmark
