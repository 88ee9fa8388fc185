// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_benchmark: times the way from correspondences to the pose, stage by stage.

#include "../io/correspondence_io.h"
#include "../io/error.h"
#include "../io/file.h"
#include "machine.h"
#include "measurement.h"
#include "support/made_correspondences.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace pcl_flashreg::benchmark {
namespace {

struct Options {
  std::vector<std::size_t> sizes = {1000, 2000, 5000, 7000, 10000, 20000};
  std::vector<double> inlier_ratios = {0.05};
  double side = 3;
  double leaf = 0.05;
  std::vector<std::string> files;
  std::string second_order = "auto";
  unsigned threads = 0;
  int runs = 50;
  std::string json;
};

Parameters
parametersOf(const Options& options)
{
  Parameters parameters = Parameters::fromResolution(options.leaf);
  parameters.max_correspondences = 200000;
  if (options.second_order == "exact")
    parameters.second_order = SecondOrder::Exact;
  else if (options.second_order == "bounded")
    parameters.second_order = SecondOrder::Bounded;
  return parameters;
}

io::Correspondences
readCorrespondences(const std::string& paths)
{
  const auto table = [](const std::string& path) {
    return io::parseNumberTable(io::readFile(path));
  };
  const std::size_t comma = paths.find(',');
  if (comma == std::string::npos)
    return io::fromCoordinates(table(paths));
  return io::fromPointTables(table(paths.substr(0, comma)),
                             table(paths.substr(comma + 1)));
}

void
printHeader()
{
  std::printf("%-34s %7s %8s", "problem (times: median ms)", "N", "inliers");
  for (const StageField& stage : STAGES)
    std::printf(" %9.9s", stage.first);
  std::printf(" %8s %8s %8s\n", "p10", "p90", "cold");
}

void
print(const Measurement& m)
{
  std::printf("%-34s %7zu %8zu", m.name.c_str(), m.size, m.result.inliers.size());
  for (const Spread& stage : m.stages)
    std::printf(" %9.3f", stage.median);
  std::printf(
      " %8.3f %8.3f %8.3f\n", m.stages.back().p10, m.stages.back().p90, m.cold_ms);
  std::fflush(stdout);
}

nlohmann::json
toJson(const Measurement& m)
{
  nlohmann::json stages;
  for (std::size_t s = 0; s < STAGES.size(); ++s)
    stages[STAGES[s].first] = {{"median", m.stages[s].median},
                               {"p10", m.stages[s].p10},
                               {"p90", m.stages[s].p90},
                               {"min", m.stages[s].least}};
  return {{"name", m.name},
          {"correspondences", m.size},
          {"inliers", m.result.inliers.size()},
          {"backend", m.result.backend},
          {"second_order",
           m.result.second_order == SecondOrder::Exact ? "exact" : "bounded"},
          {"cold_ms", m.cold_ms},
          {"timings_ms", stages}};
}

std::vector<Measurement>
measureAll(const Options& options)
{
  const Parameters parameters = parametersOf(options);
  std::vector<Measurement> all;
  const auto add = [&](const std::string& name,
                       const CorrespondenceView<double>& view) {
    all.push_back(measure(name, view, parameters, options.threads, options.runs));
    print(all.back());
  };
  for (const std::string& file : options.files) {
    const io::Correspondences c = readCorrespondences(file);
    const std::size_t comma = file.find(',');
    const std::string first = file.substr(0, comma);
    add(first.substr(first.rfind('/') + 1),
        {c.source.data(), c.target.data(), c.size()});
  }
  if (!options.files.empty())
    return all;
  for (const std::size_t size : options.sizes)
    for (const double ratio : options.inlier_ratios) {
      made::Recipe recipe;
      recipe.size = size;
      recipe.inlier_ratio = ratio;
      recipe.side = options.side;
      char name[64];
      std::snprintf(
          name, sizeof name, "cube %g, inliers %g %%", options.side, 100 * ratio);
      add(name, made::make(recipe).view());
    }
  return all;
}

void
writeJson(const Options& options, const std::vector<Measurement>& measurements)
{
  nlohmann::json out{{"machine", processorName()},
                     {"threads", options.threads},
                     {"version", version()},
                     {"commit", PCL_FLASHREG_COMMIT},
                     {"build", PCL_FLASHREG_BUILD},
                     {"compiler", __VERSION__},
                     {"runs", options.runs}};
  for (const Measurement& m : measurements)
    out["measurements"].push_back(toJson(m));
  io::writeFile(options.json, out.dump(2) + "\n");
}

void
declareOptions(CLI::App& app, Options& options)
{
  app.add_option("--sizes", options.sizes, "numbers of made correspondences")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option(
         "--inlier-ratios", options.inlier_ratios, "shares of right ones, 0 to 1")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--side", options.side, "side of the cube that they are made in")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--leaf", options.leaf, "resolution that sets every length")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--correspondences",
                 options.files,
                 "time these files instead: six columns, or two files SOURCE,TARGET");
  app.add_option("--second-order", options.second_order, "form of stage 2")
      ->check(CLI::IsMember({"auto", "exact", "bounded"}))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "CPU threads; 0: all")
      ->capture_default_str();
  app.add_option("--runs", options.runs, "calls that are counted, a problem")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--json", options.json, "write the figures to this file, too");
}

} // namespace
} // namespace pcl_flashreg::benchmark

int
main(int argc, char** argv)
{
  using namespace pcl_flashreg;
  CLI::App app{"Times the estimation from correspondences to pose, stage by stage.\n"
               "The environment variable PCL_FLASHREG_CPU forces a SIMD variant."};
  benchmark::Options options;
  benchmark::declareOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    std::printf("%s, %s, pcl_flashreg %s (%s, %s)\n",
                benchmark::processorName().c_str(),
                Estimator(BackendKind::Auto, options.threads).backendName().c_str(),
                version(),
                PCL_FLASHREG_COMMIT,
                PCL_FLASHREG_BUILD);
    benchmark::printHeader();
    const auto measurements = benchmark::measureAll(options);
    if (!options.json.empty())
      benchmark::writeJson(options, measurements);
    return 0;
  }
  catch (const std::exception& error) {
    std::fprintf(stderr, "pcl_flashreg_benchmark: error: %s\n", error.what());
    return 3;
  }
}
