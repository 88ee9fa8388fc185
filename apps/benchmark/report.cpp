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
printDevice(const DeviceFigures& figures, const Ceilings& ceilings)
{
  std::printf("    resident %.3f (p10 %.3f, p90 %.3f) ms; %.1f MB",
              figures.resident_ms.median,
              figures.resident_ms.p10,
              figures.resident_ms.p90,
              1e-6 * static_cast<double>(figures.memory_bytes));
  if (figures.energy_mj)
    std::printf("; %.1f mJ a pair\n", *figures.energy_mj);
  else
    std::printf("; energy not measured\n");
  if (!figures.work)
    return;
  const Floor floor = floorOf(*figures.work, ceilings);
  std::printf("    floor %.3f ms: first_order_graph %.3f, ",
              floor.total(),
              floor.first_order_graph);
  if (floor.second_order_graph)
    std::printf("second_order_graph %.3f, ", *floor.second_order_graph);
  std::printf("verification %.3f\n", floor.verification);
}

nlohmann::json
orNull(const std::optional<double>& value)
{
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

nlohmann::json
toJson(const Work& work, const Ceilings& ceilings)
{
  const Floor floor = floorOf(work, ceilings);
  return {{"first_order_graph_operations", work.first_order_graph_operations},
          {"second_order_graph_bytes", orNull(work.second_order_graph_bytes)},
          {"verification_operations", work.verification_operations},
          {"floor_ms",
           {{"first_order_graph", floor.first_order_graph},
            {"second_order_graph", orNull(floor.second_order_graph)},
            {"verification", floor.verification},
            {"total", floor.total()}}}};
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
toJson(const DeviceFigures& figures, const Ceilings& ceilings)
{
  nlohmann::json json{{"resident_ms", toJson(figures.resident_ms)},
                      {"memory_bytes", figures.memory_bytes},
                      {"energy_mj", orNull(figures.energy_mj)},
                      {"work", nullptr}};
  if (figures.work)
    json["work"] = toJson(*figures.work, ceilings);
  return json;
}

nlohmann::json
toJson(const Measurement& m, const Ceilings& ceilings)
{
  nlohmann::json stages;
  for (std::size_t s = 0; s < STAGES.size(); ++s)
    stages[STAGES[s].name] = toJson(m.stages[s]);
  stages["total"] = toJson(m.total);
  nlohmann::json throughput = nlohmann::json::array();
  for (const Throughput& t : m.throughput)
    throughput.push_back(
        {{"side_by_side", t.side_by_side}, {"pairs_per_second", t.pairs_per_second}});
  nlohmann::json json{{"name", m.name},
                      {"correspondences", m.size},
                      {"inliers", m.result.inliers.size()},
                      {"converged", m.result.converged},
                      {"second_order", formOf(m)},
                      {"cold_ms", m.cold_ms},
                      {"timings_ms", stages},
                      {"throughput", throughput}};
  if (m.device)
    json["device"] = toJson(*m.device, ceilings);
  return json;
}

nlohmann::json
toJson(const NamedAblation& ablation)
{
  nlohmann::json rows = nlohmann::json::array();
  for (const AblationMeasurement& row : ablation.rows) {
    nlohmann::json stages;
    for (std::size_t s = 0; s < ABLATION_STAGES.size(); ++s)
      stages[ABLATION_STAGES[s].name] = toJson(row.stages[s]);
    rows.push_back({{"row", row.row.name},
                    {"inliers", row.inliers},
                    {"timings_ms", stages},
                    {"memory_bytes", row.device_bytes}});
  }
  return {{"name", ablation.name}, {"correspondences", ablation.size}, {"rows", rows}};
}

} // namespace

void
printSetting(const Setting& setting)
{
  std::printf("%s, %s%s%s, pcl_flashreg %s (%s, %s)\n",
              setting.processor.c_str(),
              setting.device.c_str(),
              setting.device.empty() ? "" : ", ",
              setting.backend.c_str(),
              version(),
              commit(),
              buildType());
  if (!setting.device.empty())
    std::printf("start %.0f ms; ceilings: %.2f T operations a second, "
                "%.2f TB a second from the cache\n",
                setting.start_ms,
                1e-12 * setting.ceilings.operations_per_second,
                1e-12 * setting.ceilings.cache_bytes_per_second);
}

void
printHeader()
{
  std::printf(
      "%-26s %-7s %7s %8s", "problem (times: median ms)", "graph 2", "N", "inliers");
  for (const Stage& stage : STAGES)
    std::printf(" %9.9s", stage.name);
  std::printf(" %9s %8s %8s %8s\n", "total", "p10", "p90", "cold");
}

void
print(const Measurement& m, const Ceilings& ceilings)
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
  if (!m.throughput.empty()) {
    std::printf("    pairs a second:");
    for (const Throughput& t : m.throughput)
      std::printf(" %.0f (%u at a time)", t.pairs_per_second, t.side_by_side);
    std::printf("\n");
  }
  if (m.device)
    printDevice(*m.device, ceilings);
  std::fflush(stdout);
}

void
print(const NamedAblation& ablation)
{
  std::printf("\n%s, N = %zu\n", ablation.name.c_str(), ablation.size);
  printAblation(ablation.rows);
  std::fflush(stdout);
}

std::string
toJson(const Setting& setting, const Options& options, const Figures& figures)
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
                      {"runs", options.repetition.runs},
                      {"seconds", options.repetition.seconds},
                      {"measurements", nlohmann::json::array()},
                      {"ablations", nlohmann::json::array()}};
  if (!setting.device.empty()) {
    json["device"] = setting.device;
    json["ceilings"] = {
        {"operations_per_second", setting.ceilings.operations_per_second},
        {"cache_bytes_per_second", setting.ceilings.cache_bytes_per_second}};
  }
  for (const Measurement& m : figures.measurements)
    json["measurements"].push_back(toJson(m, setting.ceilings));
  for (const NamedAblation& ablation : figures.ablations)
    json["ablations"].push_back(toJson(ablation));
  return json.dump(2) + "\n";
}

} // namespace pcl_flashreg::benchmark
