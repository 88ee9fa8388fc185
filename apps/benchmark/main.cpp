// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_benchmark: times the way from correspondences to the pose, stage by stage.

#include "../io/file.h"
#include "../program/command_line.h"
#include "provenance.h"
#include "problems.h"
#include "estimation/preparation.h"
#include "report.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <cstdio>

namespace pcl_flashreg::benchmark {
namespace {

BackendKind
kindOf(const std::string& backend)
{
  if (backend == "cpu")
    return BackendKind::Cpu;
  return backend == "cuda" ? BackendKind::Cuda : BackendKind::Auto;
}

/** \brief Makes a first estimator, which is what starts a device. */
Setting
start(const Options& options)
{
  const detail::Stopwatch stopwatch;
  const Estimator first(kindOf(options.backend), options.threads);
  const double start_ms = stopwatch.milliseconds();
  Setting setting{processorName(), first.backendName(), "", {}, start_ms};
  if (setting.backend == "cuda") {
    setting.device = deviceName();
    setting.ceilings = measureCeilings();
  }
  return setting;
}

Measurement
measureOne(const Setting& setting,
           const Options& options,
           const NamedProblem& problem,
           const std::string& second_order)
{
  const Parameters parameters = parametersOf(options, second_order);
  Measurement measurement = measure(problem.name,
                                    problem.view(),
                                    parameters,
                                    kindOf(options.backend),
                                    options.threads,
                                    options.repetition);
  for (const unsigned side_by_side : options.side_by_side)
    measurement.throughput.push_back(measureThroughput(problem.view(),
                                                       parameters,
                                                       kindOf(options.backend),
                                                       side_by_side,
                                                       options.repetition));
  if (!setting.device.empty())
    measurement.device = measureOnDevice(
        problem.view(), parameters, {options.repetition, options.energy_seconds});
  return measurement;
}

NamedAblation
ablate(const Options& options, const NamedProblem& named)
{
  const Parameters parameters = parametersOf(options, "auto");
  Problem problem;
  prepare(named.view(), parameters, problem);
  return {named.name,
          problem.size,
          measureAblation(problem, parameters, options.repetition)};
}

/** \brief Prints and writes what there is after every problem, so that a run that is cut off
 * has not been in vain. */
void
measureAll(const Setting& setting,
           const Options& options,
           const std::vector<NamedProblem>& problems)
{
  Figures figures;
  const auto save = [&] {
    if (!options.json.empty())
      io::writeFile(options.json, toJson(setting, options, figures));
  };
  if (!options.ablation)
    printHeader();
  for (const NamedProblem& problem : problems) {
    if (options.ablation) {
      figures.ablations.push_back(ablate(options, problem));
      print(figures.ablations.back());
      save();
      continue;
    }
    for (const std::string& second_order : options.second_order) {
      figures.measurements.push_back(
          measureOne(setting, options, problem, second_order));
      print(figures.measurements.back(), setting.ceilings);
      save();
    }
  }
}

void
run(Options options)
{
  const bool exports = !options.export_folder.empty();
  const Setting setting = exports ? Setting{} : start(options);
  fillIn(options, !setting.device.empty());
  const std::vector<NamedProblem> problems = problemsOf(options);
  if (exports) {
    for (const std::string& path : exportProblems(problems, options.export_folder))
      std::printf("%s\n", path.c_str());
    return;
  }
  printSetting(setting);
  measureAll(setting, options, problems);
}

} // namespace
} // namespace pcl_flashreg::benchmark

int
main(int argc, char** argv)
{
  using namespace pcl_flashreg;
  return program::run("pcl_flashreg_benchmark", [&] {
    CLI::App app{"Times the estimation from correspondences to pose, stage by stage.\n"
                 "The environment variable PCL_FLASHREG_CPU forces a SIMD variant."};
    benchmark::Options options;
    benchmark::declareOptions(app, options);
    if (program::parse(app, argc, argv))
      benchmark::run(std::move(options));
    return 0;
  });
}
