// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// The hot loops, one table of functions an instruction set. Plain types only: the files
// that fill the tables are compiled with instruction-set flags, and whatever inline
// function they shared with the rest of the program could be linked in their version.

#include <cstddef>
#include <cstdint>

namespace pcl_flashreg {
namespace cpu {

/** \brief Input of the edge test for blocks of 64 x 64 correspondences. */
struct EdgeTestInput {
  /** \brief Centred coordinates; 64-byte aligned, NaN beyond the last. */
  const float *sx, *sy, *sz, *tx, *ty, *tz;
  /** \brief Squared norms of the source and target points. */
  const float *source_norm, *target_norm;
  /** \brief tau and r, for the exact test. */
  float length_tolerance, min_length_sum;
  /** \brief Whether the thresholds below hold; if not, only scalarKernels() may be used. */
  bool use_filter;
  /** \brief -2 tau^2 and tau^4. */
  float minus_two_tau2, tau4;
  /** \brief Edge for certain if E < sure_defect and S > sure_sum; possibly an edge if
   * E < possible_defect and S > possible_sum. See math/edge_filter.h. */
  float sure_defect, possible_defect;
  float sure_sum, possible_sum;
  /** \brief Of upright motions alone: see keepsHeight(), aligned as the coordinates ... */
  const float* rise;
  float squared_slope;
  /** \brief ... and heightMargin(). */
  float height_margin;
};

/** \brief Input of the residual test of one pose on all correspondences. */
struct ResidualInput {
  const float *sx, *sy, *sz, *tx, *ty, *tz;
  /** \brief Rotation, row-major, and translation. */
  float r[9];
  float t[3];
  /** \brief Inlier for certain if the squared residual, however it is rounded, is below
   * `sure`; possibly one if it is below `possible`. */
  float sure, possible;
};

/** \brief Input of the distance filter of feature matching. */
struct FeatureBlock {
  /** \brief Targets, 32 at a time: block b holds dimension d of target 32 b + i at
   * [(b * dimension + d) * 32 + i]; 64-byte aligned. */
  const float* targets;
  /** \brief Squared norm of every target; infinite for padding. */
  const float* target_norms;
  std::size_t dimension;
};

/** \brief Queries of the distance filter, QUERY_BLOCK of them. */
struct QueryRows {
  /** \brief Rows of `dimension` floats. */
  const float* values;
  /** \brief |t|^2 - 2 q.t below which a target is a candidate for the query; minus
   * infinity if none is. */
  const float* thresholds;
};

/** \brief Number of targets in a block of FeatureBlock. */
constexpr std::size_t FEATURE_BLOCK = 32;
/** \brief Number of queries that featureCandidates() takes at a time. */
constexpr std::size_t QUERY_BLOCK = 8;

/** \brief Oriented points, sorted by cell of the neighbour grid, as separate arrays; NEIGHBOR_BLOCK
 * entries longer than there are points. A point with a coordinate that is not a number is
 * nobody's neighbour. */
struct SurfaceArrays {
  const float *x, *y, *z;
  /** \brief Unit normals; null until they are known. */
  const float *nx, *ny, *nz;
};

/** \brief Consecutive points of SurfaceArrays: [begin, end). */
struct PointRun {
  std::uint32_t begin, end;
};

/** \brief Sums over neighbours run in this many lanes, whatever the registers' width, so that
 * every instruction set adds up in the same order. */
constexpr std::size_t NEIGHBOR_BLOCK = 16;
/** \brief Bins of one angle in a point feature histogram. */
constexpr std::size_t HISTOGRAM_BINS = 11;
/** \brief Bins of a whole one: three angles. */
constexpr std::size_t FPFH_BINS = 3 * HISTOGRAM_BINS;
/** \brief Floats from one histogram row to the next: whole cache lines; zeros behind the bins. */
constexpr std::size_t HISTOGRAM_STRIDE = 48;

/** \brief The hot loops of one instruction set. */
struct Kernels {
  /** \brief As it is spelled in the environment variable and the backend's name. */
  const char* name;

  /** \brief Edge test of 64 rows by 64 columns. Bit c of word r: the pair (row0 + r,
   * column0 + c) is an edge for certain / possibly one. sure is a subset of possible. */
  void (*edgeTest)(const EdgeTestInput& input,
                   std::size_t row0,
                   std::size_t column0,
                   std::uint64_t sure[64],
                   std::uint64_t possible[64]);

  /** \brief The same of upright motions. */
  decltype(edgeTest) uprightEdgeTest;

