// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "raster.h"

#include <string>

namespace pcl_flashreg::align {

/** \brief Writes a word with thin strokes. The letters are those that the titles of a
 * snapshot need; others leave a gap.
 * \param[in] x, y left end of the base line, in pixels
 * \param[in] size height of a small letter, in pixels
 * \param[in] thickness of a stroke, in pixels
 * \return where the next letter would begin
 */
float
drawText(Canvas& canvas,
         const std::string& text,
         float x,
         float y,
         float size,
         float thickness,
         Color color);

} // namespace pcl_flashreg::align
