// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "options.h"

#include "../io/pose_io.h"
#include "../io/text.h"
#include "../program/command_line.h"
#include "../program/help_text.h"
#include "../program/motion_options.h"
#include "../program/shared_options.h"
#include "places_picture.h"

#include <pcl_flashreg/estimator.h>

#include <cmath>

namespace pcl_flashreg::localize {
namespace {

using program::wrapped;

constexpr const char* DESCRIPTION = "Finds where in a map scans were made, with no "
                                    "initial guess, and says of each\n"
                                    "whether to trust it.\n";

constexpr const char* FOOTER = R"(
Examples:
  pcl_flashreg_localize map.pcd scan.pcd
      one line of JSON with the pose of the scan in the map, and one for people
  pcl_flashreg_localize map.pcd scans/ --index map.index --poses poses.tum
      the map is indexed once: the next run opens map.index in milliseconds
  pcl_flashreg_localize map.index scans/*.pcd --picture places.png > places.jsonl
      an index in place of the map; a picture of the map with all scans in it
  pcl_flashreg_localize map.pcd 000010.bin --leaf 0.3 --near 120,-35,0,20 --upright
      the scanner stands level, within 20 m of a place
  pcl_flashreg_localize map.index scans/ --sequence odometry.tum --poses poses.tum
      scans of known relative motion, which are looked for together

MAP is a cloud (.pcd, .ply, raw .bin), a scan or an index that this project saved. SCANs
are clouds, saved scans, or folders of clouds. Standard output has a line of JSON a scan,
in the order in which they are given, with the names that pcl_flashreg_align --json uses;
"transformation" maps the scan into the map, "rivals" are other poses that the clouds
speak for at least half as much. With --sequence, each scan has the verdict and the pose
of the sequence, and what was found of it "alone"; one more line is of the sequence.
Standard error has what people read.

Exit status: 0 all scans are placed and trusted; 1 some are not; 2 wrong usage; 3 an
input file (a scan, too) or the machine is at fault.)";

/** \brief The options whose text needs a second look once all are parsed. */
struct Words {
  std::string guess;
  std::string near;
  std::string format;
  std::string backend = "auto";
  bool no_viewpoint = false;
  program::MotionWords motion;
};

void
addInputs(CLI::App& app, Options& options, Words& words)
{
  const std::string group = "Input";
  app.add_option("map", options.map, wrapped("Where scans are looked for"))
      ->type_name("MAP");
  app.add_option("scans", options.scans, wrapped("Scans, or folders of scans"))
      ->type_name("SCAN");
  app.add_option(
         "--list",
         options.list,
         wrapped("Text file with the path of a scan a line, from the list's folder on"))
      ->type_name("FILE")
      ->group(group);
  app.add_option(
         "--index",
         options.index,
         wrapped("Keep the index of the map here, and use it if it is here already. "
                 "FILE.json beside it tells what it was made of: it is made again "
                 "where the map has changed, and refused where it is another's"))
      ->type_name("FILE")
      ->group(group);
  app.add_flag(
         "--verify",
         options.verify,
         wrapped("Read all of an index before using it, and compare its checksum: "
                 "damage is found that does not show otherwise"))
      ->group(group);
  app.add_option(
         "--sequence",
         options.sequence,
         wrapped(
             "The scans are a sequence, with these poses in a frame of its own "
             "(odometry), as --poses writes them in .tum or .kitti: all are looked "
             "for together, since one alone may be ambiguous. Scans whose names are "
             "numbers have the poses with these numbers, others that in their "
             "place"))
      ->type_name("FILE")
      ->group(group);
  app.add_option(
         "--guess",
         words.guess,
         wrapped(
             "A pose that is tried for every scan (with --sequence, of its frame) like "
             "any other hypothesis: a "
             "translation, perhaps with a quaternion, or a file with a 4 x 4 matrix"))
      ->type_name("X,Y,Z[,QX,QY,QZ,QW]|FILE")
      ->group(group);
  app.add_option("--near",
                 words.near,
                 wrapped("The origins of the scans lie within R of this point of the "
                         "map: only what they can reach from there is looked at, and "
                         "no pose beyond is trusted"))
      ->type_name("X,Y,Z,R")
      ->group(group);
  program::addBinFields(app, group, options.bin_fields);
}

void
addOutputs(CLI::App& app, Options& options, Words& words)
{
  const std::string group = "Output";
  app.add_option("--poses",
                 options.poses,
                 wrapped("Poses that are trusted: .tum or .txt (number, translation, "
                         "quaternion x y z w), .kitti (3 x 4 matrices), .csv (names, "
                         "confidences; without a pose where none is trusted), .json "
                         "(everything)"))
      ->type_name("FILE")
      ->group(group);
  program::addPoseFormat(app, group, words.format);
  app.add_option("--picture",
                 options.picture,
                 wrapped("The map from above, and where in it the scans are; needs no "
                         "display"))
      ->type_name("FILE.png")
      ->group(group);
  app.add_flag(
         "--quiet", options.quiet, wrapped("Nothing but errors on standard error"))
      ->group(group);
}

void
addMethod(CLI::App& app, Options& options, Words& words)
{
  const std::string group = "How";
  app.add_option(
         "--leaf",
         options.leaf,
         wrapped("Resolution: the voxel size, from which all lengths follow (default: "
                 "that of the index; else estimated from the first scan)"))
      ->type_name("LENGTH")
      ->group(group);
  app.add_option("--min-confidence",
                 options.parameters.min_confidence,
                 wrapped("Confidence that a trusted pose has at least, from 0 to 1"))
      ->type_name("P")
      ->capture_default_str()
      ->group(group);
  app.add_flag("!--no-second-look",
               options.second_look,
               wrapped("Don't look again, from the other side and at a coarser "
                       "resolution, where the clouds leave the pose in doubt"))
      ->group(group);
  app.add_flag(
         "--no-viewpoint",
         words.no_viewpoint,
         wrapped("Sensors did not stand at the VIEWPOINT of the scans (the origin, "
                 "where a file states none): don't take the space between it and the "
                 "points for empty. Of a map none is ever believed"))
      ->group(group);
  program::addMotion(app, group, words.motion);
  program::addGravityOfEach(app, group, words.motion);
  program::addBackend(app, group, words.backend);
  program::addThreads(app, group, options.threads);
}

void
takeGuess(const std::string& text, Options& options)
{
  const std::optional<std::vector<double>> numbers = io::numbersIn(text);
  if (!numbers) {
    options.guess_file = text;
    return;
  }
  const std::vector<double>& n = *numbers;
  RigidTransform guess;
  if (n.size() == 3 || n.size() == 7)
    guess.translation = {n[0], n[1], n[2]};
  else
    throw UsageError("--guess: expected X,Y,Z, X,Y,Z,QX,QY,QZ,QW or a file, found '" +
                     text + "'");
  if (n.size() == 7) {
    const std::optional<RigidTransform> pose = io::poseOfCells(n.data());
    if (!pose)
      throw UsageError("--guess: the quaternion QX,QY,QZ,QW must have length 1");
    guess = *pose;
  }
  options.guess = guess;
}

Near
nearOf(const std::string& text)
{
  const std::optional<std::vector<double>> numbers = io::numbersIn(text);
  if (!numbers || numbers->size() != 4)
    throw UsageError("--near: expected X,Y,Z,R, found '" + text + "'");
  const std::vector<double>& n = *numbers;
  if (!(n[3] > 0))
    throw UsageError("--near: the radius R must be > 0");
  return {{n[0], n[1], n[2]}, n[3]};
}

void
takeWords(const Words& words, Options& options)
{
  options.viewpoint_known = !words.no_viewpoint;
  options.backend = program::BACKENDS.at(words.backend);
  program::takeMotion(words.motion, options.parameters);
  if (!words.guess.empty())
    takeGuess(words.guess, options);
  if (!words.near.empty())
    options.near = nearOf(words.near);
  if (!words.format.empty())
    options.pose_format = program::POSE_FORMATS.at(words.format);
  else if (!options.poses.empty())
    options.pose_format = program::poseFormatOf(options.poses);
}

/** \brief What CLI11 can't know. */
void
check(const Options& options)
{
  if (options.map.empty() || (options.scans.empty() && options.list.empty()))
    throw UsageError("a map and a scan are needed (--help tells more)");
  if (options.leaf && !(*options.leaf > 0 && std::isfinite(*options.leaf)))
    throw UsageError("--leaf: the voxel size must be a length > 0");
  if (!options.picture.empty() && !kPlacesPictureBuiltIn)
    throw UsageError("--picture is not built into this program (Cairo was not found "
                     "when it was built)");
  try {
    options.parameters.validate();
  }
  catch (const std::invalid_argument& error) {
    throw UsageError(program::asOption(error.what()));
  }
}

} // namespace

std::optional<Options>
parseOptions(int argc, char** argv)
{
  Options options;
  Words words;
  words.motion.source_name = "scan";
  words.motion.target_name = "map";
  CLI::App app(DESCRIPTION, "pcl_flashreg_localize");
  app.set_version_flag("--version", std::string("pcl_flashreg_localize ") + version());
  app.footer(FOOTER);
  addInputs(app, options, words);
  addOutputs(app, options, words);
  addMethod(app, options, words);
  if (!program::parse(app, argc, argv))
    return std::nullopt;
  takeWords(words, options);
  check(options);
  return options;
}

} // namespace pcl_flashreg::localize
