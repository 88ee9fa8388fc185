// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/multiview_registration.h>

#include <string>
#include <vector>

namespace pcl_flashreg::map {

/** \brief Whether this program can draw. */
extern const bool kMapPictureBuiltIn;

/** \brief What a picture is drawn from. */
struct MapDrawing {
  /** \brief Of the scans, one each. */
  const std::vector<std::string>& names;
  const MultiviewResult& result;
  /** \brief Hands out the scans one after the other; their keypoints are drawn. */
  const MultiviewRegistration::ScanSource& scans;
};

/** \brief Draws all groups of two scans and more from above, each scan in a color of its
 * own, into a PNG file.
 *
 * Darker is where more points lie above each other: walls. Lines are the used edges, between
 * FlatScan::place; all groups have the same
 * scale. What "above" is, seenFromAbove() says. Software only: no display and no GPU is
 * needed.
 * \throws io::InputError if the file can't be written
 */
void
writeMapPicture(const std::string& path,
                const std::vector<std::string>& names,
                const MultiviewResult& result,
                const MultiviewRegistration::ScanSource& scans);

} // namespace pcl_flashreg::map

/** \brief What the module offers: the bytes of the PNG file. */
extern "C" void
pcl_flashreg_draw_map(const pcl_flashreg::map::MapDrawing& drawing, std::string& png);
