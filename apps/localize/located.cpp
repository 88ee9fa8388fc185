// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "located.h"

namespace pcl_flashreg::localize {
namespace {

double
supportOf(const CloudAgreement& agreement)
{
  return agreement.matched - agreement.contradicted;
}

} // namespace

bool
isRival(const CloudAgreement& other, const CloudAgreement& pose)
{
  constexpr double ENOUGH = 0.5;
  return supportOf(other) >= ENOUGH * supportOf(pose);
}

std::vector<Hypothesis>
rivalsOf(const Result& result)
{
  std::vector<Hypothesis> rivals;
  for (std::size_t i = 1; i < result.hypotheses.size() && rivals.size() < MOST_RIVALS;
       ++i) {
    const Hypothesis& other = result.hypotheses[i];
    if (other.agreement && isRival(*other.agreement, result.evidence.agreement))
      rivals.push_back(other);
  }
  return rivals;
}

} // namespace pcl_flashreg::localize
