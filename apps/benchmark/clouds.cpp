// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_cloud_benchmark: times the way from two loaded clouds to the pose, with the
// native front end and with PCL's beside it.

#include "../io/cloud_io.h"
#include "../io/pcl_cloud.h"
#include "../program/command_line.h"
#include "provenance.h"
#include "spread.h"

#include <pcl_flashreg/estimator.h>
#include <pcl_flashreg/pcl_front_end.h>

#include <pcl/kdtree/impl/kdtree_flann.hpp>
#include <pcl/kdtree/kdtree_flann.h>

#include <cstdio>

namespace pcl_flashreg::benchmark {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Features = pcl::PointCloud<pcl::FPFHSignature33>;
using detail::Stopwatch;

struct Options {
  std::string source, target;
  double leaf = 0;
  unsigned threads = 0;
  int runs = 20;
  int pcl_runs = 5;
};

/** \brief Milliseconds of one run, both clouds together. */
struct Times {
  double voxel_grid = 0, normals = 0, features = 0, matching = 0, estimation = 0,
         total = 0;
};

constexpr std::pair<const char*, double Times::*> PARTS[] = {
    {"voxel grid", &Times::voxel_grid},
    {"normals", &Times::normals},
    {"features", &Times::features},
    {"matching", &Times::matching},
    {"estimation", &Times::estimation},
    {"total", &Times::total}};

/** \brief What a front end is to this program. */
struct FrontEnd {
  const char* name;
  FpfhCloud (*describe)(const Cloud&, double, unsigned, FpfhTimings*);
  std::vector<FeatureMatch> (*match)(const Features&, const Features&, unsigned);
};

FeatureView
viewOf(const Features& features)
{
  return {features.empty() ? nullptr : features[0].histogram, features.size(), 33, 33};
}

/** \brief One search after the other, as PCL's classes do it. */
std::vector<FeatureMatch>
matchWithFlann(const Features& source, const Features& target, unsigned)
{
  pcl::KdTreeFLANN<pcl::FPFHSignature33> tree(false);
  tree.setInputCloud(target.makeShared());
  std::vector<FeatureMatch> matches;
  pcl::Indices index(1);
  std::vector<float> distance(1);
  for (std::size_t i = 0; i < source.size(); ++i)
    if (tree.nearestKSearch(source, static_cast<int>(i), 1, index, distance) > 0)
      matches.push_back({static_cast<std::int32_t>(i), index[0], distance[0]});
  return matches;
}

constexpr FrontEnd FRONT_ENDS[] = {
    {"native",
     [](const Cloud& cloud, double leaf, unsigned threads, FpfhTimings* timings) {
       return computeFpfh(cloud, {}, leaf, threads, timings);
     },
     [](const Features& source, const Features& target, unsigned threads) {
       return matchFeatures(viewOf(source), viewOf(target), 1, threads);
     }},
    {"pcl",
     [](const Cloud& cloud, double leaf, unsigned threads, FpfhTimings* timings) {
       return computeFpfhWithPcl(cloud, {}, leaf, threads, timings);
     },
     &matchWithFlann}};

/** \brief The pose and the times of one run. */
struct Run {
  Times times;
  Result result;
  std::size_t source_keypoints = 0, target_keypoints = 0;
};

Run
runOnce(const FrontEnd& front_end,
        const Cloud& source,
        const Cloud& target,
        Estimator& estimator,
        const Options& options)
{
  Run run;
  const Stopwatch total;
  FpfhCloud described[2];
  for (int side = 0; side < 2; ++side) {
    FpfhTimings timings;
    described[side] = front_end.describe(
        side == 0 ? source : target, options.leaf, options.threads, &timings);
    run.times.voxel_grid += timings.voxel_grid;
    run.times.normals += timings.normals;
    run.times.features += timings.features;
  }
  const Stopwatch matching;
  const std::vector<FeatureMatch> matches =
      front_end.match(*described[0].features, *described[1].features, options.threads);
  run.times.matching = matching.milliseconds();
  const Stopwatch estimation;
  std::vector<float> xyz[2], ranks;
  for (const FeatureMatch& match : matches) {
    const int rows[2] = {match.query, match.match};
    for (int side = 0; side < 2; ++side) {
      const pcl::PointXYZ& point = (*described[side].points)[rows[side]];
      xyz[side].insert(xyz[side].end(), {point.x, point.y, point.z});
    }
    ranks.push_back(match.squared_distance);
  }
  const CorrespondenceView<float> view{
      xyz[0].data(), xyz[1].data(), matches.size(), ranks.data()};
  run.result = estimator.estimate(view, Parameters::fromResolution(options.leaf));
  run.times.estimation = estimation.milliseconds();
  run.times.total = total.milliseconds();
  run.source_keypoints = described[0].points->size();
  run.target_keypoints = described[1].points->size();
  return run;
}

void
measureAndPrint(const Options& options)
{
  const Cloud::Ptr source =
      io::toPclCloud(io::coordinates(io::readCloud(options.source))).points;
  const Cloud::Ptr target =
      io::toPclCloud(io::coordinates(io::readCloud(options.target))).points;
  Estimator estimator(BackendKind::Cpu, options.threads);
  std::printf("%s, %s, pcl_flashreg %s (%s, %s)\n%zu and %zu points, voxels of %g\n",
              processorName().c_str(),
              estimator.backendName().c_str(),
              version(),
              commit(),
              buildType(),
              source->size(),
              target->size(),
              options.leaf);
  std::vector<Times> times[2];
  Run last[2];
  for (int i = 0; i < options.runs; ++i)
    for (int f = 0; f < 2; ++f)
      if (f == 0 || i < options.pcl_runs) {
        last[f] = runOnce(FRONT_ENDS[f], *source, *target, estimator, options);
        times[f].push_back(last[f].times);
      }
  for (int f = 0; f < 2 && !times[f].empty(); ++f)
    std::printf("%s: %zu and %zu keypoints, %zu inliers, %s; median of %zu runs\n",
                FRONT_ENDS[f].name,
                last[f].source_keypoints,
                last[f].target_keypoints,
                last[f].result.inliers.size(),
                last[f].result.converged ? "trusted" : "not trusted",
                times[f].size());
  std::printf("%-12s %10s %10s %10s %10s %8s\n",
              "ms",
              "native",
              "p10",
              "p90",
              options.pcl_runs > 0 ? "pcl" : "",
              options.pcl_runs > 0 ? "ratio" : "");
  for (const auto& [name, part] : PARTS) {
    Spread spreads[2] = {};
    for (int f = 0; f < 2 && !times[f].empty(); ++f) {
      std::vector<double> values;
      for (const Times& t : times[f])
        values.push_back(t.*part);
      spreads[f] = spreadOf(values);
    }
    std::printf("%-12s %10.2f %10.2f %10.2f",
                name,
                spreads[0].median,
                spreads[0].p10,
                spreads[0].p90);
    if (!times[1].empty())
      std::printf(
          " %10.2f %8.1f", spreads[1].median, spreads[1].median / spreads[0].median);
    std::printf("\n");
  }
}

void
declareOptions(CLI::App& app, Options& options)
{
  app.add_option("source", options.source, "cloud (.pcd, .ply, .bin)")->required();
  app.add_option("target", options.target, "cloud (.pcd, .ply, .bin)")->required();
  app.add_option("--leaf", options.leaf, "voxel size")
      ->required()
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", options.threads, "CPU threads; 0: all")
      ->capture_default_str();
  app.add_option("--runs", options.runs, "runs of the native front end")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--pcl-runs", options.pcl_runs, "runs of PCL's; 0 to leave it out")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

} // namespace
} // namespace pcl_flashreg::benchmark

int
main(int argc, char** argv)
{
  using namespace pcl_flashreg;
  return program::run("pcl_flashreg_cloud_benchmark", [&] {
    CLI::App app{
        "Times the way from two clouds to the pose, with the native front end and "
        "with PCL's classes and FLANN beside it."};
    benchmark::Options options;
    benchmark::declareOptions(app, options);
    if (program::parse(app, argc, argv))
      benchmark::measureAndPrint(options);
    return 0;
  });
}
