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

std::vector<Measurement>
measureAll(const Setting& setting,
           const Options& options,
           const std::vector<NamedProblem>& problems)
{
  std::vector<Measurement> all;
  printHeader();
  for (const NamedProblem& problem : problems)
    for (const std::string& second_order : options.second_order) {
      const Parameters parameters = parametersOf(options, second_order);
      all.push_back(measure(problem.name,
                            problem.view(),
                            parameters,
                            kindOf(options.backend),
                            options.threads,
                            options.runs));
      if (!setting.device.empty())
        all.back().device =
            measureOnDevice(problem.view(),
                            parameters,
                            {options.runs, options.streams, options.energy_seconds});
      print(all.back(), setting.ceilings);
    }
  return all;
}

std::vector<NamedAblation>
measureAblations(const Options& options, const std::vector<NamedProblem>& problems)
{
  std::vector<NamedAblation> all;
  for (const NamedProblem& named : problems) {
    const Parameters parameters = parametersOf(options, "auto");
    Problem problem;
    prepare(named.view(), parameters, problem);
    all.push_back(
        {named.name, problem.size, measureAblation(problem, parameters, options.runs)});
    print(all.back());
  }
  return all;
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
  Figures figures;
  if (options.ablation)
    figures.ablations = measureAblations(options, problems);
  else
    figures.measurements = measureAll(setting, options, problems);
  if (!options.json.empty())
    io::writeFile(options.json, toJson(setting, options, figures));
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
