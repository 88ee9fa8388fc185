// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan_files.h"

#include "../io/cloud_io.h"
#include "../io/file.h"
#include "../io/text.h"
#include "program.h"
#include "natural_order.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace fs = std::filesystem;

namespace pcl_flashreg::program {
namespace {

/** \brief Clouds in a folder, not in those below it. */
std::vector<std::string>
cloudsIn(const std::string& folder)
{
  std::vector<std::string> clouds;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const bool hidden = entry->path().filename().string().front() == '.';
    if (!hidden && io::isReadableCloudPath(entry->path().string()) &&
        !fs::is_directory(entry->path()))
      clouds.push_back(entry->path().string());
  }
  if (error)
    throw io::InputError(folder + ": cannot be read: " + error.message());
  if (clouds.empty())
    throw io::InputError(folder + ": holds no cloud (.pcd, .ply, .bin)");
  std::sort(clouds.begin(), clouds.end(), naturallyBefore);
  return clouds;
}

std::vector<std::string>
pathsInList(const std::string& list)
{
  const std::string bytes = io::readFile(list);
  std::vector<std::string> paths;
  io::LineReader lines(bytes);
  for (std::string_view line; lines.next(line);) {
    line = line.substr(0, line.find('#'));
    const std::size_t begin = line.find_first_not_of(" \t"),
                      end = line.find_last_not_of(" \t");
    if (begin != std::string_view::npos)
      paths.push_back((fs::path(list).parent_path() /
                       std::string(line.substr(begin, end + 1 - begin)))
                          .string());
  }
  if (paths.empty())
    throw io::InputError(list + ": names no scan");
  return paths;
}

void
checkTwice(const std::vector<std::string>& paths)
{
  std::set<fs::path> seen;
  for (const std::string& path : paths) {
    std::error_code error;
    if (!seen.insert(fs::weakly_canonical(fs::absolute(path), error)).second)
      throw UsageError(path + ": is given twice");
  }
}

/** \brief Folders of a path that are looked at to tell files apart. */
constexpr std::ptrdiff_t MOST_PARTS = 64;

/** \brief The last so many parts of a path. */
std::string
endOf(const fs::path& path, std::ptrdiff_t parts)
{
  auto from = path.end();
  while (parts-- > 0 && from != path.begin())
    --from;
  fs::path end;
  for (; from != path.end(); ++from)
    end /= *from;
  return end.string();
}

/** \brief Names of files, with as many of their folders as it takes to tell them apart. */
std::vector<ScanFile>
named(const std::vector<std::string>& paths)
{
  std::vector<ScanFile> files(paths.size());
  std::map<std::string, std::vector<std::size_t>> of_name;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    files[i].path = paths[i];
    of_name[fs::path(paths[i]).filename().string()].push_back(i);
  }
  for (const auto& [name, same] : of_name) {
    std::set<std::string> names;
    for (std::ptrdiff_t parts = 1; parts <= MOST_PARTS && names.size() < same.size();
         ++parts) {
      names.clear();
      for (const std::size_t i : same) {
        files[i].name = endOf(fs::path(paths[i]).lexically_normal(), parts);
        names.insert(files[i].name);
      }
    }
    // Links can make two files of what reads as one.
    if (names.size() < same.size())
      for (const std::size_t i : same)
        files[i].name = paths[i];
  }
  return files;
}

} // namespace

std::vector<ScanFile>
findScans(const std::vector<std::string>& given,
          const std::string& list,
          ScanOrder order)
{
  std::vector<std::string> paths;
  for (const std::string& path : given) {
    if (!fs::is_directory(path)) {
      paths.push_back(path);
      continue;
    }
    const std::vector<std::string> clouds = cloudsIn(path);
    paths.insert(paths.end(), clouds.begin(), clouds.end());
  }
  if (!list.empty()) {
    const std::vector<std::string> more = pathsInList(list);
    paths.insert(paths.end(), more.begin(), more.end());
  }
  checkTwice(paths);
  std::vector<ScanFile> files = named(paths);
  if (order == ScanOrder::ByName)
    std::sort(files.begin(), files.end(), [](const ScanFile& a, const ScanFile& b) {
      return a.name != b.name ? naturallyBefore(a.name, b.name) : a.path < b.path;
    });
  return files;
}

} // namespace pcl_flashreg::program
