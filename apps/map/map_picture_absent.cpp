// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "map_picture.h"

namespace pcl_flashreg::map {

const bool kMapPictureBuiltIn = false;

void
writeMapPicture(const std::string&,
                const std::vector<std::string>&,
                const MultiviewResult&,
                const MultiviewRegistration::ScanSource&)
{
}

} // namespace pcl_flashreg::map
