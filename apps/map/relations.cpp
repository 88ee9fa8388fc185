// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "relations.h"

#include "../batch/parts.h"
#include "../batch/progress.h"
#include "../batch/split.h"
#include "../io/error.h"
#include "pairs_file.h"

#include <algorithm>
#include <filesystem>
#include <map>

namespace fs = std::filesystem;

namespace pcl_flashreg::map {
namespace {

using ScanPair = MultiviewRegistration::ScanPair;
using RelationMap = std::map<ScanPair, ScanRelation>;

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

class Relating {
public:
  Relating(const Options& options,
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
    pairs_ = registration.choosePairs(scans.files.size(), source, options.multiview());
    std::sort(pairs_.begin(), pairs_.end());
  }

  Relations
  run()
  {
    if (options_.pairs.empty())
      return inMemory();
    return options_.shard ? shard() : withFiles();
  }

private:
  Relations
  inMemory()
  {
    RelationMap known;
    relate(pairs_, options_.quiet, [&](const ScanRelation& relation) {
      known[{relation.target, relation.source}] = relation;
    });
    return {listOf(known, pairs_), 0};
  }

  /** \brief Rows go to the shard's part as they come. */
  Relations
  shard()
  {
    RelationMap known;
    if (fs::exists(options_.pairs))
      readInto(options_.pairs, known);
    const std::string part = shardPath(options_);
    const std::vector<ScanPair> pairs =
        batch::partOf(missing(known), options_.shard->index - 1, options_.shard->count);
    known.clear();
    if (fs::exists(part))
      readInto(part, known);
    const std::size_t before = known.size();
    write(part, known, pairs);
    append(part, missing(known, pairs), options_.quiet);
    known.clear();
    readInto(part, known);
    write(part, known, pairs);
    return {listOf(known, pairs), before};
  }

  /** \brief Rows go to files as they come: one process appends to the file itself, each of
   * several ranks to a part of its own, which the first one puts together. */
  Relations
  withFiles()
  {
    const bool first = ranks_.rank() == 0;
    if (first)
      putTogether();
    ranks_.wait();
    RelationMap known;
    readInto(options_.pairs, known);
    const std::size_t before = known.size();
    const std::vector<ScanPair> mine =
        batch::partOf(missing(known), ranks_.rank(), ranks_.size());
    ranks_.wait();
    std::string path = options_.pairs;
    if (ranks_.size() > 1) {
      path = batch::partPath(options_.pairs, RANK, ranks_.rank());
      writePairs(path, {config_, {}});
    }
    append(path, mine, options_.quiet || !first);
    ranks_.wait();
    if (!first)
      return {};
    known = putTogether();
    const std::size_t lost = missing(known).size();
    if (lost > 0)
      throw io::InputError(
          options_.pairs + ": rows of " + std::to_string(lost) +
          " pairs are not to be seen: is its folder the same for every "
          "rank? (--resume goes on)");
    return {listOf(known, pairs_), before};
  }

  /** \brief One file from all that there are. */
  RelationMap
  putTogether() const
  {
    RelationMap known;
    const std::vector<std::string> files = filesOf(options_);
    for (const std::string& file : files)
      readInto(file, known);
    write(options_.pairs, known, pairs_);
    for (const std::string& file : files)
      if (file != options_.pairs)
        fs::remove(file);
    return known;
  }

  void
  readInto(const std::string& path, RelationMap& known) const
  {
    for (ScanRelation& relation : knownRelations(path, config_, options_.add)) {
      const ScanPair pair(relation.target, relation.source);
      known.emplace(pair, std::move(relation));
    }
  }

  void
  write(const std::string& path,
        const RelationMap& known,
        const std::vector<ScanPair>& pairs) const
  {
    writePairs(path, {config_, listOf(known, pairs)});
  }

  /** \brief Closed when it returns: only then another machine is sure to see it all. */
  void
  append(const std::string& path, const std::vector<ScanPair>& pairs, bool quiet)
  {
    PairsAppender file(path);
    relate(pairs, quiet, [&](const ScanRelation& relation) { file.append(relation); });
  }

  template <typename Take>
  void
  relate(const std::vector<ScanPair>& pairs, bool quiet, const Take& take)
  {
    if (pairs.empty())
      return;
    batch::Progress progress(pairs.size(), "pairs", quiet);
    MultiviewOptions options = options_.multiview();
    options.on_relation = [&](const ScanRelation& relation, std::size_t, std::size_t) {
      take(relation);
      progress.step();
    };
    registration_.relate(source_, pairs, options);
  }

  std::vector<ScanPair>
  missing(const RelationMap& known) const
  {
    return missing(known, pairs_);
  }

  static std::vector<ScanPair>
  missing(const RelationMap& known, const std::vector<ScanPair>& pairs)
  {
    std::vector<ScanPair> list;
    for (const ScanPair& pair : pairs)
      if (known.count(pair) == 0)
        list.push_back(pair);
    return list;
  }

  /** \brief Those of the pairs, in their order: what a file holds besides is of pairs that
   * are not worth a try any more. */
  static std::vector<ScanRelation>
  listOf(const RelationMap& known, const std::vector<ScanPair>& pairs)
  {
    std::vector<ScanRelation> list;
    for (const ScanPair& pair : pairs)
      if (const auto found = known.find(pair); found != known.end())
        list.push_back(found->second);
    return list;
  }

  const Options& options_;
  const MultiviewRegistration::ScanSource& source_;
  const batch::Ranks& ranks_;
  MultiviewRegistration& registration_;
  batch::Config config_;
  std::vector<ScanPair> pairs_;
};

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

Relations
relateScans(const Options& options,
            const ScanSet& scans,
            const MultiviewRegistration::ScanSource& source,
            const batch::Ranks& ranks,
            MultiviewRegistration& registration)
{
  return Relating(options, scans, source, ranks, registration).run();
}

} // namespace pcl_flashreg::map
