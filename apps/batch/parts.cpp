// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "parts.h"

#include <filesystem>

namespace pcl_flashreg::batch {

namespace fs = std::filesystem;

std::string
partPath(const std::string& file, const std::string& kind, std::size_t number)
{
  return file + '.' + kind + std::to_string(number);
}

std::vector<std::string>
partsOf(const std::string& file, const std::string& kind)
{
  std::vector<std::string> parts;
  const fs::path path = fs::absolute(file);
  const std::string prefix = path.filename().string() + '.' + kind;
  if (!fs::is_directory(path.parent_path()))
    return parts; // writing the file will say so
  for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path())) {
    const std::string name = entry.path().filename().string();
    const bool is_part =
        name.rfind(prefix, 0) == 0 && name.size() > prefix.size() &&
        name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
    if (is_part)
      parts.push_back(entry.path().string());
  }
  return parts;
}

} // namespace pcl_flashreg::batch
