// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The order of the steps, from scans to a map.

#include <pcl_flashreg/multiview_registration.h>

#include "multiview/map_builder.h"
#include "multiview/pair_choice.h"
#include "multiview/relation.h"
#include "registration/pair_call.h"
#include "registration/side_by_side.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

namespace pcl_flashreg {
namespace {

void
checkOptions(const MultiviewOptions& options)
{
  if (!(options.min_confidence > 0 && options.min_confidence < 1))
    throw std::invalid_argument("min_confidence is " +
                                std::to_string(options.min_confidence) +
                                ", but must be in (0, 1)");
  if (options.alike == 0)
    throw std::invalid_argument("alike is 0, but must be >= 1");
}

} // namespace

class MultiviewRegistration::Impl {
public:
  Impl(BackendKind backend, unsigned num_threads)
      : first(backend, num_threads),
        pool(first.search.pool()),
        pairs(first, pool, pool.size())
  {
  }

  PairWorkers first;
  ThreadPool& pool;
  SideBySide<PairWorkers> pairs;
};

MultiviewRegistration::MultiviewRegistration(BackendKind backend, unsigned num_threads)
    : impl_(std::make_unique<Impl>(backend, num_threads))
{
}

MultiviewRegistration::~MultiviewRegistration() = default;
MultiviewRegistration::MultiviewRegistration(MultiviewRegistration&&) noexcept =
    default;
MultiviewRegistration&
MultiviewRegistration::operator=(MultiviewRegistration&&) noexcept = default;

std::vector<MultiviewRegistration::ScanPair>
MultiviewRegistration::allPairs(std::size_t scans)
{
  std::vector<ScanPair> pairs;
  for (std::size_t target = 0; target < scans; ++target)
    for (std::size_t source = target + 1; source < scans; ++source)
      pairs.emplace_back(target, source);
  return pairs;
}

std::vector<ScanRelation>
MultiviewRegistration::relate(const ScanSource& scans,
                              const std::vector<ScanPair>& pairs,
                              const MultiviewOptions& options)
{
  checkOptions(options);
  const PairOptions pair_options = withRivals(options.pair);
  std::vector<ScanRelation> relations(pairs.size());
  std::mutex reporting;
  std::size_t done = 0;
  impl_->pairs.forEach(pairs.size(), [&](PairWorkers& workers, std::size_t i) {
    const auto [target, source] = pairs[i];
    relations[i].target = target;
    relations[i].source = source;
    const Result result =
        alignScans(workers, scans(source), scans(target), pair_options).pose;
    relations[i].poses = posesOf(result);
    relations[i].overruled_viewpoints = result.evidence.overruled_viewpoints;
    if (options.on_relation) {
      const std::lock_guard lock(reporting);
      options.on_relation(relations[i], ++done, pairs.size());
    }
  });
  return relations;
}

MultiviewResult
MultiviewRegistration::place(std::size_t count,
                             const ScanSource& scans,
                             const std::vector<ScanRelation>& relations,
                             const MultiviewOptions& options)
{
  checkOptions(options);
  const detail::Stopwatch watch;
  MapBuilder builder(count, scans, options.min_confidence, impl_->pool);
  builder.add(relations);
  builder.group();
  const double grouping = watch.milliseconds();
  MultiviewResult result = builder.finish();
  result.timings.grouping = grouping;
  result.timings.total = watch.milliseconds();
  result.timings.refinement = result.timings.total - grouping;
  return result;
}

MultiviewResult
MultiviewRegistration::align(std::size_t count,
                             const ScanSource& scans,
                             const Relate& relate,
                             const MultiviewOptions& options)
{
  checkOptions(options);
  const detail::Stopwatch total;
  MultiviewTimings spent;
  const auto timed = [](double& spent_on_it, const auto& work) {
    const detail::Stopwatch watch;
    work();
    spent_on_it += watch.milliseconds();
  };
  std::optional<PairChoice> choice;
  std::optional<MapBuilder> builder;
  std::vector<ScanPair> pairs;
  timed(spent.relations, [&] {
    choice.emplace(count, scans, options, impl_->pool);
    pairs = choice->first();
  });
  timed(spent.grouping,
        [&] { builder.emplace(count, scans, options.min_confidence, impl_->pool); });
  do {
    timed(spent.relations, [&] { builder->add(relate(pairs)); });
    timed(spent.grouping, [&] { builder->group(); });
    timed(spent.relations,
          [&] { pairs = choice->next(builder->relations(), builder->groups()); });
  } while (!pairs.empty());
  MultiviewResult result;
  timed(spent.refinement, [&] { result = builder->finish(); });
  spent.total = total.milliseconds();
  result.timings = spent;
  return result;
}

MultiviewResult
MultiviewRegistration::align(const std::vector<Scan>& scans,
                             const MultiviewOptions& options)
{
  const ScanSource source = [&](std::size_t i) { return scans[i]; };
  return align(
      scans.size(),
      source,
      [&](const std::vector<ScanPair>& pairs) {
        return relate(source, pairs, options);
      },
      options);
}

std::size_t
MultiviewResult::placed() const
{
  std::size_t count = 0;
  for (const std::vector<std::size_t>& group : groups)
    count += group.size() > 1 ? group.size() : 0;
  return count;
}

} // namespace pcl_flashreg
