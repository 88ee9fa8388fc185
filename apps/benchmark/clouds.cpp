// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_cloud_benchmark: times the way from two loaded clouds to the pose, with the
// native front end and with PCL's beside it.

#include "../io/cloud_io.h"
#include "../io/pcl_cloud.h"
#include "../program/command_line.h"
#include "provenance.h"
#include "spread.h"

#include <pcl_flashreg/impl/stopwatch.hpp>
#include <pcl_flashreg/pair_registration.h>
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
  bool fast = false;
  int runs = 20;
  int pcl_runs = 5;
};

/** \brief Milliseconds of one run, both clouds together. */
struct Times {
  double voxel_grid = 0, normals = 0, features = 0, matching = 0, estimation = 0,
         cloud_check = 0, second_look = 0, total = 0;
};

constexpr std::pair<const char*, double Times::*> PARTS[] = {
    {"voxel grid", &Times::voxel_grid},
    {"normals", &Times::normals},
    {"features", &Times::features},
    {"matching", &Times::matching},
    {"estimation", &Times::estimation},
    {"cloud check", &Times::cloud_check},
    {"second look", &Times::second_look},
    {"total", &Times::total}};

/** \brief A cloud and the sensor's place, as both front ends take it. */
struct Side {
  Cloud::Ptr cloud;
  ScanInput<float> input;

  explicit Side(const std::string& path)
  {
    const io::Cloud file = io::readCloud(path);
    const io::ShiftedCloud shifted = io::toPclCloud(io::coordinates(file));
    cloud = shifted.points;
    input.points = detail::FloatRows<pcl::PointXYZ>(*cloud, {}).view();
    input.viewpoint = Eigen::Vector3d(file.viewpoint.data()) - shifted.shift;
    input.viewpoint_known = shifted.shift.isZero(0);
    cloud->sensor_origin_.head<3>() = input.viewpoint.cast<float>();
  }
};

/** \brief One search after the other, as PCL's classes do it. */
std::vector<FeatureMatch>
matchWithFlann(const Features& source, const Features& target)
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

/** \brief The pose and the times of one run. */
struct Run {
  Times times;
  PairResult pair;
};

PairOptions
pairOptions(const Options& options)
{
  PairOptions result;
  result.resolution = options.leaf;
  result.cloud_check = !options.fast;
  return result;
}

void
addFeatures(const FpfhTimings& timings, Run& run)
{
  run.times.voxel_grid += timings.voxel_grid;
  run.times.normals += timings.normals;
  run.times.features += timings.features;
}

void
addEstimation(Run& run)
{
  const StageTimings& stages = run.pair.timings.estimation;
  run.times.estimation = stages.total - stages.cloud_check - stages.second_look;
  run.times.cloud_check = stages.cloud_check;
  run.times.second_look = stages.second_look;
}

Run
runNative(const Side& source,
          const Side& target,
          PairRegistration& registration,
          const Options& options)
{
  Run run;
  const Stopwatch total;
  run.pair = registration.align(source.input, target.input, pairOptions(options));
  run.times.total = total.milliseconds();
  addFeatures(detail::toFpfhTimings(run.pair.timings.source), run);
  addFeatures(detail::toFpfhTimings(run.pair.timings.target), run);
  run.times.matching = run.pair.timings.matching;
  addEstimation(run);
  return run;
}

Run
runPcl(const Side& source,
       const Side& target,
       PairRegistration& registration,
       const Options& options)
{
  Run run;
  const Stopwatch total;
  FpfhCloud fpfh[2];
  Scan scans[2];
  for (int side = 0; side < 2; ++side) {
    FpfhTimings timings;
    fpfh[side] = computeFpfhWithPcl(*(side == 0 ? source : target).cloud,
                                    {},
                                    options.leaf,
                                    options.threads,
                                    &timings);
    addFeatures(timings, run);
    ScanInput<float> input = (side == 0 ? source : target).input;
    detail::takeKeypoints(fpfh[side], input);
    scans[side] = registration.makeScan(input, options.leaf);
  }
  const Stopwatch matching;
  const std::vector<FeatureMatch> matches =
      matchWithFlann(*fpfh[0].features, *fpfh[1].features);
  run.times.matching = matching.milliseconds();
  run.pair = registration.align(scans[0],
                                scans[1],
                                toCorrespondences(scans[0], scans[1], matches).view(),
                                pairOptions(options));
  run.times.total = total.milliseconds();
  addEstimation(run);
  return run;
}

constexpr std::pair<const char*, decltype(&runNative)> FRONT_ENDS[] = {
    {"native", &runNative}, {"pcl", &runPcl}};

void
measureAndPrint(const Options& options)
{
  const Side source(options.source), target(options.target);
  PairRegistration registration(BackendKind::Cpu, options.threads);
  std::printf("%s, %s, pcl_flashreg %s (%s, %s)\n%zu and %zu points, voxels of %g\n",
              processorName().c_str(),
              registration.backendName().c_str(),
              version(),
              commit(),
              buildType(),
              source.cloud->size(),
              target.cloud->size(),
              options.leaf);
  std::vector<Times> times[2];
  Run last[2];
  for (int i = 0; i < options.runs; ++i)
    for (int f = 0; f < 2; ++f)
      if (f == 0 || i < options.pcl_runs) {
        last[f] = FRONT_ENDS[f].second(source, target, registration, options);
        times[f].push_back(last[f].times);
      }
  for (int f = 0; f < 2 && !times[f].empty(); ++f)
    std::printf("%s: %zu and %zu keypoints, %zu inliers, %s; median of %zu runs\n",
                FRONT_ENDS[f].first,
                last[f].pair.source.size(),
                last[f].pair.target.size(),
                last[f].pair.pose.inliers.size(),
                last[f].pair.pose.converged ? "trusted" : "not trusted",
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
  app.add_flag("--fast", options.fast, "judge poses by the correspondences alone");
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
