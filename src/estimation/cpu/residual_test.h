// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/problem.h"
#include "math/residual.h"
#include "simd/kernels.h"

#include <cstdint>
#include <vector>

namespace pcl_flashreg {
namespace cpu {

/** \brief Which correspondences of a problem agree with a pose: those whose squaredResidual()
 * is below the square of the inlier distance. A contracted evaluation decides what is certain
 * and the exact formula the rest, so that the answer does not depend on the instruction
 * set. */
class ResidualTest {
public:
  /** \brief Words of 64 correspondences in a block: 24 KiB of coordinates, which stay in the
   * first-level cache. */
  static constexpr std::size_t BLOCK_WORDS = 16;

  /** \brief A pose as the test reads it; a reflection is one, too. */
  struct Tested {
    PoseF pose;
    ResidualInput input;
  };

  /** \param[in] problem has to outlive this, and what is made of it */
  ResidualTest(const Kernels& kernels, const Problem& problem, float inlier_distance);

  Tested
  of(const PoseF& pose) const;

  /** \brief Those from 64 * first_word on, as a bit set.
   * \param[out] agreeing, scratch `words` words each
   * \return how many they are */
  int
  operator()(const Tested& tested,
             std::size_t first_word,
             std::size_t words,
             std::uint64_t* agreeing,
             std::uint64_t* scratch) const;

  /** \brief How many of all they are. */
  int
  count(const PoseF& pose) const;

  /** \brief Which of all they are, ascending. */
  std::vector<int>
  rows(const PoseF& pose) const;

private:
  template <typename Consumer>
  void
  forEachBlock(const PoseF& pose, const Consumer& consumer) const;

  const Kernels& kernels_;
  const Problem& problem_;
  float inlier_distance_;
};

} // namespace cpu
} // namespace pcl_flashreg
