// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "correspondence_folders.h"

#include "../../io/error.h"
#include "../../io/file.h"
#include "../../io/text.h"
#include "../../io/transform_io.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <regex>
#include <set>

namespace pcl_flashreg::evaluate {
namespace {

namespace fs = std::filesystem;

/** \brief Names of one pair's files within their folder. */
struct Files {
  std::string correspondences, transform;
  /** \brief What the results call the two clouds. */
  std::string source, target;
};

std::optional<Files>
turboRegFiles(const std::string& name)
{
  static const std::regex pattern("(.+)(_[^_]+)_kpts_src\\.txt");
  std::smatch part;
  if (!std::regex_match(name, part, pattern))
    return std::nullopt;
  const std::string id = part[1], kpts = id + part[2].str() + "_kpts_";
  return Files{
      kpts + "{src,dst}.txt", id + "_trans.txt", kpts + "src.txt", kpts + "dst.txt"};
}

/** \brief Whether MAC's list of the folder, where there is one, names the pair. */
bool
isListed(const fs::path& folder, const std::string& pair, const std::string& descriptor)
{
  const fs::path list = folder / ("dataload" + descriptor + ".txt");
  if (!fs::exists(list))
    return true;
  const std::string text = io::readFile(list.string());
  io::LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    const auto words = io::splitWords(line);
    if (words.size() == 1 && words[0] == pair)
      return true;
  }
  return false;
}

std::optional<Files>
macFiles(const fs::path& folder, const std::string& name)
{
  static const std::regex pattern("(.*[^@_])([@_])corr(_[^_]+)?\\.txt");
  std::smatch part;
  if (!std::regex_match(name, part, pattern))
    return std::nullopt;
  const std::string pair = part[1], mark = part[2], descriptor = part[3];
  const Files files{name,
                    pair + mark + "GTmat" + descriptor + ".txt",
                    pair.substr(0, pair.find('+')),
                    pair.substr(pair.find('+') + 1)};
  // Index pairs and labels have such names as well, but no matrix of their own.
  if (!fs::exists(folder / files.transform) || !isListed(folder, pair, descriptor))
    return std::nullopt;
  return files;
}

std::string
datasetOf(const fs::path& folder, const fs::path& root)
{
  const fs::path parent = fs::relative(folder, root).parent_path();
  return parent.empty() ? fs::canonical(root).filename().string()
                        : parent.generic_string();
}

} // namespace

DataSet
readCorrespondenceFolders(const std::string& root)
{
  DataSet data;
  data.root = root;
  std::set<fs::path> paths;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(
           root, fs::directory_options::follow_directory_symlink))
    if (entry.path().extension() == ".txt")
      paths.insert(entry.path());
  for (const fs::path& path : paths) {
    const fs::path folder = path.parent_path();
    auto files = turboRegFiles(path.filename().string());
    if (!files)
      files = macFiles(folder, path.filename().string());
    if (!files)
      continue;
    const std::string inner = fs::relative(folder, root).generic_string();
    const std::string prefix = inner == "." ? "" : inner + "/";
    Pair pair;
    pair.dataset = datasetOf(folder, root);
    pair.scene = fs::canonical(folder).filename().string();
    pair.source = prefix + files->source;
    pair.target = prefix + files->target;
    pair.correspondences = prefix + files->correspondences;
    pair.T_target_source =
        io::parseFile((folder / files->transform).string(), io::parseTransform);
    data.pairs.push_back(pair);
  }
  return data;
}

} // namespace pcl_flashreg::evaluate
