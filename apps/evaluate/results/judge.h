// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../datasets/data_set.h"
#include "../methods/method.h"
#include "record.h"

namespace pcl_flashreg::evaluate {

/** \brief Share of the correspondences within a distance of the true pose. */
double
inlierRatio(const Correspondences& correspondences,
            const RigidTransform& T_target_source,
            double inlier_distance);

/** \brief Compares an answer with the true pose; fills what follows from the two. */
void
judge(const Answer& answer,
      const RigidTransform& truth,
      const Criterion& criterion,
      Record& record);

} // namespace pcl_flashreg::evaluate
