// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "input_cloud.h"

#include "cloud_io.h"
#include "error.h"
#include "scan_input.h"

#include <pcl_flashreg/pair_registration.h>

namespace pcl_flashreg::io {

InputCloud
readInputCloud(const std::string& path, std::size_t raw_row_length)
{
  InputCloud input;
  input.path = path;
  input.cloud = readCloud(path, raw_row_length);
  try {
    input.xyz = coordinates(input.cloud);
  }
  catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
  return input;
}

void
checkPoints(const InputCloud& input)
{
  std::size_t finite = 0;
  Eigen::Vector3d first;
  bool apart = false;
  for (const auto& p : input.xyz.colwise()) {
    if (!p.allFinite())
      continue;
    if (finite++ == 0)
      first = p;
    apart = apart || p != first;
  }
  const std::string of =
      " of its " + std::to_string(input.xyz.cols()) + " points have finite coordinates";
  if (finite == 0)
    throw InputError(input.path + ": none" + of);
  if (finite < 3)
    throw InputError(input.path + ": only " + std::to_string(finite) + of +
                     ", 3 are needed at least");
  if (!apart)
    throw InputError(input.path + ": all its points lie in one place");
}

double
resolutionOf(const InputCloud& input)
{
  const ScanInput<double> scan = scanInput(input.cloud, input.xyz);
  return PairRegistration(BackendKind::Cpu, 1).chooseResolution(scan, scan);
}

} // namespace pcl_flashreg::io
