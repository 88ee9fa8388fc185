// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_localize: where in a map scans were made.

#include "../io/file.h"
#include "../io/transform_io.h"
#include "../program/output_paths.h"
#include "../program/program.h"
#include "index_stamp.h"
#include "input_scan.h"
#include "locator.h"
#include "map_index.h"
#include "places_picture.h"
#include "report.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <iostream>

namespace pcl_flashreg::localize {
namespace {

using program::Messages;
using program::ScanFile;

/** \brief Exit statuses beside those of program::run(). */
enum Verdict { TRUSTED = 0, NOT_TRUSTED = 1 };

std::vector<std::string>
pathsOf(const std::vector<ScanFile>& files)
{
  std::vector<std::string> paths;
  for (const ScanFile& file : files)
    paths.push_back(file.path);
  return paths;
}

void
checkOutputs(const Options& options, const std::vector<ScanFile>& files)
{
  std::vector<std::string> inputs = pathsOf(files);
  inputs.insert(inputs.end(),
                {options.map, options.list, options.guess_file, options.sequence});
  std::vector<std::string> outputs{options.poses, options.picture, options.index};
  if (!options.index.empty())
    outputs.push_back(stampPathOf(options.index));
  program::checkOutputPaths(outputs, inputs);
}

void
writeLine(const program::Json& json)
{
  if (!(std::cout << program::lineOf(json) << std::flush))
    throw std::runtime_error("standard output: cannot be written");
}

void
tell(const Located& located,
     const Options& options,
     double spacing,
     const Messages& messages)
{
  if (located.error.empty())
    messages.tell(formatPlace(located, options, spacing));
  else
    std::cerr << "pcl_flashreg_localize: error: " << located.error << std::endl;
}

void
writePicture(const Options& options, const Scan& map, const std::vector<Located>& all)
{
  std::vector<DrawnPlace> places;
  for (const Located& located : all)
    if (located.hasPose())
      places.push_back({located.file.name, located.T_map_scan(), located.isTrusted()});
  const std::string caption = formatCaption(all);
  writePlacesPicture(options.picture, {map, places, caption});
}

int
statusOf(const std::vector<Located>& all)
{
  int status = TRUSTED;
  for (const Located& located : all) {
    if (!located.error.empty())
      return program::FAILURE;
    if (!located.isTrusted())
      status = NOT_TRUSTED;
  }
  return status;
}

std::vector<Located>
locateEach(const std::vector<ScanFile>& files,
           Locator& locator,
           const Options& options,
           const Messages& messages)
{
  std::vector<Located> all;
  for (const ScanFile& file : files) {
    all.push_back(locator.locate(file));
    writeLine(jsonOf(all.back()));
    tell(all.back(), options, locator.map().scan().spacing(), messages);
  }
  return all;
}

/** \brief What is said of a scan of a sequence has to wait for the others. */
std::vector<Located>
locateTogether(const std::vector<ScanFile>& files,
               Locator& locator,
               const Options& options,
               const Messages& messages)
{
  const double spacing = locator.map().scan().spacing();
  std::vector<Located> all;
  const LocatedSequence sequence = locateSequence(options, files, locator, all);
  for (const Located& located : all) {
    writeLine(jsonOf(located));
    tell(located, options, spacing, messages);
  }
  writeLine(jsonOf(sequence));
  messages.tell(formatSequence(sequence, options, spacing));
  return all;
}

/** \brief Before the map is read, which may take long. */
void
checkSequence(const Options& options, const std::vector<ScanFile>& files)
{
  if (options.sequence.empty())
    return;
  if (files.size() < 2)
    throw UsageError("--sequence: a sequence has two scans or more");
  sequencePoses(options, files);
}

int
run(const Options& options)
{
  const Messages messages("pcl_flashreg_localize", options.quiet);
  const std::vector<ScanFile> files =
      program::findScans(options.scans, options.list, program::ScanOrder::AsGiven);
  checkOutputs(options, files);
  checkSequence(options, files);
  std::optional<RigidTransform> guess = options.guess;
  if (!options.guess_file.empty())
    guess = io::parseFile(options.guess_file, io::parseTransform);
  PairRegistration registration(options.backend, options.threads);
  const auto resolution = [&] {
    messages.say("estimating the resolution");
    return resolutionOfFirst(pathsOf(files), options.bin_fields);
  };
  const ScanIndex map = openMap(options, resolution, registration, messages);

  Locator locator(options, guess, map, registration);
  const std::vector<Located> all =
      options.sequence.empty() ? locateEach(files, locator, options, messages)
                               : locateTogether(files, locator, options, messages);
  if (all.size() > 1)
    messages.tell(formatTotal(all));
  if (!options.poses.empty())
    io::writeFile(options.poses, formatPoses(all, options.pose_format));
  if (!options.picture.empty())
    writePicture(options, map.scan(), all);
  return statusOf(all);
}

} // namespace
} // namespace pcl_flashreg::localize

int
main(int argc, char** argv)
{
  using namespace pcl_flashreg;
  // PCL's own messages would stand between the user and ours.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  return program::run("pcl_flashreg_localize", [&] {
    const std::optional<localize::Options> options = localize::parseOptions(argc, argv);
    return options ? localize::run(*options) : static_cast<int>(localize::TRUSTED);
  });
}
