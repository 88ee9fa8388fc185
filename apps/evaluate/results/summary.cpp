// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_flashreg::evaluate {
namespace {

using Records = std::vector<const Record*>;
using Values = std::vector<double>;

/** \brief Linear between the two values next to it. */
double
quantile(Values values, double share)
{
  if (values.empty())
    return 0;
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] +
         (place - static_cast<double>(below)) * (values[above] - values[below]);
}

Average
averageOf(const Values& values)
{
  if (values.empty())
    return {};
  return {std::accumulate(values.begin(), values.end(), 0.0) /
              static_cast<double>(values.size()),
          quantile(values, 0.5)};
}

Spread
spreadOf(const Values& values)
{
  return {quantile(values, 0.5), quantile(values, 0.95)};
}

template <typename Value>
Values
collect(const Records& records, Value&& value)
{
  Values values;
  for (const Record* record : records)
    values.push_back(value(*record));
  return values;
}

double
share(std::size_t part, std::size_t whole)
{
  return whole == 0 ? std::numeric_limits<double>::quiet_NaN()
                    : static_cast<double>(part) / static_cast<double>(whole);
}

std::vector<StageSpread>
stagesOf(const Records& records)
{
  Records staged;
  for (const Record* record : records)
    if (record->times.stages)
      staged.push_back(record);
  std::vector<StageSpread> stages;
  for (const Stage& stage : STAGES)
    if (!staged.empty())
      stages.push_back({stage.name, spreadOf(collect(staged, [&](const Record& r) {
                          return (*r.times.stages).*stage.milliseconds;
                        }))});
  return stages;
}

MethodSummary
summarizeMethod(const std::string& method, const Records& records)
{
  MethodSummary summary;
  summary.method = method;
  Records right;
  std::size_t rightly = 0;
  for (const Record* record : records) {
    if (record->success)
      right.push_back(record);
    summary.trusted += record->trusted;
    rightly += record->trusted && record->success;
  }
  summary.successes = right.size();
  summary.recall = share(right.size(), records.size());
  summary.precision = share(rightly, summary.trusted);
  summary.verdict_recall = share(rightly, right.size());
  summary.rotation_error =
      averageOf(collect(right, [](const Record& r) { return r.rotation_error; }));
  summary.translation_error =
      averageOf(collect(right, [](const Record& r) { return r.translation_error; }));
  summary.features_ms =
      spreadOf(collect(records, [](const Record& r) { return r.times.features; }));
  summary.matching_ms =
      spreadOf(collect(records, [](const Record& r) { return r.times.matching; }));
  summary.estimation_ms =
      spreadOf(collect(records, [](const Record& r) { return r.times.estimation; }));
  summary.stages_ms = stagesOf(records);
  return summary;
}

template <typename Belongs>
GroupSummary
summarizeGroup(const Results& results,
               const std::string& dataset,
               const std::string& scene,
               Belongs&& belongs)
{
  GroupSummary group;
  group.dataset = dataset;
  group.scene = scene;
  for (const auto& name : results.config["methods"]) {
    const std::string method = name.get<std::string>();
    Records records;
    for (const Record& record : results.records)
      if (record.method == method && belongs(record))
        records.push_back(&record);
    if (group.methods.empty()) {
      group.pairs = records.size();
      group.inlier_ratio =
          averageOf(collect(records, [](const Record& r) { return r.inlier_ratio; }));
      group.correspondences = averageOf(collect(records, [](const Record& r) {
        return static_cast<double>(r.correspondences);
      }));
    }
    group.methods.push_back(summarizeMethod(method, records));
    MethodSummary& summary = group.methods.back();
    const MethodSummary& first = group.methods.front();
    summary.recall_difference = summary.recall - first.recall;
    summary.time_ratio = summary.estimation_ms.median / first.estimation_ms.median;
  }
  return group;
}

/** \brief Different values of a member, in the order of their first record. */
template <typename Name, typename Belongs>
std::vector<std::string>
namesOf(const Results& results, Name&& name, Belongs&& belongs)
{
  std::vector<std::string> names;
  for (const Record& record : results.records)
    if (belongs(record) &&
        std::find(names.begin(), names.end(), name(record)) == names.end())
      names.push_back(name(record));
  return names;
}

} // namespace

std::vector<GroupSummary>
summarize(const Results& results)
{
  const auto all = [](const Record&) { return true; };
  std::vector<GroupSummary> groups;
  const auto datasets = namesOf(
      results, [](const Record& r) { return r.dataset; }, all);
  for (const std::string& dataset : datasets) {
    const auto inDataset = [&](const Record& r) { return r.dataset == dataset; };
    const auto scenes = namesOf(
        results, [](const Record& r) { return r.scene; }, inDataset);
    for (const std::string& scene : scenes)
      if (scenes.size() > 1)
        groups.push_back(summarizeGroup(results, dataset, scene, [&](const Record& r) {
          return inDataset(r) && r.scene == scene;
        }));
    groups.push_back(summarizeGroup(results, dataset, "", inDataset));
  }
  if (datasets.size() > 1)
    groups.push_back(summarizeGroup(results, "", "", all));
  return groups;
}

} // namespace pcl_flashreg::evaluate
