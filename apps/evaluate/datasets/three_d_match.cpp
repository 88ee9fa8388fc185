// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "three_d_match.h"

#include "../../io/error.h"
#include "../../io/file.h"
#include "../../io/text.h"
#include "../../io/transform_io.h"

#include <algorithm>
#include <filesystem>
#include <map>

namespace pcl_flashreg::evaluate {
namespace {

namespace fs = std::filesystem;

struct LogEntry {
  std::size_t target, source, line;
  RigidTransform T_target_source;
};

/** \brief The matrix of an entry: the next four lines. */
RigidTransform
takeMatrix(io::LineReader& lines)
{
  std::string rows;
  for (int row = 0; row < 4; ++row) {
    std::string_view line;
    if (!lines.next(line))
      throw io::InputError("the file ends within a matrix");
    rows += std::string(line) + '\n';
  }
  return io::parseTransform(rows);
}

std::vector<LogEntry>
parseLog(const std::string& text)
{
  std::vector<LogEntry> entries;
  io::LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    const auto words = io::splitWords(line);
    if (words.empty())
      continue;
    LogEntry entry;
    entry.line = lines.lineNumber();
    try {
      if (words.size() != 3 || !io::parseUnsigned(words[0], entry.target) ||
          !io::parseUnsigned(words[1], entry.source))
        throw io::InputError("expected 'i j n', two fragments and how many there are");
      entry.T_target_source = takeMatrix(lines);
    }
    catch (const io::InputError& error) {
      throw io::InputError("line " + std::to_string(entry.line) + ": " + error.what());
    }
    entries.push_back(entry);
  }
  return entries;
}

/** \brief What a walk through the tree finds. */
struct Tree {
  std::vector<fs::path> logs;
  /** \brief Folder of the fragments of each scene. */
  std::map<std::string, fs::path> scenes;
};

Tree
walk(const std::string& root)
{
  Tree tree;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(
           root, fs::directory_options::follow_directory_symlink)) {
    const fs::path& path = entry.path();
    if (path.filename() == "gt.log")
      tree.logs.push_back(path);
    const std::string extension = io::extensionOf(path.string());
    if (path.filename().string().rfind("cloud_bin_", 0) == 0 &&
        (extension == ".ply" || extension == ".pcd"))
      tree.scenes[path.parent_path().filename().string()] = path.parent_path();
  }
  std::sort(tree.logs.begin(), tree.logs.end());
  return tree;
}

std::string
sceneOf(const fs::path& log)
{
  const std::string folder = log.parent_path().filename().string();
  const std::string mark = "-evaluation";
  const std::size_t at = folder.rfind(mark);
  return at != std::string::npos && at + mark.size() == folder.size()
             ? folder.substr(0, at)
             : folder;
}

std::string
fragment(const fs::path& folder, std::size_t number, const std::string& root)
{
  const fs::path stem = folder / ("cloud_bin_" + std::to_string(number));
  for (const char* extension : {".ply", ".pcd"}) {
    const fs::path path = stem.string() + extension;
    if (fs::exists(path))
      return fs::relative(path, root).string();
  }
  throw io::InputError(stem.string() + ".ply (or .pcd) is not there");
}

} // namespace

DataSet
readThreeDMatch(const std::string& root)
{
  DataSet data;
  data.root = root;
  const Tree tree = walk(root);
  for (const fs::path& log : tree.logs) {
    const std::string scene = sceneOf(log);
    const auto folder = tree.scenes.find(scene);
    if (folder == tree.scenes.end())
      throw io::InputError(log.string() + ": there is no folder " + scene +
                           " with fragments cloud_bin_<k>.ply (or .pcd) below " + root);
    const std::string dataset =
        fs::canonical(log).parent_path().parent_path().filename().string();
    for (const LogEntry& entry : io::parseFile(log.string(), parseLog)) {
      Pair pair;
      pair.dataset = dataset;
      pair.scene = scene;
      try {
        pair.source = fragment(folder->second, entry.source, root);
        pair.target = fragment(folder->second, entry.target, root);
      }
      catch (const io::InputError& error) {
        throw io::InputError(log.string() + ": line " + std::to_string(entry.line) +
                             ": " + error.what());
      }
      pair.T_target_source = entry.T_target_source;
      data.pairs.push_back(pair);
    }
  }
  return data;
}

} // namespace pcl_flashreg::evaluate
