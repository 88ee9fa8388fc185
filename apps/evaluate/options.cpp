// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "options.h"

#include "../io/raw_bin.h"
#include "../program/command_line.h"
#include "methods/registry.h"

#include <pcl_flashreg/estimator.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace pcl_flashreg::evaluate {
namespace {

constexpr const char* DESCRIPTION =
    "Registers pairs of clouds whose true poses are known, and says how often, how\n"
    "exactly and how fast each method found them.\n";

constexpr const char* LAYOUTS = R"(
Data, told apart by what is there:
  a file             list of pairs: dataset, split, source, target, correspondences, note
                     and the 16 numbers of T_target_source, separated by tabs
  gt.log             3DMatch, 3DLoMatch: <scene>/cloud_bin_<k>.ply (or .pcd) and a gt.log
                     a scene, anywhere below the folder
  sequences/ poses/  KITTI odometry: pairs 10 m apart (leaf 0.3, right within 5 deg, 0.6 m)
  *_trans.txt        correspondences in TurboReg's layout, and
  *@GTmat*.txt       in MAC's

Many machines: under mpirun the ranks share the pairs, and the first one merges what they
found. Or run each --shard i/n on its own and --merge the files.

Exit status: 0 done; 2 wrong usage; 3 an input file or the machine is at fault.
)";

std::string
footer()
{
  std::string text = "\nMethods:\n";
  for (const MethodEntry& method : methods()) {
    std::string name = "  " + method.name;
    name.resize(std::max<std::size_t>(21, name.size() + 1), ' ');
    text += name + method.description + '\n';
  }
  return text + LAYOUTS;
}

const std::map<std::string, ScoreMetric> SCORES = {{"inliers", ScoreMetric::Inliers},
                                                   {"mae", ScoreMetric::Mae},
                                                   {"mse", ScoreMetric::Mse}};

void
declareData(CLI::App& app, Options& options)
{
  app.add_option("data", options.data, "List of pairs, or folder; see below");
  app.add_option("--root",
                 options.data_options.root,
                 "Folder that the paths of a list start from; default: of the list");
  app.add_option("--dataset", options.datasets, "Only these data sets");
  app.add_option(
         "--sequences", options.data_options.sequences, "KITTI: which sequences")
      ->check(CLI::Range(0, 21))
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--bin-fields",
                 options.data_options.bin_fields,
                 "float32 values in a row of raw .bin files; default: told from them")
      ->check(CLI::Range(std::size_t{3}, io::kMaxRawFields).description(""));
  app.add_option("--every", options.every, "Only every n-th pair")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

void
declareMethod(CLI::App& app, Options& options)
{
  app.add_option("--method", options.methods, "Methods, separated by commas; see below")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--leaf",
                 options.leaf,
                 "Resolution: voxel size, and all lengths; default 0.05")
      ->check(CLI::PositiveNumber);
  app.add_option("--max-rotation", options.max_rotation, "Right: degrees; default 15")
      ->check(CLI::PositiveNumber);
  app.add_option("--max-translation",
                 options.max_translation,
                 "Right: unit of the clouds; default 0.3")
      ->check(CLI::PositiveNumber);
  app.add_option("--features",
                 options.descriptors_name,
                 "fpfh; or pcl_fpfh, shot: by PCL's classes, at the same keypoints")
      ->check(CLI::IsMember(DESCRIPTORS))
      ->capture_default_str();
  app.add_option("--neighbors", options.neighbors, "Matches for each descriptor")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--score", options.score_name, "flashreg ranks poses by")
      ->check(CLI::IsMember(SCORES))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "CPU threads; 0 for all");
  app.add_option("--cache", options.cache, "Folder that keeps features for later runs");
}

void
declareOutput(CLI::App& app, Options& options, std::string& shard)
{
  app.add_option(
      "--csv",
      options.csv,
      "Write a row a pair and method to this file as they come, and times to "
      "FILE.times.csv beside it");
  app.add_option(
      "--json", options.json, "Write the summary to this file; - for stdout");
  app.add_flag("--resume", options.resume, "Go on with a --csv that was not finished");
  app.add_option("--shard", shard, "i/n: only the i-th of n parts, from 1");
  app.add_option(
      "--merge",
      options.merge,
      "Put the --csv files of all shards together (one file: sum it up again)");
  app.add_flag("--quiet", options.quiet, "No progress");
}

void
checkMethods(const std::vector<std::string>& names)
{
  for (const std::string& name : names) {
    if (findMethod(name) == nullptr) {
      std::string known;
      for (const MethodEntry& method : methods())
        known += (known.empty() ? "" : ", ") + method.name;
      throw UsageError("--method: '" + name + "' is unknown, or not in this build; " +
                       "there are " + known);
    }
    if (std::count(names.begin(), names.end(), name) > 1)
      throw UsageError("--method: " + name + " is named twice");
  }
}

/** \brief What CLI11 can't know. */
void
check(const Options& options)
{
  if (options.merge.empty() == options.data.empty())
    throw UsageError(
        "either data to evaluate or --merge is needed (--help tells more)");
  if (options.resume && options.csv.empty())
    throw UsageError("--resume needs the --csv that it is to go on with");
  if (!options.csv.empty() && std::filesystem::exists(options.csv) && !options.resume &&
      options.merge.empty())
    throw UsageError(options.csv +
                     " is there already: --resume goes on with it, or remove it");
  for (const std::string& file : options.merge)
    if (file == options.csv)
      throw UsageError("--merge: " + file + " is to be read and to be written");
  checkMethods(options.methods);
}

} // namespace

std::optional<Options>
parseOptions(int argc, char** argv)
{
  Options options;
  std::string shard;
  CLI::App app(DESCRIPTION, "pcl_flashreg_evaluate");
  app.set_version_flag("--version", std::string("pcl_flashreg_evaluate ") + version());
  app.footer(footer());
  declareData(app, options);
  declareMethod(app, options);
  declareOutput(app, options, shard);
  if (!program::parse(app, argc, argv))
    return std::nullopt;
  options.score = SCORES.at(options.score_name);
  options.descriptors = DESCRIPTORS.at(options.descriptors_name);
  if (!shard.empty())
    options.shard = batch::parseShard(shard);
  check(options);
  return options;
}

} // namespace pcl_flashreg::evaluate
