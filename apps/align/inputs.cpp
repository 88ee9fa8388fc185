// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "inputs.h"

#include "../io/cloud_io.h"
#include "../io/error.h"
#include "../io/file.h"
#include "../io/scan_input.h"
#include "../io/transform_io.h"

#include <pcl_flashreg/pair_registration.h>

namespace pcl_flashreg::align {
namespace {

using io::InputError;

io::Cloud
readCloud(const std::string& path, std::size_t bin_fields, const Progress& progress)
{
  io::Cloud cloud = io::readCloud(path, bin_fields);
  for (const std::string& note : cloud.notes)
    progress.note(path + ": " + note);
  return cloud;
}

InputCloud
readInputCloud(const std::string& path,
               const Options& options,
               const Progress& progress)
{
  progress.say("reading " + path);
  InputCloud input;
  input.path = path;
  input.cloud = readCloud(path, options.bin_fields, progress);
  try {
    input.xyz = io::coordinates(input.cloud);
  }
  catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
  return input;
}

/** \brief Three finite points, not all in one place, are the least to find a pose from.
 */
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

io::NumberTable
readTable(const std::string& path)
{
  return io::parseFile(path, io::parseNumberTable);
}

io::Correspondences
readCorrespondences(const std::vector<std::string>& paths, const Inputs& inputs)
{
  const io::NumberTable first = readTable(paths[0]);
  std::string at = paths[0];
  try {
    if (paths.size() == 2) {
      const io::NumberTable second = readTable(paths[1]);
      at = paths[0] + "," + paths[1];
      return io::fromPointTables(first, second);
    }
    if (io::formOf(first) == io::CorrespondenceForm::Coordinates)
      return io::fromCoordinates(first);
    if (!inputs.source || !inputs.target)
      throw UsageError(paths[0] + ": index pairs need the source and the target cloud");
    return io::fromIndices(first, inputs.source->xyz, inputs.target->xyz);
  }
  catch (const InputError& error) {
    throw InputError(at + ": " + error.what());
  }
}

/** \brief The field that is a descriptor: the one with the most float32 values. */
const io::Field*
descriptorField(const io::Cloud& cloud)
{
  const io::Field* best = nullptr;
  for (const io::Field& field : cloud.fields)
    if (field.type == io::ScalarType::Float32 && field.count > 1 &&
        (best == nullptr || field.count > best->count))
      best = &field;
  return best;
}

InputFeatures
readFeatures(const std::string& path, const InputCloud& input, const Progress& progress)
{
  const io::Cloud cloud = readCloud(path, 0, progress);
  const io::Field* field = descriptorField(cloud);
  if (field == nullptr)
    throw InputError(path +
                     ": has no field of descriptors (FPFH is 33 float32 values)");
  if (cloud.size() != input.cloud.size())
    throw InputError(path + ": has " + std::to_string(cloud.size()) +
                     " descriptors, but " + input.path + " has " +
                     std::to_string(input.cloud.size()) + " points");
  InputFeatures features;
  features.dimension = field->count;
  features.values.reserve(cloud.size() * field->count);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    for (std::size_t k = 0; k < field->count; ++k)
      features.values.push_back(
          static_cast<float>(io::loadValue(cloud.point(i), *field, k)));
  return features;
}

} // namespace

double
resolutionOf(const InputCloud& cloud)
{
  const ScanInput<double> input = io::scanInput(cloud.cloud, cloud.xyz);
  return PairRegistration(BackendKind::Cpu, 1).chooseResolution(input, input);
}

Inputs
readInputs(const Options& options, const Progress& progress)
{
  Inputs inputs;
  if (!options.guess.empty())
    inputs.guess = io::parseFile(options.guess, io::parseTransform);
  if (!options.source.empty())
    inputs.source = readInputCloud(options.source, options, progress);
  if (!options.target.empty())
    inputs.target = readInputCloud(options.target, options, progress);
  if (!options.correspondences.empty()) {
    inputs.correspondences = readCorrespondences(options.correspondences, inputs);
    return inputs;
  }
  checkPoints(*inputs.source);
  checkPoints(*inputs.target);
  if (!options.features.empty()) {
    inputs.source_features =
        readFeatures(options.features[0], *inputs.source, progress);
    inputs.target_features =
        readFeatures(options.features[1], *inputs.target, progress);
    if (inputs.source_features->dimension != inputs.target_features->dimension)
      throw InputError(options.features[1] +
                       ": its descriptors have another length than "
                       "those of " +
                       options.features[0]);
  }
  return inputs;
}

} // namespace pcl_flashreg::align
