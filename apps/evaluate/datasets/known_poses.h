// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "pair.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief True poses between any two clouds, chained from those of the pairs. */
class KnownPoses {
public:
  /** \brief As the list says: not refined (Pair::refine_truth). */
  explicit KnownPoses(const std::vector<const Pair*>& pairs);

  /** \brief T_target_source over as few pairs as can be: of a pair itself, where it is one.
   * Nothing if no chain of pairs leads from one to the other. */
  std::optional<RigidTransform>
  between(const std::string& target, const std::string& source) const;

private:
  /** \brief Of each cloud its neighbours, and how they lie to it. */
  std::map<std::string, std::vector<std::pair<std::string, RigidTransform>>> neighbors_;
};

} // namespace pcl_flashreg::evaluate
