// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/surface.h"
#include "judgement/cpu/vicinity.h"
#include "math/rigid_float.h"
#include "math/upright.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace pcl_flashreg {

/** \brief What is believed of how clouds were seen. */
enum class Belief {
  /** \brief Viewpoints, and of a surface that has sides, these: just before the side that was
   * seen there is nothing. */
  Sides,
  /** \brief Viewpoints, where they are known. */
  Viewpoints,
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
  /** \brief What poses keep to. */
  Upright upright = {};
  /** \brief Null where all of the target matters under any pose. */
  const Vicinity* vicinity = nullptr;

  /** \brief The same clouds, of which another thing is believed. */
  SurfacePair
  believing(Belief other) const
  {
    return {source, target, spacing, other, upright, vicinity};
  }

  /** \brief Points of the target that the source can meet. */
  PointRanges
  targetUnder(const RigidFloat& pose) const
  {
    return vicinity ? vicinity->around(pose.translation)
                    : PointRanges(target.points.size());
  }

  /** \brief Viewpoints that are known and believed. */
  int
  viewpoints() const
  {
    if (belief == Belief::Nothing)
      return 0;
    return (source.free_space.known() ? 1 : 0) + (target.free_space.known() ? 1 : 0);
  }

  /** \brief How many times as many points as the other one a cloud of unknown viewpoint has,
   * at most. */
  double
  excess() const
  {
    const auto s = static_cast<double>(source.points.size());
    const auto t = static_cast<double>(target.points.size());
    return std::max(source.free_space.known() ? 0 : s / t,
                    target.free_space.known() ? 0 : t / s);
  }

  /** \brief Whether the sides of surfaces are believed: not of one that is much larger than
   * the other, which was put together from several views. */
  bool
  hasSides() const
  {
    return belief == Belief::Sides && source.oriented() && target.oriented() &&
           viewpoints() < 2 && excess() < static_cast<double>(Vicinity::MUCH_LARGER);
  }

  /** \brief Whether a cloud may have a place twice, once with its sides turned the wrong
   * way. */
  bool
  mayRepeat() const
  {
    constexpr double LARGER = 1.7;
    return hasSides() && excess() > LARGER;
  }

  /** \brief Whether the normals of both point to where they were seen from, so that their
   * sign counts. */
  bool
  oriented() const
  {
    return viewpoints() == 2 || hasSides();
  }

  /** \brief Whether poses can be contradicted. */
  bool
  seeing() const
  {
    return viewpoints() > 0 || hasSides();
  }
};

/** \brief Points of a cloud, spread evenly over some of its numbers. */
struct Samples {
  Samples(const Surface& cloud, const PointRanges& numbers, std::size_t most);

  std::vector<Eigen::Vector3f> points, normals;
  /** \brief How many they stand for. */
  std::size_t stand_for;
};

/** \brief How closely a Look looks. */
struct LookSettings {
  std::size_t points;
  float tolerance, margin;
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

  Look(const SurfacePair& clouds, const LookSettings& settings)
      : Look(clouds, settings.points, settings.tolerance, settings.margin)
  {
  }

  /** \brief Where one viewpoint alone is known, of the other cloud (a map, a model) there may
   * be any amount out of its sight.
   * \param[in] pose T_target_source */
  CloudAgreement
  operator()(const Pose& pose) const;

private:
  const SurfacePair& clouds_;
  std::size_t points_;
  float tolerance_, margin_;
  Samples source_;
  /** \brief Nothing where it depends on the pose. */
  std::optional<Samples> target_;
};

/** \brief Shares of points below which nothing can be told. */
constexpr double NOTHING_TOLD = 0.01;

/** \brief What the clouds say for a pose, as a logarithm. */
inline double
evidenceOf(const CloudAgreement& agreement)
{
  return std::log(agreement.matched + NOTHING_TOLD) -
         std::log(agreement.contradicted + NOTHING_TOLD);
}

/** \brief The cosine of two normals; its absolute value where signs don't count. */
inline float
alignmentOf(const Eigen::Vector3f& a, const Eigen::Vector3f& b, bool oriented)
{
  const float cosine = a.dot(b);
  return oriented || cosine > 0 ? cosine : -cosine;
}

} // namespace pcl_flashreg
