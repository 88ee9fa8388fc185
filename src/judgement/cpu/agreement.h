// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/surface.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief What is believed of how clouds were seen. */
enum class Belief {
  /** \brief Viewpoints, where they are known. */
  Viewpoints,
  /** \brief Normals point to the side from which a surface was seen, and just before it there
   * is nothing. */
  Normals,
  /** \brief Nothing: normals have no sign. */
  Nothing
};

/** \brief Two clouds in the centred frames; whoever made them keeps them. */
struct SurfacePair {
  const Surface& source;
  const Surface& target;
  /** \brief Distance of neighbouring points. */
  float spacing;
  Belief belief = Belief::Viewpoints;

  /** \brief Whether the normals of both point to a sensor, so that their sign counts. */
  bool
  oriented() const
  {
    return belief == Belief::Normals ||
           (belief == Belief::Viewpoints && source.free_space.known() &&
            target.free_space.known());
  }

  /** \brief Whether poses can be contradicted: the viewpoint of one cloud is known, or that
   * nothing is before the surfaces. */
  bool
  seeing() const
  {
    return belief == Belief::Normals ||
           (belief == Belief::Viewpoints &&
            (source.free_space.known() || target.free_space.known()));
  }
};

/** \brief Points of a cloud, spread evenly over their numbers. */
struct Samples {
  Samples(const Surface& cloud, std::size_t most);

  std::vector<Eigen::Vector3f> points, normals;
};

/** \brief How two clouds get on with each other under poses, by points of either that stand
 * for the rest. */
class Look {
public:
  /** \param[in] clouds that outlive this
   * \param[in] points of either cloud at most
   * \param[in] tolerance how far from a surface a point may be to match it, in spacings
   * \param[in] margin how far in front of what was seen a point must be to contradict it, in
   * spacings */
  Look(const SurfacePair& clouds, std::size_t points, float tolerance, float margin);

  /** \brief Where one viewpoint alone is known, as that cloud sees it: of the other one (a
   * map, a model) there may be any amount out of its sight.
   * \param[in] pose T_target_source */
  CloudAgreement
  operator()(const Pose& pose) const;

private:
  const SurfacePair& clouds_;
  float tolerance_, margin_;
  Samples source_, target_;
};

/** \brief Shares of points below which nothing can be told. */
constexpr double NOTHING_TOLD = 0.01;

/** \brief What the clouds say for a pose, as a logarithm. */
inline double
evidenceOf(const CloudAgreement& agreement, bool with_viewpoints)
{
  return std::log(agreement.matched + NOTHING_TOLD) -
         (with_viewpoints ? std::log(agreement.contradicted + NOTHING_TOLD) : 0);
}

/** \brief The cosine of two normals; its absolute value where signs don't count. */
inline float
alignmentOf(const Eigen::Vector3f& a, const Eigen::Vector3f& b, bool oriented)
{
  const float cosine = a.dot(b);
  return oriented || cosine > 0 ? cosine : -cosine;
}

} // namespace pcl_flashreg
