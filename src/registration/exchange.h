// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/pair_registration.h>

namespace pcl_flashreg {

/** \brief T_source_target of a T_target_source. */
RigidTransform
inverseOf(const RigidTransform& T);

/** \brief What it says of the source and the target it says of the target and the source: the
 * same registration, asked for the other way round. */
void
exchange(Result& result);

/** \brief The same of what is asked for. */
Parameters
exchanged(Parameters parameters);

/** \brief The same of keypoints that match. */
void
exchange(std::vector<FeatureMatch>& matches);

} // namespace pcl_flashreg
