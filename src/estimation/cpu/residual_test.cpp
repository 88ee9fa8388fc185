// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "estimation/cpu/residual_test.h"

#include "estimation/cpu/bits.h"

#include <algorithm>

namespace pcl_flashreg {
namespace cpu {

ResidualTest::ResidualTest(const Kernels& kernels,
                           const Problem& problem,
                           float inlier_distance)
    : kernels_(kernels), problem_(problem), inlier_distance_(inlier_distance)
{
}

ResidualTest::Tested
ResidualTest::of(const PoseF& pose) const
{
  const Problem& p = problem_;
  Tested tested{pose,
                {p.sx.data(),
                 p.sy.data(),
                 p.sz.data(),
                 p.tx.data(),
                 p.ty.data(),
                 p.tz.data(),
                 {},
                 {},
                 0,
                 0}};
  ResidualInput& input = tested.input;
  std::copy(pose.r, pose.r + 9, input.r);
  std::copy(pose.t, pose.t + 3, input.t);
  const ResidualBounds bounds = residualBounds(pose, p.radius, inlier_distance_);
  input.sure = bounds.sure;
  input.possible = bounds.possible;
  return tested;
}

int
ResidualTest::operator()(const Tested& tested,
                         std::size_t first_word,
                         std::size_t words,
                         std::uint64_t* agreeing,
                         std::uint64_t* scratch) const
{
  kernels_.residualTest(tested.input, first_word, words, agreeing, scratch);
  const float squared_limit = inlier_distance_ * inlier_distance_;
  for (std::size_t w = 0; w < words; ++w)
    for (std::uint64_t open = scratch[w] & ~agreeing[w]; open != 0; open &= open - 1) {
      const std::size_t bit = __builtin_ctzll(open);
      const PointPair pair = problem_.pair((first_word + w) * WORD_BITS + bit);
      if (squaredResidual(tested.pose, pair) < squared_limit)
        agreeing[w] |= std::uint64_t{1} << bit;
    }
  return static_cast<int>(kernels_.countBits(agreeing, words));
}

template <typename Consumer>
void
ResidualTest::forEachBlock(const PoseF& pose, const Consumer& consumer) const
{
  const Tested tested = of(pose);
  const std::size_t all = problem_.padded_size / WORD_BITS;
  for (std::size_t first = 0; first < all; first += BLOCK_WORDS) {
    const std::size_t words = std::min(BLOCK_WORDS, all - first);
    std::uint64_t agreeing[BLOCK_WORDS], scratch[BLOCK_WORDS];
    const int count = (*this)(tested, first, words, agreeing, scratch);
    consumer(first, words, agreeing, count);
  }
}

int
ResidualTest::count(const PoseF& pose) const
{
  int total = 0;
  forEachBlock(pose, [&](std::size_t, std::size_t, const std::uint64_t*, int count) {
    total += count;
  });
  return total;
}

std::vector<int>
ResidualTest::rows(const PoseF& pose) const
{
  std::vector<int> rows;
  forEachBlock(pose,
               [&](std::size_t first,
                   std::size_t words,
                   const std::uint64_t* agreeing,
                   int count) {
                 const std::size_t before = rows.size();
                 rows.resize(before + static_cast<std::size_t>(count));
                 listBits(agreeing, words, rows.data() + before);
                 for (std::size_t i = before; i < rows.size(); ++i)
                   rows[i] += static_cast<int>(WORD_BITS * first);
               });
  return rows;
}

} // namespace cpu
} // namespace pcl_flashreg
