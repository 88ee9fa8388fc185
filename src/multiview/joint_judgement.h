// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/contacts.h"
#include "multiview/map_scans.h"

#include <vector>

namespace pcl_flashreg {

/** \brief See JointAgreement::harmony(): of nine in ten right placements it is more. */
constexpr double HARMONY = 3.5;

/** \brief What all clouds of two groups say of how the groups lie to each other. */
struct JointAgreement {
  /** \brief Points that match and that are contradicted, added up over pairs of scans. */
  double matched = 0, contradicted = 0;
  /** \brief Of a scan. */
  double points = 0;
  /** \brief Whether some viewpoint was known: nothing is contradicted elsewhere. */
  bool seeing = false;

  /** \brief Logarithm of matched over contradicted, no more than HARMONY, beyond which it says
   * nothing more. */
  double
  harmony() const;
};

/** \brief Two scans of different groups that may touch. */
struct Meeting {
  std::size_t fixed, moving;
};

/** \brief Asks clouds about groups of scans; the poses are those of the fixed group and of the
 * moving one, each in its own frame. */
class JointJudgement {
public:
  JointJudgement(const MapScans& scans, const MapPoses& poses)
      : scans_(scans), poses_(poses)
  {
  }

  /** \brief Pairs that are near each other, the nearest first, so many at most.
   * \param[in] T_fixed_moving from the frame of the moving group */
  std::vector<Meeting>
  meetings(const std::vector<std::size_t>& fixed,
           const std::vector<std::size_t>& moving,
           const Eigen::Isometry3d& T_fixed_moving) const;

  JointAgreement
  agreement(const std::vector<Meeting>& meetings,
            const Eigen::Isometry3d& T_fixed_moving) const;

  /** \brief Moves the moving group onto the surfaces of the fixed one. */
  Eigen::Isometry3d
  moveOntoFixed(const std::vector<Meeting>& meetings,
                const Eigen::Isometry3d& T_fixed_moving) const;

private:
  void
  addContacts(const Meeting& meeting,
              const Eigen::Isometry3d& T_fixed_moving,
              const Reach& reach,
              const Eigen::Vector3d& origin,
              std::vector<Contact>& contacts) const;

  /** \brief T_fixed scan_moving scan: between the middles of two scans. */
  Eigen::Isometry3d
  between(const Meeting& meeting, const Eigen::Isometry3d& T_fixed_moving) const
  {
    return poses_[meeting.fixed].inverse() * T_fixed_moving * poses_[meeting.moving];
  }

  const MapScans& scans_;
  const MapPoses& poses_;
};

} // namespace pcl_flashreg
