// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_evaluate: registers the pairs of a list and compares with their poses.

#include "methods.h"
#include "pairs.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include "../io/error.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>

namespace pcl_flashreg::evaluate {
namespace {

struct Options {
  std::string pairs_file;
  std::string root;
  std::vector<std::string> datasets;
  std::string method = "flashreg";
  double leaf = 0.05;
  Criterion criterion;
  std::size_t neighbors = 1;
  unsigned threads = 0;
  std::string second_order = "auto";
  std::string score = "inliers";
  std::string csv;
};

Parameters
parametersOf(const Options& options)
{
  Parameters parameters = Parameters::fromResolution(options.leaf);
  if (options.second_order == "exact")
    parameters.second_order = SecondOrder::Exact;
  else if (options.second_order == "bounded")
    parameters.second_order = SecondOrder::Bounded;
  if (options.score == "mae")
    parameters.score_metric = ScoreMetric::Mae;
  else if (options.score == "mse")
    parameters.score_metric = ScoreMetric::Mse;
  return parameters;
}

/** \brief The folder that the paths of the list start from. */
std::string
rootOf(const Options& options)
{
  if (!options.root.empty())
    return options.root;
  const std::size_t slash = options.pairs_file.rfind('/');
  return slash == std::string::npos ? "." : options.pairs_file.substr(0, slash);
}

Input
correspondencesOf(const Pair& pair, FeatureStore& store, const Options& options)
{
  if (!pair.correspondences.empty())
    return readCorrespondences(rootOf(options) + "/" + pair.correspondences);
  return matchClouds(store.get(pair.source),
                     store.get(pair.target),
                     options.neighbors,
                     options.threads);
}

std::ofstream
openCsv(const std::string& path)
{
  std::ofstream csv;
  if (path.empty())
    return csv;
  csv.open(path);
  if (!csv)
    throw io::InputError(path + ": cannot be written");
  writeCsvHeader(csv);
  return csv;
}

int
run(const Options& options)
{
  const Parameters parameters = parametersOf(options);
  const Method method = makeMethod(options.method, parameters, options.threads);
  const std::vector<Pair> pairs = readPairs(options.pairs_file);
  std::ofstream csv = openCsv(options.csv);
  FeatureStore store(rootOf(options), options.leaf, options.threads);
  std::map<std::string, std::vector<Outcome>> outcomes;
  for (const Pair& pair : pairs) {
    const auto& wanted = options.datasets;
    if (!wanted.empty() &&
        std::find(wanted.begin(), wanted.end(), pair.dataset) == wanted.end())
      continue;
    const detail::Stopwatch matching;
    const Input input = correspondencesOf(pair, store, options);
    const double matching_ms = matching.milliseconds();
    Outcome outcome = judge(
        method(input), pair, input, parameters.inlier_distance, options.criterion);
    outcome.matching_ms = matching_ms;
    outcomes[pair.dataset].push_back(outcome);
    if (csv.is_open())
      writeCsvRow(csv, pair, outcome);
  }
  if (outcomes.empty())
    throw io::InputError(options.pairs_file + ": holds no pair of these data sets");
  for (const auto& [dataset, results] : outcomes)
    printSummary(dataset, results);
  return 0;
}

void
declareOptions(CLI::App& app, Options& options)
{
  app.add_option("pairs", options.pairs_file, "List of pairs (pairs.tsv)")->required();
  app.add_option("--root", options.root, "Folder of the clouds; default: of the list");
  app.add_option("--dataset", options.datasets, "Only these data sets");
  app.add_option("--method", options.method, "From correspondences to the pose")
      ->check(CLI::IsMember(methodNames()))
      ->capture_default_str();
  app.add_option("--leaf", options.leaf, "Resolution: voxel size, and all lengths")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--max-rotation", options.criterion.max_rotation, "Success: degrees")
      ->capture_default_str();
  app.add_option(
         "--max-translation", options.criterion.max_translation, "Success: length")
      ->capture_default_str();
  app.add_option("--neighbors", options.neighbors, "Matches for each descriptor")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--second-order", options.second_order, "Form of stage 2")
      ->check(CLI::IsMember({"auto", "exact", "bounded"}))
      ->capture_default_str();
  app.add_option("--score", options.score, "Rank poses by")
      ->check(CLI::IsMember({"inliers", "mae", "mse"}))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "CPU threads; 0 for all");
  app.add_option("--csv", options.csv, "Write a row a pair to this file");
}

} // namespace
} // namespace pcl_flashreg::evaluate

int
main(int argc, char** argv)
{
  using namespace pcl_flashreg;
  CLI::App app{"Registers the pairs of a list and compares with their true poses"};
  evaluate::Options options;
  evaluate::declareOptions(app, options);
  try {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return evaluate::run(options);
  }
  catch (const std::exception& error) {
    std::fprintf(stderr, "pcl_flashreg_evaluate: error: %s\n", error.what());
    return 3;
  }
}
