// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "map_index.h"

#include "../batch/front_end.h"
#include "../io/error.h"
#include "../program/rounded.h"
#include "index_stamp.h"
#include "input_scan.h"

#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/impl/stopwatch.hpp>

#include <cmath>
#include <filesystem>
#include <optional>

namespace fs = std::filesystem;

namespace pcl_flashreg::localize {
namespace {

using program::Messages;
using program::rounded;

bool
isSameLength(double a, double b)
{
  constexpr double SAME = 1e-6;
  return std::abs(a - b) <= SAME * b;
}

std::string
sizesOf(const ScanIndex& index)
{
  return std::to_string(index.scan().size()) + " keypoints at a resolution of " +
         detail::toText(index.scan().spacing()) + ", " +
         rounded(static_cast<double>(index.bytes()) / 1e6, 1) + " MB";
}

class MapOpener {
public:
  MapOpener(const Options& options,
            PairRegistration& registration,
            const Messages& messages)
      : options_(options), registration_(registration), messages_(messages)
  {
  }

  ScanIndex
  open(const std::function<double()>& resolution) const
  {
    if (!fs::exists(options_.map))
      throw io::InputError(options_.map + ": no such file");
    if (fs::is_directory(options_.map))
      throw UsageError(options_.map +
                       ": is a folder: pcl_flashreg_map makes a map of its scans");
    const FileKind kind = kindOf(options_.map);
    if (kind == FileKind::Index) {
      if (!options_.index.empty())
        throw UsageError("--index: " + options_.map + " is an index already");
      return opened(options_.map);
    }
    if (!options_.index.empty() && fs::exists(options_.index) && isUsable())
      return kept();
    const detail::Stopwatch watch;
    return made(kind == FileKind::Scan ? savedScan() : scanAt(resolution), watch);
  }

private:
  ScanIndex
  opened(const std::string& path) const
  {
    const detail::Stopwatch watch;
    const ScanIndex index = ScanIndex::open(path, options_.verify);
    const double spacing = index.scan().spacing();
    if (options_.leaf && !isSameLength(*options_.leaf, spacing))
      refuseLeaf(path, spacing);
    messages_.note(path + ": opened in " + rounded(watch.milliseconds(), 1) +
                   " ms: " + sizesOf(index));
    return index;
  }

  ScanIndex
  kept() const
  {
    try {
      return opened(options_.index);
    }
    catch (const ScanFileError& error) {
      throw io::InputError(error.what() +
                           std::string("; once it is removed, it is made again"));
    }
  }

  [[noreturn]] void
  refuseLeaf(const std::string& path, double spacing) const
  {
    throw UsageError("--leaf " + detail::toText(*options_.leaf) + ": " + path +
                     " was made at " + detail::toText(spacing) +
                     ": leave --leaf out, or name another index");
  }

  /** \brief Whether the index that is there was made of this map; if it is the map's,
   * but of an earlier state of it, nothing is lost by making it again. */
  bool
  isUsable() const
  {
    const std::optional<IndexStamp> stamp = readStamp(options_.index);
    if (kindOf(options_.index) != FileKind::Index)
      throw io::InputError(options_.index +
                           ": is there already, and is no index: name another file");
    if (!stamp)
      throw UsageError(options_.index + ": is there already, and " +
                       stampPathOf(options_.index) +
                       " does not tell what it was made of: give it in place of the "
                       "map, or remove it");
    const bool is_same = isOf(*stamp, options_.map, options_.bin_fields);
    std::error_code error;
    if (!is_same && !fs::equivalent(stamp->map, options_.map, error))
      throw UsageError(options_.index + ": was made of " + stamp->map + ", not of " +
                       options_.map + ": name another index, or remove it");
    if (options_.leaf && !isSameLength(*options_.leaf, stamp->leaf))
      refuseLeaf(options_.index, stamp->leaf);
    const bool is_current = stamp->front_end == batch::frontEndFingerprint();
    if (!is_same)
      messages_.note(options_.index + ": " + options_.map +
                     " has changed since it was made: it is made again");
    else if (!is_current)
      messages_.note(options_.index +
                     ": was made by another version of this program: it is made again");
    return is_same && is_current;
  }

  Scan
  savedScan() const
  {
    const Scan scan = loadScan(options_.map);
    if (options_.leaf && !isSameLength(*options_.leaf, scan.spacing()))
      throw UsageError("--leaf " + detail::toText(*options_.leaf) + ": " +
                       options_.map + " was saved at " +
                       detail::toText(scan.spacing()));
    return scan;
  }

  /** \brief A map was seen from many places: no viewpoint in its file counts. */
  Scan
  scanAt(const std::function<double()>& resolution) const
  {
    ScanSettings settings;
    settings.spacing = options_.leaf ? *options_.leaf : resolution();
    if (!options_.leaf)
      messages_.note("a resolution of " + detail::toText(settings.spacing) +
                     " suits the scans; --leaf sets another");
    settings.bin_fields = options_.bin_fields;
    settings.viewpoint_known = false;
    settings.many_viewpoints = true;
    messages_.say("reading " + options_.map);
    const InputScan input = readScan(options_.map, settings, registration_);
    for (const std::string& warning : input.warnings)
      messages_.note(options_.map + ": " + warning);
    return input.scan;
  }

  ScanIndex
  made(const Scan& scan, const detail::Stopwatch& watch) const
  {
    messages_.say("making the index");
    const ScanIndex index = registration_.makeIndex(scan);
    messages_.note(options_.map + ": index made in " +
                   rounded(watch.milliseconds() / 1000, 2) + " s: " + sizesOf(index) +
                   (options_.index.empty() ? "" : "; kept in " + options_.index));
    if (!options_.index.empty())
      keep(index);
    return index;
  }

  void
  keep(const ScanIndex& index) const
  {
    // Never a stamp that is another index's, wherever this ends.
    fs::remove(stampPathOf(options_.index));
    index.save(options_.index);
    const IndexStamp stamp = stampOf(
        options_.map, options_.index, index.scan().spacing(), options_.bin_fields);
    writeStamp(stamp, options_.index);
  }

  const Options& options_;
  PairRegistration& registration_;
  const Messages& messages_;
};

} // namespace

ScanIndex
openMap(const Options& options,
        const std::function<double()>& resolution,
        PairRegistration& registration,
        const Messages& messages)
{
  return MapOpener(options, registration, messages).open(resolution);
}

} // namespace pcl_flashreg::localize
