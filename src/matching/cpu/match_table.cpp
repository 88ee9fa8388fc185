// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "matching/cpu/match_table.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace pcl_flashreg {

using detail::EqualRows;

MatchTable::MatchTable(const DistinctFeatures& queries,
                       const DistinctFeatures& targets,
                       std::size_t k)
    : queries_(queries),
      targets_(targets),
      length_(std::min(k, targets.finite.size())),
      matches_(queries.finite.size() * length_)
{
}

FeatureMatch*
MatchTable::append(std::int32_t query,
                   const Candidate* begin,
                   const Candidate* end,
                   FeatureMatch* at,
                   const FeatureMatch* full) const
{
  const EqualRows& equal = targets_.equal;
  const auto squared_distance = static_cast<float>(begin->squared_distance);
  const auto firstOf = [&](const Candidate& target) {
    return equal.firsts()[static_cast<std::size_t>(target.index)];
  };
  if (end - begin == 1) {
    for (std::uint32_t t = firstOf(*begin); t != EqualRows::NONE && at != full;
         t = equal.next(t))
      *at++ = {query, targets_.finite[t], squared_distance};
    return at;
  }
  // One of each kind: the least is appended, and the next of its kind takes its place.
  std::vector<std::uint32_t> heads(static_cast<std::size_t>(end - begin));
  std::transform(begin, end, heads.begin(), firstOf);
  const std::greater<> later;
  std::make_heap(heads.begin(), heads.end(), later);
  while (!heads.empty() && at != full) {
    std::pop_heap(heads.begin(), heads.end(), later);
    *at++ = {query, targets_.finite[heads.back()], squared_distance};
    heads.back() = equal.next(heads.back());
    if (heads.back() == EqualRows::NONE)
      heads.pop_back();
    else
      std::push_heap(heads.begin(), heads.end(), later);
  }
  return at;
}

void
MatchTable::enter(std::size_t query, const Candidate* begin, const Candidate* end)
{
  const std::uint32_t first = queries_.equal.firsts()[query];
  FeatureMatch* const own = matches_.data() + first * length_;
  FeatureMatch* const full = own + length_;
  FeatureMatch* at = own;
  // The k nearest of all equal some of the k nearest of the distinct.
  while (begin != end && at != full) {
    const Candidate* ties = std::find_if(begin, end, [&](const Candidate& target) {
      return target.squared_distance != begin->squared_distance;
    });
    at = append(queries_.rows[query], begin, ties, at, full);
    begin = ties;
  }
  for (std::uint32_t q = queries_.equal.next(first); q != EqualRows::NONE;
       q = queries_.equal.next(q)) {
    FeatureMatch* copy = matches_.data() + q * length_;
    for (const FeatureMatch* match = own; match != full; ++match)
      *copy++ = {queries_.finite[q], match->match, match->squared_distance};
  }
}

std::vector<FeatureMatch>
MatchTable::take()
{
  return std::move(matches_);
}

} // namespace pcl_flashreg
