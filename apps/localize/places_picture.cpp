// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "places_picture.h"

#include "../io/file.h"
#include "../program/modules.h"

namespace pcl_flashreg::localize {

const bool kPlacesPictureBuiltIn = true;

void
writePlacesPicture(const std::string& path, const PlacesDrawing& drawing)
{
  const auto draw =
      reinterpret_cast<decltype(&pcl_flashreg_draw_places)>(program::loadFunction(
          "pcl_flashreg_places_picture.so", "pcl_flashreg_draw_places"));
  std::string png;
  draw(drawing, png);
  io::writeFile(path, png);
}

} // namespace pcl_flashreg::localize
