// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "options.h"

#include "../io/cloud_io.h"
#include "../program/command_line.h"
#include "../program/output_paths.h"
#include "../program/shared_options.h"
#include "option_groups.h"
#include "snapshot.h"
#include "viewer.h"

#include <pcl_flashreg/estimator.h>

#include <cmath>
#include <filesystem>

namespace pcl_flashreg::align {
namespace {

constexpr const char* kDescription = "Finds the rigid transform that maps the source "
                                     "cloud onto the target cloud, with no\n"
                                     "initial guess, and says whether to trust it.\n";

constexpr const char* kFooter = R"(
Examples:
  pcl_flashreg_align scan1.pcd scan2.pcd
      prints the pose of scan1 in the frame of scan2, and the verdict
  pcl_flashreg_align scan1.ply scan2.ply aligned.ply --leaf 0.05 --snapshot pair.png
      5 cm voxels; writes the aligned cloud, and a picture of the pair before and after
  pcl_flashreg_align 000010.bin 000000.bin --leaf 0.3 --quiet --json -
      two KITTI scans; only JSON on standard output
  pcl_flashreg_align --correspondences pairs.txt --leaf 0.3 --transform pose.txt
      from correspondences alone, of clouds thinned to 30 cm
  pcl_flashreg_align src.pcd tgt.pcd out.pcd --correspondences src.txt,tgt.txt
      from correspondences; the clouds are there for the aligned output

Clouds: .pcd, .ply (vertices; the camera is the VIEWPOINT), raw .bin (rows of float32, as
KITTI's x y z intensity, nuScenes' x y z intensity ring, and others). The aligned cloud
keeps all fields of the source, and has the VIEWPOINT of the target, whose frame it is in.

Exit status: 0 a pose was found and is trusted; 1 no trusted pose; 2 wrong usage;
3 an input file or the machine is at fault.)";

std::vector<std::string>
splitPair(const std::string& text, const std::string& option)
{
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || comma == 0 || comma + 1 == text.size() ||
      text.find(',', comma + 1) != std::string::npos)
    throw UsageError(option + ": expected two files, SRC,TGT, found '" + text + "'");
  return {text.substr(0, comma), text.substr(comma + 1)};
}

void
takeWords(const Words& words, Options& options)
{
  options.parameters.second_order = kSecondOrders.at(words.second_order);
  options.parameters.score_metric = kScores.at(words.score);
  options.backend = program::BACKENDS.at(words.backend);
  program::takeMotion(words.motion, options.parameters);
  const std::string& unknown = words.no_viewpoint;
  options.source_viewpoint_known = unknown.empty() || unknown == "target";
  options.target_viewpoint_known = unknown.empty() || unknown == "source";
  if (words.features == "pcl")
    options.pcl_features = true;
  else if (!words.features.empty() && words.features != "native")
    options.features = splitPair(words.features, "--features");
  if (words.correspondences.empty())
    return;
  // A comma may belong to the name of one file.
  if (words.correspondences.find(',') == std::string::npos ||
      std::filesystem::exists(words.correspondences))
    options.correspondences = {words.correspondences};
  else
    options.correspondences = splitPair(words.correspondences, "--correspondences");
}

/** \brief "--no-viewpoint source" as one word: an option whose value may be left out would
 * take the path behind it. */
std::vector<std::string>
joinedViewpoints(std::vector<std::string> arguments)
{
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i)
    if (arguments[i] == "--no-viewpoint" &&
        (arguments[i + 1] == "source" || arguments[i + 1] == "target")) {
      arguments[i] += "=" + arguments[i + 1];
      arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
  return arguments;
}

/** \brief What CLI11 can't know. */
void
check(const Options& options)
{
  const bool from_correspondences = !options.correspondences.empty();
  if (!from_correspondences && options.target.empty())
    throw UsageError("a source and a target cloud are needed (--help tells more)");
  if (!options.output.empty() && !io::isWritableCloudPath(options.output))
    throw UsageError(options.output + ": clouds are written as .pcd or .ply");
  if (from_correspondences && !options.features.empty())
    throw UsageError("--correspondences and --features exclude each other");
  if (options.leaf && !(*options.leaf > 0 && std::isfinite(*options.leaf)))
    throw UsageError("--leaf: the voxel size must be a length > 0");
  if ((!options.snapshot.empty() || options.view) && options.target.empty())
    throw UsageError("--snapshot and --view need the source and the target cloud");
  if (!options.snapshot.empty() && !kSnapshotBuiltIn)
    throw UsageError("--snapshot is not built into this program (Cairo was not found "
                     "when it was built)");
  if (options.view && !kViewerBuiltIn)
    throw UsageError("--view is not built into this program (no PCL visualization was "
                     "found when it was built)");
  try {
    options.pairOptions().parametersFor(options.leaf.value_or(0)).validate();
  }
  catch (const std::invalid_argument& error) {
    throw UsageError(program::asOption(error.what()));
  }
  if (options.view)
    requireDisplay();
}

std::vector<std::string>
inputPaths(const Options& options)
{
  std::vector<std::string> paths = {options.source, options.target, options.guess};
  for (const auto& more : {options.correspondences, options.features})
    paths.insert(paths.end(), more.begin(), more.end());
  return paths;
}

} // namespace

PairOptions
Options::pairOptions() const
{
  PairOptions result;
  result.resolution = leaf;
  result.parameters = parameters;
  result.length_tolerance = length_tolerance;
  result.min_length_sum = min_length_sum;
  result.inlier_distance = inlier_distance;
  result.neighbors = neighbors;
  result.mutual = mutual;
  result.cloud_check = !fast;
  result.second_look = second_look;
  return result;
}

std::optional<Options>
parseOptions(int argc, char** argv)
{
  const std::vector<std::string> arguments = joinedViewpoints({argv, argv + argc});
  std::vector<const char*> words_given;
  for (const std::string& argument : arguments)
    words_given.push_back(argument.c_str());
  Options options;
  Words words;
  CLI::App app(kDescription, "pcl_flashreg_align");
  app.set_version_flag("--version", std::string("pcl_flashreg_align ") + version());
  app.footer(kFooter);
  addOptions(app, options, words);
  if (!program::parse(app, static_cast<int>(words_given.size()), words_given.data()))
    return std::nullopt;
  takeWords(words, options);
  check(options);
  program::checkOutputPaths(
      {options.output, options.transform, options.json, options.snapshot},
      inputPaths(options));
  return options;
}

} // namespace pcl_flashreg::align
