// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/pair_registration.h>

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief Whether one cloud is a map for the other: so much larger that most of it is out of
 * the other's sight. */
bool
isMapFor(const Scan& map, const Scan& scan);

/** \brief Neighbours that each descriptor of a scan is matched with in a map. */
constexpr std::size_t NEIGHBORS_IN_MAP = 10;

/** \brief Of the matches of each query, which follow each other, the first. */
std::vector<FeatureMatch>
firstOfEach(std::vector<FeatureMatch> matches);

/** \brief Parts of a map, each as large as the scan that is looked for in it, which overlap:
 * those where most of the scan's keypoints have a match, the best first. In the whole map
 * they would be drowned by what is alike elsewhere.
 * \param[in] matches of each keypoint of the scan with several of the map
 * \param[in] most parts
 * \return of each part, matches of each keypoint with its nearest there */
std::vector<std::vector<FeatureMatch>>
matchesByPlace(const Scan& scan,
               const Scan& map,
               const std::vector<FeatureMatch>& matches,
               std::size_t most);

} // namespace pcl_flashreg
