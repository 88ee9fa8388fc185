// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <string>

namespace pcl_flashreg::io {

/** \brief Takes the sensor's pose from the rows of a PLY file's element "camera".
 *
 * The property names are VCG's, and what PCL reads and writes: view_px view_py view_pz
 * is the sensor's place, x_axisx x_axisy ... z_axisz its rotation, sensor to cloud, by
 * rows. Either may be missing; what makes no sense is left out, with a note.
 */
void
takeCamera(const Cloud& cameras, Cloud& cloud);

/** \brief The viewpoint of a cloud as an element "camera" with all the properties that
 * PCL gives it. */
struct PlyCamera {
  /** \brief Lines of the header, and the row; empty where the viewpoint is the one that
   * a file without a camera has. */
  std::string header;
  std::string row;
};

/** \param[in] cloud whose coordinates decide whether float32 or float64 suits the place
 */
PlyCamera
cameraOf(const Cloud& cloud);

} // namespace pcl_flashreg::io
