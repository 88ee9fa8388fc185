// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "input_scan.h"

#include "../io/error.h"
#include "../io/file.h"
#include "../io/input_cloud.h"
#include "../io/scan_input.h"
#include "../program/pair_text.h"

#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/impl/stopwatch.hpp>

#include <cmath>
#include <fstream>
#include <optional>

namespace pcl_flashreg::localize {
namespace {

using io::InputError;

/** \brief The least that a trusted pose takes. */
constexpr std::size_t NEEDED = 12;

InputScan
scanOf(const io::InputCloud& input,
       const ScanSettings& settings,
       PairRegistration& registration)
{
  InputScan result;
  result.warnings = input.cloud.notes;
  ScanInput<double> cloud =
      io::scanInput(input.cloud, input.xyz, settings.viewpoint_known);
  cloud.many_viewpoints = settings.many_viewpoints;
  try {
    result.scan = registration.makeScan(cloud, settings.spacing);
  }
  catch (const std::invalid_argument& error) {
    throw InputError(input.path + ": " + error.what());
  }
  const std::string doubt = program::viewpointDoubt(
      result.scan, Eigen::Vector3d(input.cloud.viewpoint.data()));
  if (settings.viewpoint_known && !doubt.empty())
    result.warnings.push_back(doubt);
  return result;
}

Scan
loaded(const std::string& path, const ScanSettings& settings)
{
  constexpr double SAME = 1e-6;
  const Scan scan = loadScan(path);
  if (std::abs(scan.spacing() - settings.spacing) > SAME * settings.spacing)
    throw InputError(path + ": was saved at a resolution of " +
                     detail::toText(scan.spacing()) + ", and is needed at " +
                     detail::toText(settings.spacing));
  return settings.viewpoint_known ? scan : scan.withoutViewpoint();
}

void
requireKeypoints(const std::string& path, const Scan& scan, double spacing)
{
  if (scan.size() >= NEEDED)
    return;
  const std::string left =
      scan.empty() ? "no point" : "only " + std::to_string(scan.size()) + " points";
  throw InputError(
      path + ": the voxel grid of " + detail::toText(spacing) + " leaves " + left +
      " that can be described, while a trusted pose takes " + std::to_string(NEEDED) +
      " (--leaf sets another; are map and scans in the same "
      "unit?)");
}

double
resolutionOf(const std::string& path, std::size_t bin_fields)
{
  if (kindOf(path) == FileKind::Scan)
    return loadScan(path).spacing();
  const io::InputCloud input = io::readInputCloud(path, bin_fields);
  io::checkPoints(input);
  return io::resolutionOf(input);
}

} // namespace

FileKind
kindOf(const std::string& path)
{
  char first[8] = {};
  std::ifstream(path, std::ios::binary).read(first, sizeof(first));
  const std::string_view magic(first, sizeof(first));
  if (magic == "flindex\n")
    return FileKind::Index;
  return magic == "flscan\r\n" ? FileKind::Scan : FileKind::Cloud;
}

Scan
loadScan(const std::string& path)
{
  try {
    const Scan scan = Scan::load(path);
    if (scan.features().dimension > 0)
      return scan;
  }
  catch (const ScanFileError& error) {
    throw InputError(error.what());
  }
  throw InputError(path + ": was saved without descriptors, and can't be matched");
}

InputScan
readScan(const std::string& path,
         const ScanSettings& settings,
         PairRegistration& registration)
{
  const detail::Stopwatch total;
  InputScan result;
  double reading = 0;
  switch (kindOf(path)) {
  case FileKind::Index:
    throw InputError(path + ": is an index, not a scan");
  case FileKind::Scan:
    result.scan = loaded(path, settings);
    reading = total.milliseconds();
    break;
  case FileKind::Cloud: {
    const io::InputCloud input = io::readInputCloud(path, settings.bin_fields);
    io::checkPoints(input);
    reading = total.milliseconds();
    result = scanOf(input, settings, registration);
    break;
  }
  }
  requireKeypoints(path, result.scan, settings.spacing);
  result.reading = reading;
  result.making = total.milliseconds() - reading;
  return result;
}

double
resolutionOfFirst(const std::vector<std::string>& paths, std::size_t bin_fields)
{
  std::optional<std::string> why;
  for (const std::string& path : paths) {
    try {
      return resolutionOf(path, bin_fields);
    }
    catch (const InputError& error) {
      why = why.value_or(error.what());
    }
    catch (const std::invalid_argument& error) {
      why = why.value_or(path + ": " + error.what());
    }
  }
  throw InputError("no scan can be used to tell a resolution: " + why.value_or(""));
}

} // namespace pcl_flashreg::localize
