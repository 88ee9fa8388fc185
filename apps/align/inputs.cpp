// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "inputs.h"

#include "../io/cloud_io.h"
#include "../io/error.h"
#include "../io/file.h"
#include "../io/transform_io.h"

namespace pcl_flashreg::align {
namespace {

using io::InputError;

void
passOnNotes(const std::string& path, const io::Cloud& cloud, const Messages& messages)
{
  for (const std::string& note : cloud.notes)
    messages.note(path + ": " + note);
}

InputCloud
readInputCloud(const std::string& path,
               const Options& options,
               const Messages& messages)
{
  messages.say("reading " + path);
  InputCloud input = io::readInputCloud(path, options.bin_fields);
  passOnNotes(path, input.cloud, messages);
  return input;
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
readFeatures(const std::string& path, const InputCloud& input, const Messages& messages)
{
  const io::Cloud cloud = io::readCloud(path);
  passOnNotes(path, cloud, messages);
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

Inputs
readInputs(const Options& options, const Messages& messages)
{
  Inputs inputs;
  if (!options.guess.empty())
    inputs.guess = io::parseFile(options.guess, io::parseTransform);
  if (!options.source.empty())
    inputs.source = readInputCloud(options.source, options, messages);
  if (!options.target.empty())
    inputs.target = readInputCloud(options.target, options, messages);
  if (!options.correspondences.empty()) {
    inputs.correspondences = readCorrespondences(options.correspondences, inputs);
    return inputs;
  }
  io::checkPoints(*inputs.source);
  io::checkPoints(*inputs.target);
  if (!options.features.empty()) {
    inputs.source_features =
        readFeatures(options.features[0], *inputs.source, messages);
    inputs.target_features =
        readFeatures(options.features[1], *inputs.target, messages);
    if (inputs.source_features->dimension != inputs.target_features->dimension)
      throw InputError(options.features[1] +
                       ": its descriptors have another length than "
                       "those of " +
                       options.features[0]);
  }
  return inputs;
}

} // namespace pcl_flashreg::align
