// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_flashreg {

/** \brief What could be a match of something, and how far it is. */
struct Candidate {
  double squared_distance;
  std::int32_t index;

  bool
  operator<(const Candidate& other) const
  {
    return squared_distance != other.squared_distance
               ? squared_distance < other.squared_distance
               : index < other.index;
  }
};

/** \brief The k best candidates of each of n descriptors, best first. */
class NearestLists {
public:
  NearestLists(std::size_t n, std::size_t k) : k_(k), lists_(n * k), counts_(n, 0) {}

  /** \brief Puts a candidate into list i, if it is among the best and not there yet.
   * \return whether the list has changed */
  bool
  offer(std::size_t i, const Candidate& candidate)
  {
    Candidate* first = lists_.data() + i * k_;
    Candidate* last = first + counts_[i];
    if (counts_[i] == k_ && !(candidate < last[-1]))
      return false;
    Candidate* at = std::lower_bound(first, last, candidate);
    if (at != last && at->index == candidate.index)
      return false;
    if (counts_[i] < k_)
      ++last, ++counts_[i];
    std::move_backward(at, last - 1, last);
    *at = candidate;
    return true;
  }

  /** \brief What a candidate has to beat: infinity while the list is not full. */
  double
  worst(std::size_t i) const
  {
    return counts_[i] < k_ ? std::numeric_limits<double>::infinity()
                           : lists_[i * k_ + k_ - 1].squared_distance;
  }

  const Candidate*
  begin(std::size_t i) const
  {
    return lists_.data() + i * k_;
  }

  const Candidate*
  end(std::size_t i) const
  {
    return begin(i) + counts_[i];
  }

  void
  clear(std::size_t i)
  {
    counts_[i] = 0;
  }

private:
  std::size_t k_;
  std::vector<Candidate> lists_;
  std::vector<std::size_t> counts_;
};

} // namespace pcl_flashreg
