// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/surface.h"

#include <cstddef>

namespace pcl_flashreg {

/** \brief Two clouds in the centred frames; whoever made them keeps them. */
struct SurfacePair {
  const Surface& source;
  const Surface& target;
  /** \brief Distance of neighbouring points. */
  float spacing;

  /** \brief Whether the normals of both point to a sensor, so that their sign counts. */
  bool
  oriented() const
  {
    return source.free_space.known() && target.free_space.known();
  }

  /** \brief Whether the viewpoint of one is known, so that poses can be contradicted. */
  bool
  seeing() const
  {
    return source.free_space.known() || target.free_space.known();
  }
};

/** \brief How thoroughly to look. */
struct Effort {
  /** \brief Points of either cloud at most, spread evenly over their numbers. */
  std::size_t points;
  /** \brief How far from a surface a point may be to match it, in spacings. */
  float tolerance;
};

/** \brief Where one viewpoint alone is known, as that cloud sees it: of the other one (a map,
 * a model) there may be any amount out of its sight.
 * \param[in] pose T_target_source */
CloudAgreement
agreementOf(const SurfacePair& clouds, const Pose& pose, const Effort& effort);

/** \brief The cosine of two normals; its absolute value where signs don't count. */
inline float
alignmentOf(const Eigen::Vector3f& a, const Eigen::Vector3f& b, bool oriented)
{
  const float cosine = a.dot(b);
  return oriented || cosine > 0 ? cosine : -cosine;
}

} // namespace pcl_flashreg
