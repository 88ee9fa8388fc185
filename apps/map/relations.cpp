// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "relations.h"

#include "../batch/parts.h"
#include "../batch/progress.h"
#include "../batch/split.h"
#include "../io/error.h"
#include "pairs_file.h"

#include <filesystem>

namespace fs = std::filesystem;

namespace pcl_flashreg::map {
namespace {

/** \brief Kinds of batch::partPath(). */
constexpr const char *RANK = "rank", *SHARD = "shard";

std::string
shardPath(const Options& options)
{
  return batch::partPath(options.pairs, SHARD, options.shard->index);
}

/** \brief What may be left of earlier runs; a shard does not look at the others, which may
 * be at work. */
std::vector<std::string>
filesOf(const Options& options)
{
  std::vector<std::string> files;
  if (options.pairs.empty())
    return files;
  if (fs::exists(options.pairs))
    files.push_back(options.pairs);
  if (options.shard) {
    if (fs::exists(shardPath(options)))
      files.push_back(shardPath(options));
    return files;
  }
  for (const char* kind : {RANK, SHARD})
    for (const std::string& part : batch::partsOf(options.pairs, kind))
      files.push_back(part);
  return files;
}

} // namespace

void
checkPairsFile(const Options& options)
{
  if (options.resume || options.add)
    return;
  for (const std::string& file : filesOf(options))
    throw UsageError(file +
                     " is there already: --resume goes on with it, --add takes more "
                     "scans in, or remove it");
}

std::optional<double>
resolutionOfPairs(const Options& options)
{
  for (const std::string& file : filesOf(options))
    return readPairs(file).config["leaf"].get<double>();
  return std::nullopt;
}

PairRelations::PairRelations(const Options& options,
                             const ScanSet& scans,
                             const MultiviewRegistration::ScanSource& source,
                             const batch::Ranks& ranks,
                             MultiviewRegistration& registration)
    : options_(options),
      source_(source),
      ranks_(ranks),
      registration_(registration),
      config_(pairsConfig(options, scans))
{
  if (options.pairs.empty())
    return;
  if (options.shard) {
    if (fs::exists(options.pairs))
      readInto(options.pairs, known_);
    return;
  }
  if (ranks.rank() == 0)
    putTogether();
  ranks.wait();
  if (ranks.rank() > 0)
    readInto(options.pairs, known_);
}

std::vector<ScanRelation>
PairRelations::of(const std::vector<ScanPair>& pairs)
{
  const std::vector<ScanPair> unknown = missing(known_, pairs);
  known_before_ += pairs.size() - unknown.size();
  if (ranks_.size() > 1)
    relateWithRanks(unknown);
  else
    relateTo(options_.pairs, unknown, known_);
  std::vector<ScanRelation> relations;
  for (const ScanPair& pair : pairs)
    relations.push_back(known_.at(pair));
  return relations;
}

bool
PairRelations::relateShard(const std::vector<ScanPair>& pairs)
{
  const std::vector<ScanPair> unknown = missing(known_, pairs);
  if (unknown.empty())
    return false;
  const std::string part = shardPath(options_);
  Known of_shard;
  if (fs::exists(part))
    readInto(part, of_shard);
  write(part, of_shard);
  relateTo(
      part,
      missing(of_shard,
              batch::partOf(unknown, options_.shard->index - 1, options_.shard->count)),
      of_shard);
  write(part, of_shard);
  return true;
}

void
PairRelations::finish() const
{
  if (!options_.pairs.empty() && ranks_.rank() == 0)
    write(options_.pairs, known_);
}

std::vector<PairRelations::ScanPair>
PairRelations::missing(const Known& known, const std::vector<ScanPair>& pairs)
{
  std::vector<ScanPair> list;
  for (const ScanPair& pair : pairs)
    if (known.count(pair) == 0)
      list.push_back(pair);
  return list;
}

void
PairRelations::readInto(const std::string& path, Known& known) const
{
  for (ScanRelation& relation : knownRelations(path, config_, options_.add)) {
    const ScanPair pair(relation.target, relation.source);
    known.emplace(pair, std::move(relation));
  }
}

void
PairRelations::write(const std::string& path, const Known& known) const
{
  PairsFile pairs{config_, {}};
  for (const auto& [pair, relation] : known)
    pairs.relations.push_back(relation);
  writePairs(path, pairs);
}

/** \brief One file from all that there are. */
void
PairRelations::putTogether()
{
  const std::vector<std::string> files = filesOf(options_);
  for (const std::string& file : files)
    readInto(file, known_);
  write(options_.pairs, known_);
  for (const std::string& file : files)
    if (file != options_.pairs)
      fs::remove(file);
}

/** \brief Registers the pairs. The file, which has its header, is closed when it returns:
 * only then another machine is sure to see it all. */
void
PairRelations::relateTo(const std::string& path,
                        const std::vector<ScanPair>& pairs,
                        Known& known)
{
  if (pairs.empty())
    return;
  std::optional<PairsAppender> file;
  if (!path.empty())
    file.emplace(path);
  batch::Progress progress(pairs.size(), "pairs", options_.quiet);
  MultiviewOptions options = options_.multiview();
  options.on_relation = [&](const ScanRelation& relation, std::size_t, std::size_t) {
    if (file)
      file->append(relation);
    known[{relation.target, relation.source}] = relation;
    progress.step();
  };
  registration_.relate(source_, pairs, options);
}

/** \brief Each rank appends to a part of its own; the first one puts the parts together. */
void
PairRelations::relateWithRanks(const std::vector<ScanPair>& pairs)
{
  if (pairs.empty())
    return;
  const std::string part = batch::partPath(options_.pairs, RANK, ranks_.rank());
  Known mine;
  write(part, mine);
  relateTo(part, batch::partOf(pairs, ranks_.rank(), ranks_.size()), mine);
  ranks_.wait();
  if (ranks_.rank() == 0)
    putTogether();
  ranks_.wait();
  if (ranks_.rank() > 0)
    readInto(options_.pairs, known_);
  const std::size_t lost = missing(known_, pairs).size();
  if (lost > 0)
    throw io::InputError(options_.pairs + ": rows of " + std::to_string(lost) +
                         " pairs are not to be seen: is its folder the same for every "
                         "rank? (--resume goes on)");
}

} // namespace pcl_flashreg::map
