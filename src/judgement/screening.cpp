// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/screening.h"

#include "judgement/displacement.h"

#include <algorithm>
#include <cstdint>

namespace pcl_flashreg {
namespace {

/** \brief How closely all hypotheses are looked at first. */
constexpr LookSettings GLANCE{24, WHILE_SCREENING.tolerance, WHILE_SCREENING.margin};

/** \brief Hypotheses that pass the first screening. */
constexpr std::size_t AFTER_GLANCE = 400;

/** \brief Poses are the same if no corner of the cube around the source moves by more
 * than this many spacings. */
constexpr float SAME = 6;

struct Ranked {
  double evidence;
  std::uint32_t hypothesis;
};

bool
better(const Ranked& a, const Ranked& b)
{
  return a.evidence > b.evidence ||
         (a.evidence == b.evidence && a.hypothesis < b.hypothesis);
}

void
rank(const Look& look,
     const std::vector<Pose>& hypotheses,
     std::vector<Ranked>& ranked,
     ThreadPool& pool)
{
  constexpr std::size_t A_TASK = 32;
  pool.forEach((ranked.size() + A_TASK - 1) / A_TASK,
               [&](std::size_t task, std::size_t) {
                 const std::size_t end = std::min(ranked.size(), (task + 1) * A_TASK);
                 for (std::size_t i = task * A_TASK; i < end; ++i)
                   ranked[i].evidence = shareOf(look(hypotheses[ranked[i].hypothesis]));
               });
}

} // namespace

double
shareOf(const CloudAgreement& agreement)
{
  return agreement.matched /
         (agreement.matched + agreement.contradicted + NOTHING_TOLD);
}

void
screen(const SurfacePair& clouds,
       const std::vector<Pose>& hypotheses,
       double half_side,
       std::size_t most,
       std::vector<Pose>& list,
       ThreadPool& pool)
{
  std::vector<Ranked> ranked(hypotheses.size());
  for (std::size_t i = 0; i < ranked.size(); ++i)
    ranked[i].hypothesis = static_cast<std::uint32_t>(i);
  if (ranked.size() > AFTER_GLANCE) {
    rank(Look(clouds, GLANCE), hypotheses, ranked, pool);
    std::nth_element(
        ranked.begin(), ranked.begin() + AFTER_GLANCE, ranked.end(), better);
    ranked.resize(AFTER_GLANCE);
  }
  rank(Look(clouds, WHILE_SCREENING), hypotheses, ranked, pool);
  std::sort(ranked.begin(), ranked.end(), better);
  const std::size_t wanted = list.size() + most;
  for (const Ranked& entry : ranked) {
    if (list.size() == wanted)
      return;
    const Pose& pose = hypotheses[entry.hypothesis];
    if (std::none_of(list.begin(), list.end(), [&](const Pose& other) {
          return displacementOf(pose, other, half_side) < SAME * clouds.spacing;
        }))
      list.push_back(pose);
  }
}

} // namespace pcl_flashreg
