// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan_reader.h"

#include "../batch/front_end.h"
#include "../batch/progress.h"
#include "../io/error.h"
#include "../io/file.h"
#include "../io/hash.h"
#include "../io/input_cloud.h"
#include "../io/scan_input.h"

#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/pair_registration.h>

#include <algorithm>
#include <map>
#include <utility>

namespace pcl_flashreg::map {
namespace {

using program::Messages;

/** \brief The least that fixes a pose. */
constexpr std::size_t LEAST_POINTS = 3;

/** \brief What is the same for many files is said once, after the last of them: a line in
 * between would tear the bar of the progress. */
class Notes {
public:
  void
  add(const std::string& path, const std::string& note)
  {
    const auto found = std::find_if(notes_.begin(), notes_.end(), [&](const Note& one) {
      return one.text == note;
    });
    if (found == notes_.end())
      notes_.push_back({path, note, 0});
    else
      ++found->others;
  }

  void
  print(const Messages& messages) const
  {
    for (const Note& note : notes_)
      messages.note(
          note.path +
          (note.others == 0 ? "" : " and " + std::to_string(note.others) + " others") +
          ": " + note.text);
  }

private:
  struct Note {
    std::string path, text;
    std::size_t others;
  };

  std::vector<Note> notes_;
};

class ScanReader {
public:
  ScanReader(const Options& options, const Messages& messages, ScanStore& store)
      : options_(options),
        messages_(messages),
        store_(store),
        maker_(BackendKind::Cpu, options.threads)
  {
  }

  ScanSet
  read(std::vector<ScanFile> files, std::optional<double> resolution)
  {
    set_.estimated = !resolution;
    if (!resolution)
      resolution = estimate(files);
    set_.resolution = *resolution;
    settings_ = settings();
    forEach(files, "scans", [&](const ScanFile& file) { take(file); });
    for (const LeftOutFile& file : set_.left_out)
      messages_.note(file.path + ": " + file.reason + "; it is left out");
    notes_.print(messages_);
    noteViewpoints();
    requireTwo(set_.files.size());
    return std::move(set_);
  }

private:
  /** \brief Does something with each file; those that it throws for are left out. */
  template <typename Use>
  void
  forEach(const std::vector<ScanFile>& files, const std::string& things, const Use& use)
  {
    batch::Progress progress(files.size(), things, options_.quiet);
    for (const ScanFile& file : files) {
      try {
        use(file);
      }
      catch (const io::InputError& error) {
        leaveOut(file, error.what());
      }
      catch (const std::invalid_argument& error) {
        leaveOut(file, error.what());
      }
      progress.step();
    }
  }

  void
  leaveOut(const ScanFile& file, std::string reason)
  {
    const std::string prefix = file.path + ": ";
    if (reason.rfind(prefix, 0) == 0)
      reason.erase(0, prefix.size());
    if (options_.strict)
      throw io::InputError(prefix + reason);
    set_.left_out.push_back({file.path, reason});
  }

  void
  requireTwo(std::size_t usable) const
  {
    if (usable >= 2)
      return;
    std::string why;
    if (!set_.left_out.empty())
      why = "; " + set_.left_out.front().path + ": " + set_.left_out.front().reason;
    throw io::InputError("a map needs two scans, there " +
                         std::string(usable == 1 ? "is one" : "is none") +
                         " that can be used" + why);
  }

  /** \brief The middle one of the clouds' own; leaves the files that have one. */
  double
  estimate(std::vector<ScanFile>& files)
  {
    std::vector<double> estimates;
    std::vector<ScanFile> usable;
    forEach(files, "scans looked at", [&](const ScanFile& file) {
      const io::InputCloud input = io::readInputCloud(file.path, options_.bin_fields);
      io::checkPoints(input);
      estimates.push_back(io::resolutionOf(input));
      usable.push_back(file);
    });
    files = std::move(usable);
    requireTwo(files.size());
    const auto middle =
        estimates.begin() + static_cast<std::ptrdiff_t>(estimates.size() / 2);
    std::nth_element(estimates.begin(), middle, estimates.end());
    return *middle;
  }

  /** \brief Changes with all that scans of one file depend on. */
  std::string
  settings() const
  {
    std::string text = batch::frontEndFingerprint();
    text.append(reinterpret_cast<const char*>(&set_.resolution), sizeof(double));
    return io::toHex(io::hashOf(text)) + (options_.viewpoint_known ? "" : "-anywhere");
  }

  void
  take(const ScanFile& file)
  {
    const std::string checksum = io::toHex(io::hashOf(io::readFile(file.path)));
    for (std::size_t i = 0; i < set_.files.size(); ++i)
      if (set_.checksums[i] == checksum)
        throw io::InputError("is the same as " + set_.files[i].path);
    const bool raw = io::extensionOf(file.path) == ".bin";
    const std::string key =
        checksum + '-' + settings_ +
        (raw ? '-' + std::to_string(options_.bin_fields) : std::string());
    const std::optional<Scan> earlier = store_.earlier(key);
    const Scan scan = earlier ? *earlier : make(file);
    if (scan.size() < LEAST_POINTS)
      throw io::InputError("only " + std::to_string(scan.size()) +
                           " points are left at a resolution of " +
                           detail::toText(set_.resolution));
    store_.add(key, scan, earlier.has_value());
    set_.files.push_back(file);
    set_.checksums.push_back(checksum);
    ++viewpoints_[static_cast<int>(scan.viewpointSource())];
  }

  Scan
  make(const ScanFile& file)
  {
    const io::InputCloud input = io::readInputCloud(file.path, options_.bin_fields);
    io::checkPoints(input);
    for (const std::string& note : input.cloud.notes)
      notes_.add(file.path, note);
    return maker_.makeScan(
        io::scanInput(input.cloud, input.xyz, options_.viewpoint_known),
        set_.resolution);
  }

  void
  noteViewpoints() const
  {
    const std::size_t moved = viewpoints_[static_cast<int>(ViewpointSource::Points)],
                      none = viewpoints_[static_cast<int>(ViewpointSource::Unknown)];
    if (!options_.viewpoint_known || moved + none == 0)
      return;
    std::string text =
        std::to_string(moved + none) + " of " + std::to_string(set_.files.size()) +
        " scans: the points were not seen from the viewpoint in the file";
    if (moved > 0)
      text += "; of " + std::to_string(moved) +
              " they say from where instead, by how they lie: that is used";
    if (none > 0)
      text += "; of " + std::to_string(none) + " from no one place: none is used";
    messages_.note(text);
  }

  const Options& options_;
  const Messages& messages_;
  ScanStore& store_;
  PairRegistration maker_;
  ScanSet set_;
  std::string settings_;
  Notes notes_;
  /** \brief Scans by the ViewpointSource that they have. */
  std::size_t viewpoints_[3] = {};
};

} // namespace

ScanSet
readScans(const Options& options,
          const std::vector<ScanFile>& files,
          std::optional<double> resolution,
          const Messages& messages,
          ScanStore& store)
{
  return ScanReader(options, messages, store).read(files, resolution);
}

} // namespace pcl_flashreg::map
