// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>
#include <pcl_flashreg/scan.h>

#include <string>
#include <vector>

namespace pcl_flashreg::localize {

/** \brief Whether this program can draw. */
extern const bool kPlacesPictureBuiltIn;

/** \brief A scan that has a pose. */
struct DrawnPlace {
  std::string name;
  RigidTransform T_map_scan;
  bool trusted = false;
};

/** \brief What a picture is drawn from. */
struct PlacesDrawing {
  const Scan& map;
  const std::vector<DrawnPlace>& places;
  /** \brief What is written below. */
  const std::string& caption;
};

/** \brief Draws the map from above, as map::seenFromAbove() has it, and in it the
 * origin of each scan with a line to where its sensor is turned: along its x axis
 * where its z axis is upright, as of laser scanners, else along its z axis, as of
 * cameras. What is trusted has another color than what is not, and lies on top.
 * \throws io::InputError if the file can't be written
 */
void
writePlacesPicture(const std::string& path, const PlacesDrawing& drawing);

} // namespace pcl_flashreg::localize

/** \brief What the module offers: the bytes of the PNG file. */
extern "C" void
pcl_flashreg_draw_places(const pcl_flashreg::localize::PlacesDrawing& drawing,
                         std::string& png);
