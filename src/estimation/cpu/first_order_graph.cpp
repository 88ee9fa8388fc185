// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 1: the compatibility graph as a bit matrix, Eq. (dis) and (fog).
// Most pairs are decided by a filter, math/edge_filter.h, and the rest by the exact test.

#include "estimation/cpu/stages.h"
#include "math/edge_filter.h"

#include <algorithm>

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief Blocks of 64 in a tile: 8 words, so that no two tiles write to one cache line. */
constexpr std::size_t TILE_BLOCKS = 8;

} // namespace

EdgeTestInput
Stages::edgeTestInput()
{
  const Problem& p = *problem_;
  source_norm_.resize(p.padded_size);
  target_norm_.resize(p.padded_size);
  for (std::size_t i = 0; i < p.padded_size; ++i) {
    const Vec3 s = p.source(i), t = p.target(i);
    source_norm_[i] = static_cast<float>(dot(s, s));
    target_norm_[i] = static_cast<float>(dot(t, t));
  }
  EdgeTestInput in{};
  in.sx = p.sx.data();
  in.sy = p.sy.data();
  in.sz = p.sz.data();
  in.tx = p.tx.data();
  in.ty = p.ty.data();
  in.tz = p.tz.data();
  in.source_norm = source_norm_.data();
  in.target_norm = target_norm_.data();
  in.length_tolerance = parameters_->length_tolerance;
  in.min_length_sum = parameters_->min_length_sum;
  const EdgeFilter filter =
      edgeFilter(p.radius, in.length_tolerance, in.min_length_sum);
  in.use_filter = filter.use;
  in.minus_two_tau2 = filter.minus_two_tau2;
  in.tau4 = filter.tau4;
  in.sure_defect = filter.sure_defect;
  in.possible_defect = filter.possible_defect;
  in.sure_sum = filter.sure_sum;
  in.possible_sum = filter.possible_sum;
  in.rise = p.rise.data();
  in.squared_slope = p.upright.squared_slope;
  in.height_margin = heightMargin(p.radius, p.upright.squared_slope);
  return in;
}

/** \brief Tests one block of 64 x 64 pairs.
 * \param[out] edges word r holds row r, bit c column c
 */
void
Stages::testBlock(const EdgeTestInput& input,
                  std::size_t row_block,
                  std::size_t column_block,
                  std::uint64_t edges[WORD_BITS])
{
  std::uint64_t possible[WORD_BITS];
  const std::size_t row0 = row_block * WORD_BITS;
  const std::size_t column0 = column_block * WORD_BITS;
  const Kernels& kernels = input.use_filter ? kernels_ : scalarKernels();
  const auto test =
      problem_->upright.required ? kernels.uprightEdgeTest : kernels.edgeTest;
  test(input, row0, column0, edges, possible);
  for (std::size_t r = 0; r < WORD_BITS; ++r)
    for (std::uint64_t open = possible[r] & ~edges[r]; open != 0; open &= open - 1) {
      const int c = __builtin_ctzll(open);
      if (problem_->isEdge(
              row0 + r, column0 + c, input.length_tolerance, input.min_length_sum))
        edges[r] |= std::uint64_t{1} << c;
    }
  if (row_block == column_block)
    for (std::size_t r = 0; r < WORD_BITS; ++r)
      edges[r] &= ~(std::uint64_t{1} << r);
}

/** \brief Fills a tile of blocks and its mirror image. */
void
Stages::fillTile(const EdgeTestInput& input,
                 std::size_t tile_row,
                 std::size_t tile_column)
{
  const std::size_t blocks = problem_->padded_size / WORD_BITS;
  const std::size_t row_end = std::min(blocks, (tile_row + 1) * TILE_BLOCKS);
  const std::size_t column_end = std::min(blocks, (tile_column + 1) * TILE_BLOCKS);
  for (std::size_t i = tile_row * TILE_BLOCKS; i < row_end; ++i)
    for (std::size_t j = std::max(i, tile_column * TILE_BLOCKS); j < column_end; ++j) {
      std::uint64_t edges[WORD_BITS];
      testBlock(input, i, j, edges);
      for (std::size_t r = 0; r < WORD_BITS; ++r)
        graph_[(i * WORD_BITS + r) * words_ + j] = edges[r];
      if (i == j)
        continue;
      kernels_.transpose(edges);
      for (std::size_t r = 0; r < WORD_BITS; ++r)
        graph_[(j * WORD_BITS + r) * words_ + i] = edges[r];
    }
}

void
Stages::firstOrderGraph()
{
  const std::size_t blocks = problem_->padded_size / WORD_BITS;
  words_ = (blocks + TILE_BLOCKS - 1) / TILE_BLOCKS * TILE_BLOCKS;
  graph_.resize(problem_->padded_size * words_);
  for (std::size_t i = 0; i < problem_->padded_size; ++i)
    for (std::size_t w = blocks; w < words_; ++w)
      graph_[i * words_ + w] = 0;
  const EdgeTestInput input = edgeTestInput();
  const std::size_t tiles = words_ / TILE_BLOCKS;
  // Tiles of the upper triangle, numbered row by row.
  pool_.forEach(tiles * (tiles + 1) / 2, [&](std::size_t number, std::size_t) {
    std::size_t tile_row = 0;
    while (number >= tiles - tile_row)
      number -= tiles - tile_row++;
    fillTile(input, tile_row, tile_row + number);
  });
}

} // namespace cpu
} // namespace pcl_flashreg
