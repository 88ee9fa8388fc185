// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/free_motion.h"

#include "judgement/confidence.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pcl_flashreg {
namespace {

/** \brief What the clouds say has fallen, as a logarithm, where a way is not free any more. */
constexpr double FALL = 0.3;

/** \brief How far along the stops, which go off the pose, a way is free. */
template <typename Iterator>
double
freeWay(Iterator begin, Iterator end, double least)
{
  double way = 0;
  for (; begin != end; ++begin) {
    if (evidenceOf(begin->agreement) < least)
      break;
    way = std::abs(begin->way);
  }
  return way;
}

/** \brief A screw that turns more than it slides is said to turn; its pitch is left out. */
FreeMotion
describe(const Motion& motion, double backward, double forward)
{
  FreeMotion free;
  const double turn = motion.turn.norm(), shift = motion.shift.norm();
  // Motions have unit length where the points' spread is the unit of arms.
  if (shift * shift < 0.5) {
    free.kind = FreeMotion::Kind::Turn;
    free.direction = motion.turn / turn;
    free.point = motion.middle + motion.turn.cross(motion.shift) / (turn * turn);
    free.backward = backward * turn;
    free.forward = forward * turn;
  }
  else {
    free.kind = FreeMotion::Kind::Slide;
    free.direction = motion.shift / shift;
    free.point = motion.middle;
    free.backward = backward * shift;
    free.forward = forward * shift;
  }
  return free;
}

} // namespace

std::vector<FreeMotion>
freeMotionsOf(const std::vector<Walk>& walks)
{
  std::vector<FreeMotion> motions;
  for (const Walk& walk : walks) {
    const double least = evidenceOf(walk.start().agreement) - FALL;
    const auto middle =
        walk.stops.begin() + static_cast<std::ptrdiff_t>(walk.stops.size() / 2);
    const double forward = freeWay(middle, walk.stops.end(), least);
    const double backward =
        freeWay(std::make_reverse_iterator(middle + 1), walk.stops.rend(), least);
    // Coarse points are no smooth surface: a walk over them may find a slope that is none.
    if (std::max(forward, backward) >= walk.far ||
        walk.motion.stiffness < NEEDED_STIFFNESS)
      motions.push_back(describe(walk.motion, backward, forward));
  }
  return motions;
}

} // namespace pcl_flashreg
