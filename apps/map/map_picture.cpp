// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "map_picture.h"

#include "../io/file.h"
#include "../program/modules.h"

namespace pcl_flashreg::map {

const bool kMapPictureBuiltIn = true;

void
writeMapPicture(const std::string& path,
                const std::vector<std::string>& names,
                const MultiviewResult& result,
                const MultiviewRegistration::ScanSource& scans)
{
  const auto draw = reinterpret_cast<decltype(&pcl_flashreg_draw_map)>(
      program::loadFunction("pcl_flashreg_map_picture.so", "pcl_flashreg_draw_map"));
  std::string png;
  draw({names, result, scans}, png);
  io::writeFile(path, png);
}

} // namespace pcl_flashreg::map
