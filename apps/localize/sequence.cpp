// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "sequence.h"

#include "../io/file.h"
#include "../io/pose_io.h"

#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/impl/stopwatch.hpp>

#include <algorithm>
#include <utility>

namespace pcl_flashreg::localize {
namespace {

/** \brief A sequence with a scan elsewhere is not where it is known to be. */
void
judgeNear(const Near& near, LocatedSequence& sequence)
{
  if (sequence.result.placements.empty())
    return;
  double farthest = 0;
  for (const RigidTransform& T : sequence.result.placements.front().T_map_scan)
    farthest = std::max(farthest, (T.translation - near.centre).norm());
  if (farthest <= near.radius)
    return;
  sequence.warnings.push_back(beyondNear(farthest, near, sequence.isTrusted()));
  sequence.result.converged = false;
}

/** \brief What the sequence says of its scans.
 * \param[in] used numbers of those that it is made of */
void
tellScans(const SequenceResult& result,
          const std::vector<std::size_t>& used,
          std::vector<Located>& scans)
{
  for (std::size_t k = 0; k < used.size(); ++k) {
    InSequence& told = scans[used[k]].in_sequence.emplace();
    told.is_trusted = result.converged;
    told.confidence = result.confidence;
    if (result.placements.empty())
      continue;
    told.T_map_scan = result.placements.front().T_map_scan[k];
    told.agreement = result.placements.front().agreement_of_scan[k];
  }
}

} // namespace

std::vector<const SequencePlacement*>
rivalsOf(const SequenceResult& result)
{
  std::vector<const SequencePlacement*> rivals;
  for (std::size_t i = 1; i < result.placements.size() && rivals.size() < MOST_RIVALS;
       ++i)
    if (isRival(result.placements[i].agreement, result.evidence.agreement))
      rivals.push_back(&result.placements[i]);
  return rivals;
}

std::vector<RigidTransform>
sequencePoses(const Options& options, const std::vector<program::ScanFile>& files)
{
  std::vector<std::string> paths;
  for (const program::ScanFile& file : files)
    paths.push_back(file.path);
  return io::parseFile(options.sequence, [&](const std::string& text) {
    return io::posesOf(paths, io::parsePoses(text));
  });
}

LocatedSequence
locateSequence(const Options& options,
               const std::vector<program::ScanFile>& files,
               Locator& locator,
               std::vector<Located>& scans)
{
  const std::vector<RigidTransform> poses = sequencePoses(options, files);
  LocatedSequence sequence;
  sequence.file = options.sequence;
  std::vector<SequenceScan> members;
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < files.size(); ++i) {
    SequenceScan member;
    member.T_sequence_scan = poses[i];
    scans.push_back(locator.locate(files[i], poses[i], member.scan));
    if (!scans.back().error.empty())
      continue;
    member.alone = scans.back().result;
    members.push_back(std::move(member));
    used.push_back(i);
  }
  const detail::Stopwatch watch;
  sequence.scans = members.size();
  PairOptions pair_options;
  pair_options.parameters = options.parameters;
  sequence.result =
      localizeSequence(members, locator.map(), pair_options, options.threads);
  if (options.near)
    judgeNear(*options.near, sequence);
  sequence.placing = watch.milliseconds();
  tellScans(sequence.result, used, scans);
  return sequence;
}

} // namespace pcl_flashreg::localize
