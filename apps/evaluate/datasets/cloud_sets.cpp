// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cloud_sets.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace pcl_flashreg::evaluate {
namespace {

/** \brief Scenes, numbered as they come; those that share a cloud get the number of the
 * first of them. */
class Scenes {
public:
  std::size_t
  add(const Pair& pair)
  {
    const auto [scene, is_new] =
        numbers_.try_emplace({pair.dataset, pair.scene}, first_.size());
    if (is_new)
      first_.push_back(scene->second);
    for (const std::string& cloud : {pair.source, pair.target}) {
      const auto owner = owners_.try_emplace(cloud, scene->second).first;
      join(firstOf(owner->second), firstOf(scene->second));
    }
    return scene->second;
  }

  std::size_t
  firstOf(std::size_t scene) const
  {
    while (first_[scene] != scene)
      scene = first_[scene];
    return scene;
  }

private:
  void
  join(std::size_t a, std::size_t b)
  {
    first_[std::max(a, b)] = std::min(a, b);
  }

  std::map<std::pair<std::string, std::string>, std::size_t> numbers_;
  /** \brief A scene that it belongs with; itself if there is none before it. */
  std::vector<std::size_t> first_;
  std::map<std::string, std::size_t> owners_;
};

/** \brief What the sets are put together from. */
struct Parts {
  std::vector<std::string> names;
  std::set<std::string> clouds;
};

} // namespace

std::vector<CloudSet>
cloudSets(const std::vector<const Pair*>& pairs)
{
  Scenes scenes;
  std::vector<std::size_t> scene_of;
  for (const Pair* pair : pairs)
    scene_of.push_back(scenes.add(*pair));
  std::map<std::size_t, Parts> sets;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Parts& parts = sets[scenes.firstOf(scene_of[i])];
    const std::string& name =
        pairs[i]->scene.empty() ? pairs[i]->dataset : pairs[i]->scene;
    if (std::find(parts.names.begin(), parts.names.end(), name) == parts.names.end())
      parts.names.push_back(name);
    parts.clouds.insert({pairs[i]->source, pairs[i]->target});
  }
  std::vector<CloudSet> result;
  for (const auto& [first, parts] : sets) {
    CloudSet set;
    for (const std::string& name : parts.names)
      set.name += (set.name.empty() ? "" : ", ") + name;
    set.clouds.assign(parts.clouds.begin(), parts.clouds.end());
    result.push_back(std::move(set));
  }
  return result;
}

} // namespace pcl_flashreg::evaluate
