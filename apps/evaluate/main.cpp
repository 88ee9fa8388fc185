// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_evaluate: registers pairs with known poses and compares.

#include "../batch/parts.h"
#include "../batch/ranks.h"
#include "../batch/split.h"
#include "../io/error.h"
#include "../io/file.h"
#include "../program/program.h"
#include "methods/registry.h"
#include "options.h"
#include "results/report.h"
#include "run/evaluation.h"
#include "run/parts.h"

#include <pcl/console/print.h>

#include <cstdio>
#include <iostream>
#include <set>

namespace pcl_flashreg::evaluate {
namespace {

void
report(const Options& options, const Results& results)
{
  const std::vector<GroupSummary> groups = summarize(results);
  if (options.json == "-")
    std::cout << formatJson(results.config, groups, results.maps) << std::flush;
  else {
    std::cout << formatTable(groups) << formatMaps(results.maps) << std::flush;
    if (!options.json.empty())
      io::writeFile(options.json, formatJson(results.config, groups, results.maps));
  }
}

/** \brief Pairs of the shard that have no records yet. */
std::vector<std::size_t>
remaining(const Job& job, const Results& results)
{
  std::set<std::size_t> done;
  for (const Record& record : results.records)
    done.insert(record.pair);
  std::vector<std::size_t> pairs;
  for (const std::size_t pair : job.shard)
    if (done.count(pair) == 0)
      pairs.push_back(pair);
  return pairs;
}

/** \brief One process, results in memory alone. */
Results
runInMemory(const Options& options, const Job& job)
{
  Results results{job.config, {}};
  results.maps =
      evaluatePairs(options, job, job.shard, options.quiet, [&](const auto& records) {
        results.records.insert(results.records.end(), records.begin(), records.end());
      });
  return results;
}

/** \brief Results go to files as they come: one process appends to the file itself, each
 * of several ranks to a part of its own, which the first one merges. */
Results
runWithFiles(const Options& options, const Job& job, const batch::Ranks& ranks)
{
  const bool first = ranks.rank() == 0;
  if (first) {
    writeResults(options.csv, readWithParts(options.csv, job.config));
    removeParts(options.csv);
  }
  ranks.wait();
  const std::vector<std::size_t> pairs = batch::partOf(
      remaining(job, readResults(options.csv)), ranks.rank(), ranks.size());
  ranks.wait();
  std::string path = options.csv;
  if (ranks.size() > 1) {
    path = batch::partPath(options.csv, RANK, ranks.rank());
    writeResults(path, {job.config, {}});
  }
  std::vector<MapSummary> maps;
  {
    // Closed before the others are told: only then another machine is sure to see it all.
    ResultsAppender file(path);
    maps = evaluatePairs(
        options, job, pairs, options.quiet || !first, [&](const auto& records) {
          file.append(records);
        });
  }
  ranks.wait();
  if (!first)
    return {};
  Results results = readWithParts(options.csv, job.config);
  results.maps = std::move(maps);
  const std::size_t missing = remaining(job, results).size();
  if (missing > 0)
    throw io::InputError(options.csv + ": rows of " + std::to_string(missing) +
                         " pairs are not to be seen: is its folder the same for every "
                         "rank? (--resume goes on)");
  writeResults(options.csv, results);
  removeParts(options.csv);
  return results;
}

/** \brief Each process would register all scenes. */
void
checkScenes(const Options& options, const batch::Ranks& ranks)
{
  if (ranks.size() == 1 && options.shard.count == 1)
    return;
  for (const std::string& name : options.methods)
    if (findMethod(name)->of_scenes)
      throw UsageError("--method: " + name +
                       " takes whole scenes, which ranks and shards can't share");
}

void
evaluate(const Options& options, const batch::Ranks& ranks)
{
  if (ranks.size() > 1 && options.csv.empty())
    throw UsageError("several ranks need --csv FILE in a folder that all of them see");
  const Job job = makeJob(options);
  checkScenes(options, ranks);
  const Results results = options.csv.empty() ? runInMemory(options, job)
                                              : runWithFiles(options, job, ranks);
  if (ranks.rank() == 0)
    report(options, results);
}

void
merge(const Options& options)
{
  const Results results = mergeShards(options.merge);
  if (!options.csv.empty())
    writeResults(options.csv, results);
  report(options, results);
}

void
run(const Options& options, const batch::Ranks& ranks)
{
  ranks.wait(); // all have looked for the file before the first one makes it
  if (options.merge.empty())
    evaluate(options, ranks);
  else if (ranks.rank() == 0)
    merge(options);
}

} // namespace
} // namespace pcl_flashreg::evaluate

int
main(int argc, char** argv)
{
  using namespace pcl_flashreg;
  // PCL's own messages would stand between the user and ours.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const batch::Ranks ranks;
  const int status = program::run("pcl_flashreg_evaluate", [&] {
    if (const auto options = evaluate::parseOptions(argc, argv))
      evaluate::run(*options, ranks);
    return 0;
  });
  return status == 0 ? status : ranks.abort(status);
}
