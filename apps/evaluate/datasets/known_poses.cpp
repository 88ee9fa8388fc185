// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "known_poses.h"

#include <deque>

namespace pcl_flashreg::evaluate {
namespace {

RigidTransform
inverse(const RigidTransform& T)
{
  const Eigen::Matrix3d R = T.rotation.transpose();
  return {R, -R * T.translation};
}

RigidTransform
product(const RigidTransform& a, const RigidTransform& b)
{
  return {a.rotation * b.rotation, a.rotation * b.translation + a.translation};
}

} // namespace

KnownPoses::KnownPoses(const std::vector<const Pair*>& pairs)
{
  for (const Pair* pair : pairs) {
    const RigidTransform& T = pair->T_target_source;
    if (!T.translation.allFinite())
      continue;
    neighbors_[pair->target].emplace_back(pair->source, T);
    neighbors_[pair->source].emplace_back(pair->target, inverse(T));
  }
}

std::optional<RigidTransform>
KnownPoses::between(const std::string& target, const std::string& source) const
{
  std::map<std::string, RigidTransform> reached = {{target, {}}};
  for (std::deque<std::string> next = {target}; !next.empty(); next.pop_front()) {
    if (next.front() == source)
      return reached.at(source);
    const auto neighbors = neighbors_.find(next.front());
    if (neighbors == neighbors_.end())
      continue;
    const RigidTransform T_target_this = reached.at(next.front());
    for (const auto& [cloud, T_this_cloud] : neighbors->second)
      if (reached.emplace(cloud, product(T_target_this, T_this_cloud)).second)
        next.push_back(cloud);
  }
  return std::nullopt;
}

} // namespace pcl_flashreg::evaluate
