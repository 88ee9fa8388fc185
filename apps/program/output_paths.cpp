// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "output_paths.h"

#include "program.h"

#include <filesystem>

namespace fs = std::filesystem;

namespace pcl_flashreg::program {

bool
isSameFile(const std::string& a, const std::string& b)
{
  std::error_code error;
  if (fs::exists(a, error) && fs::exists(b, error))
    return fs::is_regular_file(a, error) && fs::equivalent(a, b, error);
  return fs::weakly_canonical(fs::absolute(a), error) ==
         fs::weakly_canonical(fs::absolute(b), error);
}

void
checkOutputPaths(const std::vector<std::string>& outputs,
                 const std::vector<std::string>& inputs)
{
  std::vector<std::string> earlier;
  for (const std::string& path : outputs) {
    if (path.empty() || path == "-")
      continue;
    for (const std::string& input : inputs)
      if (!input.empty() && isSameFile(path, input))
        throw UsageError(path + ": would be overwritten, but it is an input");
    for (const std::string& other : earlier)
      if (isSameFile(path, other))
        throw UsageError(path + ": two outputs go to the same file");
    earlier.push_back(path);
    if (fs::is_directory(path))
      throw UsageError(path + ": is a directory, not a file");
    const fs::path folder = fs::absolute(path).parent_path();
    if (!fs::is_directory(folder))
      throw UsageError(path + ": the folder " + folder.string() + " does not exist");
  }
}

} // namespace pcl_flashreg::program
