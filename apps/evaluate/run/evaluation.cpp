// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "evaluation.h"

#include "../features/correspondences.h"
#include "../features/feature_store.h"
#include "../features/truth.h"
#include "../methods/registry.h"
#include "../results/judge.h"
#include "progress.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <stdexcept>

namespace pcl_flashreg::evaluate {
namespace {

/** \brief The least that fixes a pose: methods need not know what to do with fewer. */
constexpr std::size_t LEAST_CORRESPONDENCES = 3;

struct NamedMethod {
  std::string name;
  Method run;
};

std::vector<NamedMethod>
makeMethods(const Options& options, const Job& job)
{
  const MethodSettings settings{job.parameters, job.data.leaf, options.threads};
  std::vector<NamedMethod> made;
  for (const std::string& name : options.methods)
    try {
      made.push_back({name, findMethod(name)->make(settings)});
    }
    catch (const std::invalid_argument& error) {
      throw UsageError("--method: " + name + ": " + error.what());
    }
  return made;
}

/** \brief A pair, ready for the methods. */
struct Prepared {
  FeatureStore::Cloud source, target;
  Correspondences correspondences;
  Times times;
};

Prepared
prepare(const Pair& pair, const Options& options, const Job& job, FeatureStore& store)
{
  Prepared prepared;
  if (!pair.correspondences.empty()) {
    prepared.correspondences =
        readCorrespondences(job.data.root + "/" + pair.correspondences);
    return prepared;
  }
  prepared.source = store.get(pair.source);
  prepared.target = store.get(pair.target);
  prepared.times.features = prepared.source->features_ms + prepared.target->features_ms;
  const detail::Stopwatch matching;
  prepared.correspondences = matchClouds(
      *prepared.source, *prepared.target, options.neighbors, options.threads);
  prepared.times.matching = matching.milliseconds();
  return prepared;
}

std::vector<Record>
evaluatePair(std::size_t number,
             const Pair& pair,
             const RigidTransform& truth,
             const Prepared& prepared,
             const std::vector<NamedMethod>& methods,
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
  const Problem problem{
      prepared.correspondences, prepared.source.get(), prepared.target.get()};
  std::vector<Record> records;
  for (const NamedMethod& method : methods) {
    record.method = method.name;
    record.times = prepared.times;
    const Answer answer =
        record.correspondences < LEAST_CORRESPONDENCES ? Answer() : method.run(problem);
    judge(answer, truth, job.data.criterion, record);
    records.push_back(record);
  }
  return records;
}

} // namespace

void
evaluatePairs(const Options& options,
              const Job& job,
              const std::vector<std::size_t>& pairs,
              bool quiet,
              const std::function<void(const std::vector<Record>&)>& done)
{
  const std::vector<NamedMethod> methods = makeMethods(options, job);
  FeatureStore store(job.data.root, job.data.leaf, options.threads, options.cache);
  const TruthStore truths(job.data.root, options.cache);
  const auto pairAt = [&](std::size_t position) -> const Pair& {
    return job.data.pairs[job.pairs[position]];
  };
  for (const std::size_t position : pairs)
    store.expect(pairAt(position));
  Progress progress(pairs.size(), quiet);
  for (const std::size_t position : pairs) {
    const Pair& pair = pairAt(position);
    const Prepared prepared = prepare(pair, options, job, store);
    done(evaluatePair(position, pair, truths.get(pair), prepared, methods, job));
    store.release(pair);
    progress.step();
  }
}

} // namespace pcl_flashreg::evaluate
