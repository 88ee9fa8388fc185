// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/problem.h"

#include <cstdint>
#include <vector>

namespace pcl_flashreg {

/** \brief A host copy of what every stage put out, for tests and diagnostics. Two backends
 * agree if their traces are equal through the cliques. */
struct Trace {
  std::size_t size = 0;
  /** \brief Words from one row of the bit matrix to the next. */
  std::size_t words_per_row = 0;
  /** \brief size rows; bit j % 64 of word j / 64 of row i: the pair (i, j) is an edge. */
  std::vector<std::uint64_t> first_order_graph;
  /** \brief Entries with a positive score, ascending by u, then v. */
  std::vector<Edge> second_order_graph;
  /** \brief Bounded mode: candidate pools, row by row, best first. */
  std::vector<Edge> pools;
  std::vector<Edge> pivots;
  std::vector<Clique> cliques;
  /** \brief One a clique, in the centred frames; unspecified where not valid. */
  std::vector<Pose> hypotheses;
  std::vector<char> hypothesis_valid;
  /** \brief One a clique, in units of SCORE_UNIT; -1 where not valid. */
  std::vector<std::int64_t> scores;

  bool
  hasEdge(std::size_t i, std::size_t j) const
  {
    return (first_order_graph[i * words_per_row + j / WORD_BITS] >> (j % WORD_BITS)) &
           1;
  }
};

} // namespace pcl_flashreg
