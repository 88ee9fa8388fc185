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

std::vector<Hypothesis>
rivalsOf(const Result& result)
{
  constexpr double ENOUGH = 0.5;
  constexpr std::size_t MOST = 5;
  std::vector<Hypothesis> rivals;
  const double needed = ENOUGH * supportOf(result.evidence.agreement);
  for (std::size_t i = 1; i < result.hypotheses.size() && rivals.size() < MOST; ++i) {
    const Hypothesis& other = result.hypotheses[i];
    if (other.agreement && supportOf(*other.agreement) >= needed)
      rivals.push_back(other);
  }
  return rivals;
}

} // namespace pcl_flashreg::localize
