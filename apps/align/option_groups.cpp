// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "option_groups.h"

#include "../program/help_text.h"
#include "../program/shared_options.h"

namespace pcl_flashreg::align {

const std::map<std::string, SecondOrder> kSecondOrders = {
    {"auto", SecondOrder::Auto},
    {"exact", SecondOrder::Exact},
    {"bounded", SecondOrder::Bounded}};
const std::map<std::string, ScoreMetric> kScores = {{"inliers", ScoreMetric::Inliers},
                                                    {"mae", ScoreMetric::Mae},
                                                    {"mse", ScoreMetric::Mse}};

namespace {

using program::wrapped;

template <typename Value>
std::vector<std::string>
keysOf(const std::map<std::string, Value>& map)
{
  std::vector<std::string> keys;
  for (const auto& [key, value] : map)
    keys.push_back(key);
  return keys;
}

void
addInputs(CLI::App& app, Options& options, Words& words)
{
  app.add_option(
      "source", options.source, wrapped("Cloud to be moved (.pcd, .ply, .bin)"));
  app.add_option("target", options.target, wrapped("Cloud that stays where it is"));
  app.add_option(
      "output", options.output, wrapped("Where the moved source goes (.pcd, .ply)"));
  app.add_option(
         "--correspondences",
         words.correspondences,
         wrapped("Skip features and matching: rows of 'sx sy sz tx ty tz', rows of "
                 "'source_index target_index', or two files SRC,TGT with rows of 'x y "
                 "z'. With coordinates the clouds may be left out"))
      ->type_name("FILE[,FILE]")
      ->group("Input");
  app.add_option(
         "--features",
         words.features,
         wrapped(
             "Who computes the FPFH descriptors: native, or pcl (the same by PCL's own "
             "classes, slower); or two .pcd files with one descriptor a point of the "
             "clouds, which are then taken as the keypoints"))
      ->type_name("native|pcl|SRC,TGT")
      ->group("Input");
  app.add_option(
         "--guess",
         options.guess,
         wrapped("4 x 4 matrix, a pose that is tried like any other hypothesis"))
      ->type_name("FILE")
      ->group("Input");
  program::addBinFields(app, "Input", options.bin_fields);
}

void
addOutputs(CLI::App& app, Options& options)
{
  const std::string group = "Output";
  app.add_option(
         "--json", options.json, wrapped("Everything as JSON; - for standard output"))
      ->type_name("FILE")
      ->group(group);
  app.add_option(
         "--transform", options.transform, wrapped("The pose, a 4 x 4 matrix as text"))
      ->type_name("FILE")
      ->group(group);
  app.add_option("--snapshot",
                 options.snapshot,
                 wrapped("Picture of both clouds before and after; needs no display"))
      ->type_name("FILE.png")
      ->group(group);
  app.add_flag("--view", options.view, wrapped("Show both clouds in PCL's viewer"))
      ->group(group);
  app.add_flag(
         "--write-untrusted",
         options.write_untrusted,
         wrapped(
             "Write the aligned cloud and --transform even if the pose is not trusted"))
      ->group(group);
  app.add_flag(
         "--quiet", options.quiet, wrapped("Nothing but errors, and JSON if asked for"))
      ->group(group);
}

void
addPipeline(CLI::App& app, Options& options, Words& words)
{
  const std::string group = "How";
  app.add_option(
         "--leaf",
         options.leaf,
         wrapped("Resolution: the voxel size, from which all lengths follow (default: "
                 "estimated from the clouds, or from the correspondences)"))
      ->type_name("LENGTH")
      ->group(group);
  app.add_option(
         "--neighbors", options.neighbors, wrapped("Matches for each descriptor"))
      ->capture_default_str()
      ->check(CLI::Range(1, 1000).description(""))
      ->group(group);
  app.add_flag(
         "--mutual", options.mutual, wrapped("Keep matches that hold both ways only"))
      ->group(group);
  app.add_flag("--fast",
               options.fast,
               wrapped("Judge poses by the correspondences alone: a few milliseconds "
                       "less, fewer right poses, a weaker verdict"))
      ->group(group);
  app.add_flag("!--no-second-look",
               options.second_look,
               wrapped("Don't look again, from the other side and at a coarser "
                       "resolution, where the clouds leave the pose in doubt: less "
                       "time for hard pairs, and fewer of them right"))
      ->group(group);
  app.add_flag(
         "--no-viewpoint",
         words.no_viewpoint,
         wrapped("With 'source' or 'target' behind it the sensor of that cloud, else "
                 "those of "
                 "both did not stand at its VIEWPOINT (the origin, where a file states "
                 "none): don't take the space between it and the points for empty"))
      ->check(CLI::IsMember({"source", "target", "both", "true"}).description(""))
      ->group(group);
  program::addMotion(app, group, words.motion);
  program::addGravityOfEach(app, group, words.motion);
  program::addBackend(app, group, words.backend);
  program::addThreads(app, group, options.threads);
}

void
addLengths(CLI::App& app, Options& options)
{
  const std::string group = "Lengths (in the unit of the clouds)";
  app.add_option(
         "--length-tolerance",
         options.length_tolerance,
         wrapped("Two correspondences agree if their distances in source and target "
                 "differ by less (default: 0.24 x leaf)"))
      ->type_name("LENGTH")
      ->group(group);
  app.add_option(
         "--min-length-sum",
         options.min_length_sum,
         wrapped("Pairs of correspondences whose two distances sum to no more are "
                 "ignored (default: 3 x leaf)"))
      ->type_name("LENGTH")
      ->group(group);
  app.add_option("--inlier-distance",
                 options.inlier_distance,
                 wrapped("Largest residual of an inlier (default: 2 x leaf)"))
      ->type_name("LENGTH")
      ->group(group);
}

void
addMethod(CLI::App& app, Parameters& parameters, Words& words)
{
  const auto add =
      [&app](const std::string& name, auto& value, const std::string& text) {
        return app.add_option(name, value, wrapped(text))
            ->capture_default_str()
            ->group("Method");
      };
  add("--max-correspondences",
      parameters.max_correspondences,
      "Correspondences used at most; the best-ranked are kept");
  add("--pivots", parameters.pivots, "Best edges that cliques are grown from");
  add("--cliques-per-pivot",
      parameters.cliques_per_pivot,
      "3-cliques kept for each pivot");
  add("--row-capacity",
      parameters.row_capacity,
      "Bounded second order: voters and entries of a row");
  add("--pool-capacity",
      parameters.pool_capacity,
      "Bounded second order: pivot candidates of a row");
  add("--second-order", words.second_order, "auto, exact or bounded")
      ->check(CLI::IsMember(keysOf(kSecondOrders)).description(""));
  add("--score", words.score, "Rank poses by: inliers, mae or mse")
      ->check(CLI::IsMember(keysOf(kScores)).description(""));
  add("--refinement-iterations",
      parameters.refinement_iterations,
      "Rounds of reweighted alignment at most");
  add("--max-hypotheses",
      parameters.max_hypotheses,
      "Distinct poses listed in the JSON");
  add("--min-confidence",
      parameters.min_confidence,
      "Confidence that a trusted pose has at least, from 0 to 1");
}

} // namespace

void
addOptions(CLI::App& app, Options& options, Words& words)
{
  addInputs(app, options, words);
  addOutputs(app, options);
  addPipeline(app, options, words);
  addLengths(app, options);
  addMethod(app, options.parameters, words);
}

} // namespace pcl_flashreg::align
