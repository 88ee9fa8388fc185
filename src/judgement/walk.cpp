// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/walk.h"

#include "judgement/tilt.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_flashreg {
namespace {

constexpr std::size_t MOTIONS = 3;
/** \brief A motion that the surfaces oppose more than this is not tried, unless it is the
 * softest. */
constexpr double SOFT = 0.06;

/** \brief Steps to either side at most, and how long one is, in spacings. */
constexpr int STEPS = 21;
constexpr double STEP = 3;
/** \brief See Walk::far, in spacings. */
constexpr double FAR = 9;
/** \brief No more than half a turn; of small things, in so many steps at least, a third of
 * them near. */
constexpr int STEPS_TO_HALF_TURN = 9;

/** \brief In degrees more than a pose may tilt: it is not on the surface yet. */
constexpr double MOST_TILT = 3;

constexpr double PI = 3.14159265358979323846;

Walk
planned(const Motion& motion, const Pose& pose, float spacing)
{
  const double angle_a_way = motion.turn.norm();
  const double half_turn =
      angle_a_way > 0 ? PI / angle_a_way : std::numeric_limits<double>::infinity();
  const double step = std::min(STEP * spacing, half_turn / STEPS_TO_HALF_TURN);
  const int count = static_cast<int>(std::min<double>(STEPS, half_turn / step + 1e-6));
  Walk walk{motion, {}, std::min(FAR * spacing, half_turn / 3) * (1 - 1e-6)};
  for (int i = -count; i <= count; ++i)
    walk.stops.push_back({i * step, moveAlong(pose, motion, i * step), {}});
  return walk;
}

} // namespace

double
Walk::rise() const
{
  double highest = -std::numeric_limits<double>::infinity();
  for (const Stop& stop : stops)
    if (std::abs(stop.way) >= far)
      highest = std::max(highest, evidenceOf(stop.agreement));
  return highest - evidenceOf(start().agreement);
}

std::vector<Walk>
walkOff(const std::vector<Motion>& motions,
        const Pose& pose,
        float spacing,
        const std::function<CloudAgreement(const Pose&)>& look,
        ThreadPool& pool)
{
  std::vector<Walk> walks;
  for (const Motion& motion : motions)
    if (walks.empty() || (walks.size() < MOTIONS && motion.stiffness <= SOFT))
      walks.push_back(planned(motion, pose, spacing));
  std::vector<Stop*> stops;
  for (Walk& walk : walks)
    for (Stop& stop : walk.stops)
      stops.push_back(&stop);
  pool.forEach(stops.size(), [&](std::size_t i, std::size_t) {
    stops[i]->agreement = look(stops[i]->pose);
  });
  return walks;
}

std::vector<Walk>
walkOff(const SurfacePair& clouds, const Pose& pose, ThreadPool& pool)
{
  const Look look(clouds, ON_THE_WAY);
  return walkOff(principalMotions(clouds, pose), pose, clouds.spacing, look, pool);
}

void
addWalks(const std::vector<Walk>& walks, Evidence& evidence)
{
  constexpr double MOST_HOLD = 5;
  evidence.hold = walks.empty() ? 0 : MOST_HOLD;
  for (const Walk& walk : walks)
    evidence.hold = std::min(evidence.hold, -walk.rise());
  evidence.stiffness = walks.empty() ? 0 : walks.front().motion.stiffness;
}

std::vector<Pose>
peaksOf(const std::vector<Walk>& walks, const Upright& upright, std::size_t most)
{
  struct Peak {
    double height;
    Pose pose;
  };
  std::vector<Peak> peaks;
  for (const Walk& walk : walks) {
    const auto height = [&](std::size_t i) {
      return i < walk.stops.size() ? evidenceOf(walk.stops[i].agreement)
                                   : -std::numeric_limits<double>::infinity();
    };
    for (std::size_t i = 0; i < walk.stops.size(); ++i)
      if (std::abs(walk.stops[i].way) >= walk.far && height(i) >= height(i - 1) &&
          height(i) > height(i + 1) &&
          !tiltsBeyond(upright, walk.stops[i].pose, MOST_TILT))
        peaks.push_back({height(i), walk.stops[i].pose});
  }
  std::stable_sort(peaks.begin(), peaks.end(), [](const Peak& a, const Peak& b) {
    return a.height > b.height;
  });
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < std::min(most, peaks.size()); ++i)
    poses.push_back(peaks[i].pose);
  return poses;
}

} // namespace pcl_flashreg
