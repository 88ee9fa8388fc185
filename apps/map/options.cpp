// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "options.h"

#include "../io/cloud_io.h"
#include "../program/command_line.h"
#include "../program/help_text.h"
#include "../program/motion_options.h"
#include "../program/shared_options.h"
#include "map_picture.h"

#include <pcl_flashreg/estimator.h>

#include <cmath>
#include <filesystem>

namespace fs = std::filesystem;

namespace pcl_flashreg::map {
namespace {

using program::wrapped;

constexpr const char* DESCRIPTION = "Puts scans of one place together to a map, in any "
                                    "order and with no initial guess,\n"
                                    "and says which of them it could not place.\n";

constexpr const char* FOOTER = R"(
Examples:
  pcl_flashreg_map scans/ map.pcd
      one cloud of all scans in the folder; what pairs say is kept in map.pairs.csv
  pcl_flashreg_map scans/ map.ply --leaf 0.05 --poses poses.tum --graph graph.g2o
      5 cm voxels; the trajectory, and the pose graph for other programs
  pcl_flashreg_map scans/*.pcd --output map.pcd
      the scans that the shell names
  pcl_flashreg_map scans/ map.pcd --resume
      goes on with a run that was killed; --add, after more scans were made
  mpirun -n 8 pcl_flashreg_map scans/ map.pcd --threads 1
      eight processes share the pairs; on machines that share no job, run each --shard i/n
      and then --resume where all map.pairs.csv.shard<i> lie

Scans: .pcd, .ply (the camera is the VIEWPOINT), raw .bin (KITTI, nuScenes). They are sorted
by name, scan_2 before scan_10, however they are given. Where nothing ties some scans to the
others there are several maps: map.pcd is the largest, map_2.pcd the next.

Exit status: 0 all scans are in one map; 1 some are not; 2 wrong usage; 3 an input file or
the machine is at fault.)";

/** \brief The options whose text needs a second look once all are parsed. */
struct Words {
  std::vector<std::string> paths;
  std::string format;
  std::string shard;
  bool no_viewpoint = false;
  program::MotionWords motion;
};

void
addInputs(CLI::App& app, Options& options, Words& words)
{
  const std::string group = "Input";
  app.add_option("paths",
                 words.paths,
                 wrapped("Folders of scans, or scans; then the merged cloud to write "
                         "(.pcd, .ply)"))
      ->type_name("");
  app.add_option(
         "--list",
         options.list,
         wrapped("Text file with the path of a scan a line, from the list's folder on"))
      ->type_name("FILE")
      ->group(group);
  app.add_flag("--strict",
               options.strict,
               wrapped("End if a scan can't be used, instead of leaving it out"))
      ->group(group);
  program::addBinFields(app, group, options.bin_fields);
}

void
addOutputs(CLI::App& app, Options& options, Words& words)
{
  const std::string group = "Output";
  const auto add_file = [&](const char* name,
                            std::string& path,
                            const std::string& text,
                            const char* type = "FILE") {
    app.add_option(name, path, wrapped(text))->type_name(type)->group(group);
  };
  add_file("--output,-o",
           options.output,
           "The merged cloud: then all paths are scans",
           "MAP");
  app.add_option(
         "--map-leaf",
         options.map_leaf,
         wrapped("Voxels of the merged cloud, a point each (default: as --leaf)"))
      ->type_name("LENGTH")
      ->group(group);
  add_file(
      "--poses",
      options.poses,
      "Poses of the scans: .tum or .txt (number, translation, quaternion x y z w), "
      ".kitti (3 x 4 matrices), .csv (names, groups, confidences), .json "
      "(everything). The first two have a file a map");
  program::addPoseFormat(app, group, words.format);
  add_file("--graph",
           options.graph,
           "The pose graph: VERTEX_SE3:QUAT and EDGE_SE3:QUAT",
           "FILE.g2o");
  add_file("--picture",
           options.picture,
           "The maps from above, each scan in its color; needs no display",
           "FILE.png");
  add_file("--page",
           options.page,
           "What was done, and how far it can be trusted, on a page of Markdown",
           "FILE.md");
  add_file("--json", options.json, "Everything as JSON; - for standard output");
  app.add_flag("--largest-only",
               options.largest_only,
               wrapped("Write the largest map alone, if there are several"))
      ->group(group);
  app.add_flag(
         "--quiet", options.quiet, wrapped("Nothing but errors, and JSON if asked for"))
      ->group(group);
}

void
addMethod(CLI::App& app, Options& options, Words& words)
{
  const std::string group = "How";
  app.add_option("--leaf",
                 options.leaf,
                 wrapped("Resolution: the voxel size, from which all lengths follow "
                         "(default: estimated from the clouds)"))
      ->type_name("LENGTH")
      ->group(group);
  app.add_option("--min-confidence",
                 options.min_confidence,
                 wrapped("A scan is placed if its confidence is at least this"))
      ->type_name("P")
      ->capture_default_str()
      ->group(group);
  app.add_flag("--sequence",
               options.sequence,
               wrapped("The order of the names is that in which the scans were made: "
                       "neighbors are tried in any case"))
      ->group(group);
  app.add_flag(
         "--no-viewpoint",
         words.no_viewpoint,
         wrapped("Sensors did not stand at the VIEWPOINT of their clouds (the "
                 "origin, where a file states none): don't take the space between "
                 "it and the points for empty"))
      ->group(group);
  program::addMotion(app, group, words.motion);
  program::addThreads(app, group, options.threads);
  app.add_option("--low-memory",
                 options.scan_folder,
                 wrapped("Keep scans in files of this folder instead of in memory; "
                         "later runs take them from there"))
      ->type_name("FOLDER")
      ->group(group);
}

void
addLongRuns(CLI::App& app, Options& options, Words& words)
{
  const std::string group = "Long runs";
  app.add_option(
         "--pairs",
         options.pairs,
         wrapped("What pairs of scans say, a row each as they come (default: beside "
                 "the first output, as map.pairs.csv)"))
      ->type_name("FILE")
      ->group(group);
  app.add_flag(
         "--resume",
         options.resume,
         wrapped("Go on with a run that was killed: take the pairs that this file "
                 "has from there"))
      ->group(group);
  app.add_flag(
         "--add", options.add, wrapped("The same, where scans have been added since"))
      ->group(group);
  app.add_option(
         "--shard",
         words.shard,
         wrapped("Only the i-th of n parts of the pairs that are tried first, and no "
                 "map: --resume makes it, once all parts are done"))
      ->type_name("i/n")
      ->group(group);
}

/** \brief Takes the map off the paths, where it is the last of them. */
void
takePaths(const Words& words, Options& options)
{
  options.scans = words.paths;
  const std::size_t least = options.list.empty() ? 2 : 1;
  if (!options.output.empty() || options.scans.size() < least)
    return;
  const std::string last = options.scans.back();
  // Who forgets the map must not lose a scan.
  bool any_folder = false;
  for (const std::string& path : options.scans)
    any_folder = any_folder || fs::is_directory(path);
  if (!io::isWritableCloudPath(last) || fs::is_directory(last))
    throw UsageError(last + ": is no path for the map, a .pcd or .ply file; if it is a "
                            "scan, --output names the map");
  if (fs::exists(last) && !any_folder)
    throw UsageError(last +
                     ": is there already: if it is the map to be written, say "
                     "--output " +
                     last + "; if it is a scan, --output names the map");
  options.output = last;
  options.scans.pop_back();
}

/** \brief The options that were given, with their values. */
std::vector<std::string>
typedOptions(const CLI::App& app)
{
  std::vector<std::string> typed;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_positional())
      continue;
    typed.push_back(option->get_name());
    if (option->get_items_expected_max() > 0)
      typed.back() += ' ' + option->as<std::string>();
  }
  return typed;
}

