// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/joint_judgement.h"

#include "judgement/cpu/agreement.h"
#include "judgement/cpu/contacts.h"
#include "judgement/cpu/plane_alignment.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief See Look. */
constexpr std::size_t POINTS = 256;
constexpr float TOLERANCE = 1.5f, MARGIN = 2;

/** \brief Points that are moved onto the surfaces: of all pairs together, and of one at least. */
constexpr std::size_t POINTS_MOVED = 4000, LEAST_POINTS_MOVED = 64;

/** \brief Pairs of scans that are asked at most. */
constexpr std::size_t MOST_MEETINGS = 48;

/** \brief Of a scan's points: what stays below it tells nothing. */
constexpr double NOTHING = 0.005;

} // namespace

double
JointAgreement::harmony() const
{
  // What groups without viewpoints say is neither for them nor against them.
  constexpr double UNKNOWN = 2.5;
  if (!seeing)
    return UNKNOWN;
  const double nothing = NOTHING * points;
  return std::min(HARMONY, std::log((matched + nothing) / (contradicted + nothing)));
}

std::vector<Meeting>
JointJudgement::meetings(const std::vector<std::size_t>& fixed,
                         const std::vector<std::size_t>& moving,
                         const Eigen::Isometry3d& T_fixed_moving) const
{
  struct Near {
    double apart;
    Meeting meeting;
  };
  std::vector<Near> near;
  for (const std::size_t j : moving) {
    const Eigen::Vector3d place = T_fixed_moving * poses_[j].translation();
    const double radius = scans_[j].radius;
    for (const std::size_t i : fixed) {
      const double apart = (poses_[i].translation() - place).norm();
      if (apart < radius + scans_[i].radius)
        near.push_back({apart, {i, j}});
    }
  }
  std::stable_sort(near.begin(), near.end(), [](const Near& a, const Near& b) {
    return a.apart < b.apart;
  });
  near.resize(std::min(near.size(), MOST_MEETINGS));
  std::vector<Meeting> result;
  for (const Near& entry : near)
    result.push_back(entry.meeting);
  return result;
}

JointAgreement
JointJudgement::agreement(const std::vector<Meeting>& meetings,
                          const Eigen::Isometry3d& T_fixed_moving) const
{
  JointAgreement sum;
  double points = 0;
  for (const Meeting& meeting : meetings) {
    const TwoClouds clouds = scans_.clouds(meeting.moving, meeting.fixed);
    const SurfacePair pair = clouds.pair();
    const Look look(pair, POINTS, TOLERANCE, MARGIN);
    const CloudAgreement agreement = look(toPose(between(meeting, T_fixed_moving)));
    const auto both = static_cast<double>(scans_[meeting.moving].points +
                                          scans_[meeting.fixed].points);
    sum.matched += both * agreement.matched;
    sum.contradicted += both * agreement.contradicted;
    sum.seeing = sum.seeing || pair.seeing();
    points += both / 2;
  }
  if (!meetings.empty())
    sum.points = points / static_cast<double>(meetings.size());
  return sum;
}

/** \brief What the moving scan touches, in the fixed group's frame but for the origin. */
void
JointJudgement::addContacts(const Meeting& meeting,
                            const Eigen::Isometry3d& T_fixed_moving,
                            const Reach& reach,
                            const Eigen::Vector3d& origin,
                            std::vector<Contact>& contacts) const
{
  const TwoClouds clouds = scans_.clouds(meeting.moving, meeting.fixed);
  const std::size_t first = contacts.size();
  findContacts(clouds.pair(),
               toRigidFloat(toPose(between(meeting, T_fixed_moving))),
               reach,
               contacts);
  Eigen::Isometry3d frame = poses_[meeting.fixed];
  frame.translation() -= origin;
  for (std::size_t i = first; i < contacts.size(); ++i) {
    Contact& contact = contacts[i];
    contact.place = (frame * contact.place.cast<double>()).cast<float>();
    contact.normal = (frame.linear() * contact.normal.cast<double>()).cast<float>();
  }
}

Eigen::Isometry3d
JointJudgement::moveOntoFixed(const std::vector<Meeting>& meetings,
                              const Eigen::Isometry3d& T_fixed_moving) const
{
  if (meetings.empty())
    return T_fixed_moving;
  const Eigen::Vector3d origin = poses_[meetings.front().fixed].translation();
  Eigen::Isometry3d moved = T_fixed_moving;
  moved.translation() -= origin;
  std::vector<Contact> contacts;
  for (int round = 0; round < PLANE_ROUNDS; ++round) {
    contacts.clear();
    Eigen::Isometry3d T = moved;
    T.translation() += origin;
    Reach reach = reachOf(round);
    reach.points = std::min(
        reach.points, std::max(LEAST_POINTS_MOVED, POINTS_MOVED / meetings.size()));
    for (const Meeting& meeting : meetings)
      addContacts(meeting, T, reach, origin, contacts);
    const auto spacing = static_cast<float>(scans_[meetings.front().moving].spacing);
    const std::optional<PlaneStep> step = stepOntoPlanes(contacts, spacing);
    if (!step)
      break;
    const Eigen::Vector3d shifted = *step * moved.translation();
    moved.linear() =
        Eigen::Quaterniond(step->rotation * moved.linear()).normalized().matrix();
    moved.translation() = shifted;
  }
  moved.translation() += origin;
  return moved;
}

} // namespace pcl_flashreg
