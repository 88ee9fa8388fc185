// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "places_picture.h"

namespace pcl_flashreg::localize {

const bool kPlacesPictureBuiltIn = false;

void
writePlacesPicture(const std::string&, const PlacesDrawing&)
{
}

} // namespace pcl_flashreg::localize
