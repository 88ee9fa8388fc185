// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What the kernels read and write: plain structs, passed by value.

#include "math/edge_filter.h"
#include "math/residual.h"
#include "math/pose.h"
#include "math/upright.h"
#include "estimation/problem.h"

#include <pcl_flashreg/parameters.h>

#include <cuda_runtime.h>

#include <cstdint>

namespace pcl_flashreg {
namespace cuda {

/** \brief Rows of the bit matrix are whole multiples of this many bits. */
constexpr unsigned ROW_BITS = 512;

/** \brief Scores below this are counted in shared memory first. */
constexpr unsigned SHARED_BINS = 512;

/** \brief Hypotheses that are refined side by side. */
constexpr unsigned MOST_CANDIDATES = 16;

/** \brief A correspondence's neighbours in the first-order graph, as a list. */
struct alignas(16) Neighbours {
  /** \brief Where the list begins in Call::neighbours. */
  unsigned begin;
  unsigned degree;
  /** \brief How many of them, the last ones, have larger indices ... */
  unsigned above;
  /** \brief ... and where the scores of these edges begin in Call::scores. */
  unsigned scores_begin;
};

/** \brief Scored entries (u, columns[i]) of one row u. */
struct Row {
  unsigned columns_begin, scores_begin, length;
};

/** \brief A sparse matrix, row by row. */
struct Rows {
  unsigned* columns;
  unsigned* scores;
  Row* rows;
};

/** \brief Where the K best edges end: all above the threshold, and some at it. */
struct Cut {
  unsigned threshold;
  /** \brief How many are above; how many of those at the threshold belong to the best. */
  unsigned above, ties;
};

/** \brief What kernels tell each other and the host; all zeros at the start of a call. */
struct Control {
  /** \brief Entries of the first-order graph, and those above the diagonal. */
  unsigned long long entries, edges;
  /** \brief One for every use of lastBlock(). */
  unsigned score_ticket, ties_ticket, refinement_ticket;
  unsigned best_score;
  Cut cut;
  unsigned pivots;
  bool any_clique;
  /** \brief Pivots above the threshold that were written so far. */
  unsigned written;

  // Refinement: the slots that are being refined, in order, and what came of them.
  unsigned batch_size;
  unsigned batch[MOST_CANDIDATES];
  ScoredPose candidates[MOST_CANDIDATES];
  /** \brief Rank of the last slot that was considered, see refinement.cu; 0: none was. */
  unsigned long long last_rank;
  unsigned refinements, listed_count;
  bool done;
};

/** \brief A pose as verification reads it: 64 bytes. */
struct alignas(16) SlotPose {
  PoseF pose;
  ResidualBounds bounds;
  float unused[2];
};

/** \brief Everything about a call; the pointers are the device's. */
struct Call {
  // The problem: coordinates padded with NaN to `padded`, a multiple of ROW_BITS.
  const float *sx, *sy, *sz, *tx, *ty, *tz;
  /** \brief Of upright motions alone, see Problem::rise. */
  const float* rise;
  unsigned size, padded;
  /** \brief 32-bit words a row of the bit matrix. */
  unsigned words;
  float radius;

  // Parameters.
  float length_tolerance, min_length_sum, inlier_distance;
  unsigned pivots, cliques_per_pivot, row_capacity, pool_capacity;
  unsigned max_hypotheses, refinement_iterations;
  SecondOrder second_order;
  ScoreMetric metric;
  EdgeFilter filter;
  Upright upright;
  float height_margin;

  // What the host expects of stage 2; see planHolds().
  bool exact;
  unsigned long long entry_capacity;

  Control* control;
  unsigned* histogram;

  // Stage 1. Symmetric: `padded` rows, one bit a column.
  unsigned* graph;
  // Stage 2.
  unsigned* neighbours;
  Neighbours* neighbour_rows;
  unsigned* row_best;
  /** \brief The upper triangle of the second-order graph, columns ascending. */
  Rows upper;
  /** \brief What pivots are chosen from: the same in exact mode, else the pools. */
  Rows pool;
  // Stage 3. Room for a multiple of 4.
  unsigned* tie_begin;
  /** \brief In the end sorted; see Pivot. */
  unsigned long long *pivot_keys, *pivot_keys_other;
  // Stages 4 to 6: cliques_per_pivot slots a pivot, the caller's guess in the last one.
  Clique* cliques;
  unsigned* clique_counts;
  unsigned slots;
  bool has_guess;
  Pose guess;
  Pose* poses;
  SlotPose* slot_poses;
  long long* scores;
  // Stage 7: bit sets of `words` words.
  unsigned* candidate_inliers;
  unsigned* candidate_lists;
  /** \brief LISTED_CLIQUES places; a score of 0 where there is none. */
  Clique* listed_cliques;
  unsigned* listed_inliers;
  ScoredPose* listed;
};

/** \brief Whether a first-order graph of so many entries calls for the exact form of
 * stage 2. */
PCL_FLASHREG_HD inline bool
callsForExact(const Call& call, unsigned long long entries)
{
  return call.second_order == SecondOrder::Exact ||
         (call.second_order == SecondOrder::Auto &&
          entries <= 8ull * call.row_capacity * call.size);
}

/** \brief Whether stage 2 has the form that the input calls for, and room for it. The host
 * decides on both before it knows the input; where it was wrong, all kernels from here on
 * do nothing, and the host, which learns of it with the result, starts over. */
PCL_FLASHREG_HD inline bool
planHolds(const Call& call, unsigned long long entries)
{
  return call.exact == callsForExact(call, entries) &&
         (!call.exact || entries <= call.entry_capacity);
}

__device__ inline bool
planHolds(const Call& call)
{
  return planHolds(call, call.control->entries);
}

/** \brief A pivot as one number, whose ascending order is score descending, then u, then
 * v. */
struct Pivot {
  static constexpr unsigned INDEX_BITS = 18, SCORE_BITS = 28;
  static_assert(2 * INDEX_BITS + SCORE_BITS == 64, "fills a word");
  static constexpr unsigned LARGEST_SCORE = (1u << SCORE_BITS) - 1;

  PCL_FLASHREG_HD static unsigned long long
  key(unsigned u, unsigned v, unsigned score)
  {
    return (static_cast<unsigned long long>(LARGEST_SCORE - score)
            << (2 * INDEX_BITS)) |
           (static_cast<unsigned long long>(u) << INDEX_BITS) | v;
  }
  PCL_FLASHREG_HD static Edge
  edge(unsigned long long key)
  {
    constexpr unsigned mask = (1u << INDEX_BITS) - 1;
    return {static_cast<unsigned>(key >> INDEX_BITS) & mask,
            static_cast<unsigned>(key) & mask,
            LARGEST_SCORE - static_cast<unsigned>(key >> (2 * INDEX_BITS))};
  }
};

} // namespace cuda
} // namespace pcl_flashreg
