// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/multiview_registration.h>

#include <string>

namespace pcl_flashreg::map {

/** \brief The information of an edge as g2o's EDGE_SE3:QUAT understands it: of a small motion
 * in the frame of the source, its translation first, then the imaginary part of its
 * quaternion, which is half an angle. */
InformationMatrix
informationForG2o(const MapEdge& edge);

/** \brief The pose graph in g2o's text format: a vertex for every scan that is placed, by its
 * number from 0; of each group the first is fixed; an edge for every one that is used. The
 * first vertex of an edge is the target: the measurement is the source in its frame. */
std::string
formatG2o(const MultiviewResult& result);

} // namespace pcl_flashreg::map