/** \brief "map.pairs.csv" beside "map.pcd"; nothing if nothing is written. */
std::string
defaultPairs(const Options& options)
{
  for (const std::string& output : {options.output,
                                    options.poses,
                                    options.graph,
                                    options.picture,
                                    options.page,
                                    options.json})
    if (!output.empty() && output != "-")
      return fs::path(output).replace_extension(".pairs.csv").string();
  return "";
}

void
checkLength(const char* option, const std::optional<double>& length)
{
  if (length && !(*length > 0 && std::isfinite(*length)))
    throw UsageError(std::string(option) + ": the voxel size must be a length > 0");
}

/** \brief What CLI11 can't know. */
void
check(const Options& options)
{
  if (options.scans.empty() && options.list.empty())
    throw UsageError("a folder of scans is needed (--help tells more)");
  if (!options.output.empty() && !io::isWritableCloudPath(options.output))
    throw UsageError(options.output + ": clouds are written as .pcd or .ply");
  if (!options.picture.empty() && !kMapPictureBuiltIn)
    throw UsageError("--picture is not built into this program (Cairo was not found "
                     "when it was built)");
  checkLength("--leaf", options.leaf);
  checkLength("--map-leaf", options.map_leaf);
  if (!(options.min_confidence > 0 && options.min_confidence < 1))
    throw UsageError("--min-confidence: must lie between 0 and 1");
  if (options.pairs.empty() && (options.resume || options.add || options.shard))
    throw UsageError("--resume, --add and --shard need an output, or --pairs");
}

} // namespace

MultiviewOptions
Options::multiview() const
{
  MultiviewOptions result;
  result.min_confidence = min_confidence;
  result.sequence = sequence;
  result.pair.parameters = motion;
  return result;
}

std::optional<Options>
parseOptions(int argc, char** argv)
{
  Options options;
  Words words;
  CLI::App app(DESCRIPTION, "pcl_flashreg_map");
  app.set_version_flag("--version", std::string("pcl_flashreg_map ") + version());
  app.footer(FOOTER);
  addInputs(app, options, words);
  addOutputs(app, options, words);
  addMethod(app, options, words);
  addLongRuns(app, options, words);
  if (!program::parse(app, argc, argv))
    return std::nullopt;
  takePaths(words, options);
  options.typed = typedOptions(app);
  options.viewpoint_known = !words.no_viewpoint;
  program::takeMotion(words.motion, options.motion);
  if (!words.shard.empty())
    options.shard = batch::parseShard(words.shard);
  if (!words.format.empty())
    options.pose_format = program::POSE_FORMATS.at(words.format);
  else if (!options.poses.empty())
    options.pose_format = program::poseFormatOf(options.poses);
  if (options.pairs.empty())
    options.pairs = defaultPairs(options);
  check(options);
  return options;
}

} // namespace pcl_flashreg::map
