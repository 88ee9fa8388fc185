// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/problem.h"

#include <pcl_flashreg/estimator.h>

#include <optional>
#include <vector>

namespace pcl_flashreg {

/** \brief What became of the caller's rows on the way to a Problem. */
struct Preparation {
  /** \brief Row of the input behind each row of the problem, ascending. */
  std::vector<int> rows;
  std::size_t invalid = 0;
  std::size_t dropped = 0;
  /** \brief What was subtracted from either side. */
  Vec3 source_centre{0, 0, 0};
  Vec3 target_centre{0, 0, 0};
};

/** \brief What the motion model asks of poses. */
Upright
uprightOf(const Parameters& parameters);

/** \brief Leaves out rows that are not finite, keeps the best-ranked max_correspondences,
 * subtracts the centroids in double precision and packs the rest, with what the motion model
 * asks of poses.
 * \param[in] target_centre what is subtracted from the target's side instead, if anything
 */
template <typename Scalar>
void
prepare(const CorrespondenceView<Scalar>& correspondences,
        const Parameters& parameters,
        const std::optional<Vec3>& target_centre,
        Preparation& preparation,
        Problem& problem);

/** \brief Other correspondences of the same clouds, in the same frames: centred as these.
 * \param[in] centred what was subtracted from them */
template <typename Scalar>
void
prepareLike(const Preparation& centred,
            const CorrespondenceView<Scalar>& correspondences,
            const Parameters& parameters,
            Problem& problem);

/** \brief The same for who does not ask what became of the rows. */
template <typename Scalar>
void
prepare(const CorrespondenceView<Scalar>& correspondences,
        const Parameters& parameters,
        Problem& problem)
{
  Preparation preparation;
  prepare(correspondences, parameters, std::nullopt, preparation, problem);
}

extern template void
prepare(const CorrespondenceView<float>&,
        const Parameters&,
        const std::optional<Vec3>&,
        Preparation&,
        Problem&);
extern template void
prepare(const CorrespondenceView<double>&,
        const Parameters&,
        const std::optional<Vec3>&,
        Preparation&,
        Problem&);
extern template void
prepareLike(const Preparation&,
            const CorrespondenceView<double>&,
            const Parameters&,
            Problem&);

} // namespace pcl_flashreg
