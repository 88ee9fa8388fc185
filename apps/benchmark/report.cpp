// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "report.h"

#include "provenance.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace pcl_flashreg::benchmark {
namespace {

const char*
formOf(const Measurement& m)
{
  return m.result.second_order == SecondOrder::Exact ? "exact" : "bounded";
}

void
printDevice(const DeviceFigures& figures)
{
  std::printf("    resident %.3f (p10 %.3f, p90 %.3f) ms; %.1f MB; pairs a second",
              figures.resident_ms.median,
              figures.resident_ms.p10,
              figures.resident_ms.p90,
              1e-6 * static_cast<double>(figures.memory_bytes));
  for (const Throughput& t : figures.throughput)
    std::printf(
        " %.0f (%u stream%s)", t.pairs_per_second, t.streams, t.streams > 1 ? "s" : "");
  if (figures.energy_mj)
    std::printf("; %.1f mJ a pair\n", *figures.energy_mj);
  else
    std::printf("; energy not measured\n");
}

nlohmann::json
toJson(const Spread& spread)
{
  return {{"median", spread.median},
          {"p10", spread.p10},
          {"p90", spread.p90},
          {"min", spread.least}};
}

nlohmann::json
toJson(const DeviceFigures& figures)
{
  nlohmann::json throughput = nlohmann::json::array();
  for (const Throughput& t : figures.throughput)
    throughput.push_back(
        {{"streams", t.streams}, {"pairs_per_second", t.pairs_per_second}});
  nlohmann::json json{{"resident_ms", toJson(figures.resident_ms)},
                      {"memory_bytes", figures.memory_bytes},
                      {"throughput", throughput},
                      {"energy_mj", nullptr}};
  if (figures.energy_mj)
    json["energy_mj"] = *figures.energy_mj;
  return json;
}

nlohmann::json
toJson(const Measurement& m)
{
  nlohmann::json stages;
  for (std::size_t s = 0; s < STAGES.size(); ++s)
    stages[STAGES[s].name] = toJson(m.stages[s]);
  stages["total"] = toJson(m.total);
  nlohmann::json json{{"name", m.name},
                      {"correspondences", m.size},
                      {"inliers", m.result.inliers.size()},
                      {"converged", m.result.converged},
                      {"second_order", formOf(m)},
                      {"cold_ms", m.cold_ms},
                      {"timings_ms", stages}};
  if (m.device)
    json["device"] = toJson(*m.device);
  return json;
}

} // namespace

void
printHeader(const Setting& setting)
{
  std::printf("%s, %s%s%s, pcl_flashreg %s (%s, %s)\n",
              setting.processor.c_str(),
              setting.device.c_str(),
              setting.device.empty() ? "" : ", ",
              setting.backend.c_str(),
              version(),
              commit(),
              buildType());
  std::printf(
      "%-26s %-7s %7s %8s", "problem (times: median ms)", "graph 2", "N", "inliers");
  for (const Stage& stage : STAGES)
    std::printf(" %9.9s", stage.name);
  std::printf(" %9s %8s %8s %8s\n", "total", "p10", "p90", "cold");
}

void
print(const Measurement& m)
{
  std::printf("%-26s %-7s %7zu %8zu",
              m.name.c_str(),
              formOf(m),
              m.size,
              m.result.inliers.size());
  for (const Spread& stage : m.stages)
    std::printf(" %9.3f", stage.median);
  std::printf(" %9.3f %8.3f %8.3f %8.3f\n",
              m.total.median,
              m.total.p10,
              m.total.p90,
              m.cold_ms);
  if (m.device)
    printDevice(*m.device);
  std::fflush(stdout);
}

std::string
toJson(const Setting& setting,
       const Options& options,
       const std::vector<Measurement>& measurements)
{
  nlohmann::json json{{"processor", setting.processor},
                      {"backend", setting.backend},
                      {"device", nullptr},
                      {"start_ms", setting.start_ms},
                      {"threads", options.threads},
                      {"version", version()},
                      {"commit", commit()},
                      {"build", buildType()},
                      {"compiler", __VERSION__},
                      {"runs", options.runs},
                      {"measurements", nlohmann::json::array()}};
  if (!setting.device.empty())
    json["device"] = setting.device;
  for (const Measurement& m : measurements)
    json["measurements"].push_back(toJson(m));
  return json.dump(2) + "\n";
}

} // namespace pcl_flashreg::benchmark
