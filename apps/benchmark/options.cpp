// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "options.h"

namespace pcl_flashreg::benchmark {
namespace {

void
declareProblems(CLI::App& app, Options& options)
{
  app.add_option(
         "--sizes",
         options.sizes,
         "numbers of made correspondences [1000 to 20000; on a device to 100000]")
      ->delimiter(',');
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
  app.add_option(
      "--export",
      options.export_folder,
      "write the correspondences into this folder, six columns, and time nothing");
}

void
declareDevice(CLI::App& app, Options& options)
{
  app.add_option("--energy-seconds",
                 options.energy_seconds,
                 "length of the run that energy is measured over; 0: not at all")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--ablation",
               options.ablation,
               "on a device: the dense reference and each of the paper's modules");
}

} // namespace

void
declareOptions(CLI::App& app, Options& options)
{
  declareProblems(app, options);
  app.add_option("--backend", options.backend, "what computes")
      ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
      ->capture_default_str();
  app.add_option("--second-order",
                 options.second_order,
                 "forms of stage 2 [auto; on a device exact,bounded]")
      ->delimiter(',')
      ->check(CLI::IsMember({"auto", "exact", "bounded"}));
  app.add_option("--threads", options.threads, "CPU threads; 0: all")
      ->capture_default_str();
  app.add_option("--runs",
                 options.repetition.runs,
                 "calls that are counted, a problem, at most [50; on a device 200]")
      ->check(CLI::PositiveNumber);
  app.add_option("--seconds",
                 options.repetition.seconds,
                 "after which, and ten calls, no more are counted")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option(
         "--side-by-side",
         options.side_by_side,
         "time batches, too, with so many problems at a time: threads, and on a "
         "device streams [none; on a device 1,2,4,8]")
      ->delimiter(',')
      ->check(CLI::Range(1u, 256u));
  declareDevice(app, options);
  app.add_option("--json", options.json, "write the figures to this file, too");
}

void
fillIn(Options& options, bool on_device)
{
  if (options.sizes.empty()) {
    options.sizes = {1000, 2000, 5000, 7000, 10000, 20000};
    if (on_device)
      options.sizes.insert(options.sizes.end(), {50000, 100000});
  }
  if (options.second_order.empty())
    options.second_order = on_device ? std::vector<std::string>{"exact", "bounded"}
                                     : std::vector<std::string>{"auto"};
  if (options.side_by_side.empty() && on_device)
    options.side_by_side = {1, 2, 4, 8};
  if (options.repetition.runs == 0)
    options.repetition.runs = on_device ? 200 : 50;
}

Parameters
parametersOf(const Options& options, const std::string& second_order)
{
  Parameters parameters = Parameters::fromResolution(options.leaf);
  parameters.max_correspondences = 200000;
  if (second_order == "exact")
    parameters.second_order = SecondOrder::Exact;
  else if (second_order == "bounded")
    parameters.second_order = SecondOrder::Bounded;
  return parameters;
}

} // namespace pcl_flashreg::benchmark