  /** \brief Transposes a 64 x 64 bit matrix in place. */
  void (*transpose)(std::uint64_t block[64]);

  /** \brief Number of bits that `row` shares with each of `count` rows of a bit matrix.
   * Rows are `stride` words apart; the first `words` words are compared. Beyond them, up
   * to the next multiple of 8, `row` must hold zeros. */
  void (*commonNeighbours)(const std::uint64_t* row,
                           const std::uint64_t* matrix,
                           std::size_t stride,
                           std::size_t words,
                           const std::uint32_t* rows,
                           std::size_t count,
                           std::uint32_t* common);

  /** \brief Number of bits set in n words. */
  std::size_t (*countBits)(const std::uint64_t* words, std::size_t n);

  /** \brief The bits that two rows share from word `first` on, ascending; in word `first`
   * only those of `mask` count.
   * \param[out] bits, ranks_a, ranks_b index of each shared bit, and how many bits of
   * either row stand before it (from word `first` on, under the mask)
   * \return how many are shared
   */
  std::size_t (*intersect)(const std::uint64_t* a,
                           const std::uint64_t* b,
                           std::size_t first,
                           std::size_t words,
                           std::uint64_t mask,
                           std::uint32_t* bits,
                           std::uint32_t* ranks_a,
                           std::uint32_t* ranks_b);

  /** \brief Residual test of the correspondences from 64 * first_word on. Bit c of word
   * w: correspondence 64 * (first_word + w) + c is an inlier for certain / possibly. */
  void (*residualTest)(const ResidualInput& input,
                       std::size_t first_word,
                       std::size_t words,
                       std::uint64_t* sure,
                       std::uint64_t* possible);

  /** \brief Bit i of candidates[q]: |t|^2 - 2 q.t of target 32 * block + i is below the
   * query's threshold. */
  void (*featureCandidates)(const FeatureBlock& input,
                            std::size_t block,
                            const QueryRows& queries,
                            std::uint32_t* candidates);

  /** \brief The points of the runs whose squared distance from the query,
   * (dx^2 + dy^2) + dz^2 rounded once an operation, is below squared_radius; in order.
   * \param[out] indices, squared_distances room for NEIGHBOR_BLOCK more than are found
   * \return how many there are
   */
  std::size_t (*collectNeighbors)(const SurfaceArrays& points,
                                  const PointRun* runs,
                                  std::size_t run_count,
                                  const float query[3],
                                  float squared_radius,
                                  std::uint32_t* indices,
                                  float* squared_distances);

  /** \brief Sums over neighbours of d = point - query: x, y, z, xx, xy, xz, yy, yz, zz.
   * `count` is a multiple of NEIGHBOR_BLOCK; the query itself adds nothing. */
  void (*momentSums)(const SurfaceArrays& points,
                     const float query[3],
                     const std::uint32_t* indices,
                     std::size_t count,
                     float sums[9]);

  /** \brief Adds the pairs of point `query` and each neighbour to three histograms of
   * HISTOGRAM_BINS (see math/pair_features.h). `count` is a multiple of NEIGHBOR_BLOCK;
   * neighbours that make no pair with the query, as the query itself, are left out. */
  void (*pairHistogram)(const SurfaceArrays& points,
                        std::uint32_t query,
                        const std::uint32_t* indices,
                        std::size_t count,
                        std::uint32_t* histogram);

  /** \brief Sum of histogram rows (HISTOGRAM_STRIDE apart), each times its weight, in order. */
  void (*weightedRowSum)(const float* rows,
                         const std::uint32_t* indices,
                         const float* weights,
                         std::size_t count,
                         float* sum);
};

/** \brief The variants that this processor runs, fastest first; never empty.
 * \param[out] count how many
 */
const Kernels* const*
availableKernels(std::size_t& count);

/** \brief The variant that takes the exact formulas throughout; it runs anywhere. */
const Kernels&
scalarKernels();

/** \brief The variant that the environment variable PCL_FLASHREG_CPU names, or the fastest.
 * \throws std::invalid_argument if the name is unknown, BackendError if this processor
 * lacks the instructions
 */
const Kernels&
selectKernels();

/** \brief What selectKernels() returned when it was first asked here: for what is no part of an
 * estimator, in loops that should not look into the environment. All variants agree to the last
 * bit.
 * \throws as selectKernels(), the first time */
const Kernels&
usualKernels();

} // namespace cpu
} // namespace pcl_flashreg
