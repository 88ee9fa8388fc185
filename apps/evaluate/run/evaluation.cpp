// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "evaluation.h"

#include "../../io/cloud_io.h"
#include "../features/correspondences.h"
#include "../features/feature_store.h"
#include "../features/truth.h"
#include "../methods/registry.h"
#include "../results/judge.h"
#include "../../batch/progress.h"
#include "scene_maps.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <filesystem>
#include <stdexcept>

namespace pcl_flashreg::evaluate {
namespace {

/** \brief The least that fixes a pose: methods need not know what to do with fewer. */
constexpr std::size_t LEAST_CORRESPONDENCES = 3;

struct NamedMethod {
  std::string name;
  /** \brief Empty for a method of whole scenes. */
  Method run;
};

std::vector<NamedMethod>
makeMethods(const Options& options, const Job& job)
{
  const MethodSettings settings{job.parameters, job.data.leaf, options.threads};
  std::vector<NamedMethod> made;
  for (const std::string& name : options.methods)
    try {
      made.push_back(
          {name,
           findMethod(name)->of_scenes ? Method() : findMethod(name)->make(settings)});
    }
    catch (const std::invalid_argument& error) {
      throw UsageError("--method: " + name + ": " + error.what());
    }
  return made;
}

/** \brief A pair, ready for the methods. */
struct Prepared {
  Scan source, target;
  Correspondences correspondences;
  std::vector<FeatureMatch> matches;
  Times times;
};

/** \brief Data sets of correspondences may bring the clouds along. */
bool
hasClouds(const Pair& pair, const Job& job)
{
  const auto is_cloud = [&](const std::string& path) {
    const std::string file = job.data.root + "/" + path;
    return io::isReadableCloudPath(file) && std::filesystem::is_regular_file(file);
  };
  return is_cloud(pair.source) && is_cloud(pair.target);
}

void
takeScans(const Pair& pair,
          ScanContent content,
          FeatureStore& store,
          Prepared& prepared)
{
  const auto source = store.get(pair.source, content);
  const auto target = store.get(pair.target, content);
  prepared.source = source->scan;
  prepared.target = target->scan;
  prepared.times.features = source->features_ms + target->features_ms;
}

Prepared
prepare(const Pair& pair,
        const Options& options,
        const Job& job,
        FeatureStore& store,
        PairRegistration& registration)
{
  Prepared prepared;
  if (!pair.correspondences.empty()) {
    prepared.correspondences =
        readCorrespondences(job.data.root + "/" + pair.correspondences);
    if (hasClouds(pair, job))
      takeScans(pair, ScanContent::Surface, store, prepared);
    return prepared;
  }
  takeScans(pair, ScanContent::Descriptors, store, prepared);
  PairOptions matching;
  matching.neighbors = options.neighbors;
  const detail::Stopwatch stopwatch;
  prepared.matches = registration.match(prepared.source, prepared.target, matching);
  prepared.correspondences =
      toCorrespondences(prepared.source, prepared.target, prepared.matches);
  prepared.times.matching = stopwatch.milliseconds();
  return prepared;
}

std::vector<Record>
evaluatePair(std::size_t number,
             const Pair& pair,
             const RigidTransform& truth,
             const Prepared& prepared,
             const std::vector<NamedMethod>& methods,
             const Method& of_scenes,
             const Job& job)
{
  Record record;
  record.pair = number;
  record.dataset = pair.dataset;
  record.scene = pair.scene;
  record.source = pair.source;
  record.target = pair.target;
  record.correspondences = prepared.correspondences.size();
  record.inlier_ratio =
      inlierRatio(prepared.correspondences, truth, job.parameters.inlier_distance);
  const std::string name = pair.source + " " + pair.target;
  const Problem problem{prepared.correspondences,
                        prepared.matches,
                        prepared.source,
                        prepared.target,
                        name,
                        truth};
  std::vector<Record> records;
  for (const NamedMethod& method : methods) {
    record.method = method.name;
    record.times = prepared.times;
    Answer answer;
    if (!method.run)
      answer = of_scenes(problem);
    else if (record.correspondences >= LEAST_CORRESPONDENCES)
      answer = method.run(problem);
    judge(answer, truth, job.data.criterion, record);
    records.push_back(record);
  }
  return records;
}

} // namespace

std::vector<MapSummary>
evaluatePairs(const Options& options,
              const Job& job,
              const std::vector<std::size_t>& pairs,
              bool quiet,
              const std::function<void(const std::vector<Record>&)>& done)
{
  const std::vector<NamedMethod> methods = makeMethods(options, job);
  FeatureStore store(job.data.root,
                     job.data.leaf,
                     options.threads,
                     options.cache,
                     options.descriptors,
                     job.data.bin_fields);
  PairRegistration registration(BackendKind::Cpu, options.threads);
  const TruthStore truths(job.data.root, options.cache, job.data.bin_fields);
  SceneMaps maps(options, job);
  const auto pairAt = [&](std::size_t position) -> const Pair& {
    return job.data.pairs[job.pairs[position]];
  };
  for (const std::size_t position : pairs)
    store.expect(pairAt(position));
  batch::Progress progress(pairs.size(), "pairs", quiet);
  for (const std::size_t position : pairs) {
    const Pair& pair = pairAt(position);
    const Prepared prepared = prepare(pair, options, job, store, registration);
    const Method of_scenes = [&](const Problem&) { return maps.answer(pair, store); };
    done(evaluatePair(
        position, pair, truths.get(pair), prepared, methods, of_scenes, job));
    store.release(pair);
    progress.step();
  }
  return maps.summaries();
}

} // namespace pcl_flashreg::evaluate
