// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_map: from a folder of scans to a map.

#include "../batch/ranks.h"
#include "../io/file.h"
#include "../program/program.h"
#include "options.h"
#include "outputs.h"
#include "relations.h"
#include "report.h"
#include "../program/scan_files.h"
#include "scan_reader.h"
#include "scan_store.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <pcl/console/print.h>

#include <iostream>

namespace pcl_flashreg::map {
namespace {

using program::Messages;
using ScanPair = MultiviewRegistration::ScanPair;

/** \brief Exit statuses beside those of program::run(). */
enum Verdict { COMPLETE = 0, NOT_COMPLETE = 1 };

class MapMaker {
public:
  MapMaker(const Options& options, const batch::Ranks& ranks)
      : options_(options),
        ranks_(ranks),
        messages_("pcl_flashreg_map", options.quiet),
        store_(options.scan_folder),
        registration_(BackendKind::Auto, options.threads)
  {
  }

  Verdict
  make(const std::vector<ScanFile>& files)
  {
    read(files);
    ranks_.wait(); // all have looked at the pairs' file before the first one makes it
    PairRelations pairs(options_, scans_, source_, ranks_, registration_);
    try {
      relateAndPlace(pairs);
    }
    catch (const ShardDone&) {
      messages_.note(
          "these pairs are done: once all shards are, --resume makes the map");
      return COMPLETE;
    }
    if (ranks_.rank() > 0)
      return COMPLETE;
    pairs.finish();
    write();
    return isComplete(run_) ? COMPLETE : NOT_COMPLETE;
  }

private:
  void
  read(const std::vector<ScanFile>& files)
  {
    const detail::Stopwatch watch;
    scans_ = readScans(options_,
                       files,
                       options_.leaf ? options_.leaf : resolutionOfPairs(options_),
                       messages_,
                       store_);
    run_.scans = scans_.files;
    run_.left_out = scans_.left_out;
    run_.resolution = scans_.resolution;
    run_.resolution_estimated = scans_.estimated;
    run_.times.reading = watch.milliseconds();
  }

  /** \brief What ends the rounds of a shard, which is only to do its pairs. */
  struct ShardDone {};

  /** \brief Each rank makes the same map, and knows by that which pairs are next. */
  void
  relateAndPlace(PairRelations& pairs)
  {
    const auto relate = [&](const std::vector<ScanPair>& next) {
      if (options_.shard && pairs.relateShard(next))
        throw ShardDone();
      std::vector<ScanRelation> relations = pairs.of(next);
      run_.pairs += relations.size();
      messages_.say("placing the scans");
      return relations;
    };
    run_.result =
        registration_.align(scans_.files.size(), source_, relate, options_.multiview());
    run_.times.relations = run_.result.timings.relations;
    run_.times.placing = run_.result.timings.grouping + run_.result.timings.refinement;
    run_.min_confidence = options_.min_confidence;
    run_.motion = options_.motion.motion;
    run_.known_pairs = pairs.knownBefore();
  }

  void
  write()
  {
    const detail::Stopwatch watch;
    run_.clouds = writeOutputs(options_, run_, source_, messages_);
    run_.times.writing = watch.milliseconds();
    run_.times.total = total_.milliseconds();
    if (!options_.page.empty())
      io::writeFile(options_.page, formatPageOf(run_, options_.typed));
    if (!options_.quiet && options_.json != "-")
      std::cout << formatReport(run_) << std::flush;
    if (options_.json.empty())
      return;
    const std::string json = formatJson(run_, WithTimes::Yes);
    if (options_.json == "-")
      std::cout << json << std::flush;
    else
      io::writeFile(options_.json, json);
  }

  const detail::Stopwatch total_;
  const Options& options_;
  const batch::Ranks& ranks_;
  Messages messages_;
  ScanStore store_;
  MultiviewRegistration registration_;
  MultiviewRegistration::ScanSource source_ = [this](std::size_t scan) {
    return store_.get(scan);
  };
  ScanSet scans_;
  MapRun run_;
};

Verdict
run(Options options, const batch::Ranks& ranks)
{
  // The others would say the same.
  options.quiet = options.quiet || ranks.rank() > 0;
  if (ranks.size() > 1 && (options.pairs.empty() || options.shard))
    throw UsageError(
        "several ranks need an output, or --pairs, in a folder that all of "
        "them see, and no --shard");
  const std::vector<ScanFile> files = program::findScans(options.scans, options.list);
  checkOutputs(options, files);
  checkPairsFile(options);
  return MapMaker(options, ranks).make(files);
}

} // namespace
} // namespace pcl_flashreg::map

int
main(int argc, char** argv)
{
  using namespace pcl_flashreg;
  // PCL's own messages would stand between the user and ours.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const batch::Ranks ranks;
  const int status = program::run("pcl_flashreg_map", [&] {
    const std::optional<map::Options> options = map::parseOptions(argc, argv);
    return options ? map::run(*options, ranks) : map::COMPLETE;
  });
  return status <= map::NOT_COMPLETE ? status : ranks.abort(status);
}
