// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/aligned_buffer.h"
#include "math/compatibility.h"
#include "math/pose.h"
#include "math/upright.h"

#include <cstddef>
#include <cstdint>

namespace pcl_flashreg {

/** \brief Correspondences are padded to whole words of the bit matrix. */
constexpr std::size_t WORD_BITS = 64;

/** \brief What the stages work on: finite correspondences, centred, in single precision,
 * as separate coordinate arrays. Rows from size to padded_size hold NaN, which every test
 * turns down by itself. */
struct Problem {
  std::size_t size = 0;
  /** \brief size rounded up to a multiple of WORD_BITS. */
  std::size_t padded_size = 0;
  AlignedBuffer<float> sx, sy, sz, tx, ty, tz;
  /** \brief Largest distance of a point from the centre of its side. */
  float radius = 0;
  /** \brief What poses keep to. */
  Upright upright;
  /** \brief Of upright motions alone: how much higher the target point is than the source
   * point, each above the centre of its side. */
  AlignedBuffer<float> rise;

  /** \brief Once it is known what poses keep to. */
  void
  resize(std::size_t n)
  {
    size = n;
    padded_size = (n + WORD_BITS - 1) / WORD_BITS * WORD_BITS;
    for (AlignedBuffer<float>* coordinate : {&sx, &sy, &sz, &tx, &ty, &tz})
      coordinate->resize(padded_size);
    rise.resize(upright.required ? padded_size : 0);
  }

  PointPair
  pair(std::size_t i) const
  {
    return {sx[i], sy[i], sz[i], tx[i], ty[i], tz[i]};
  }

  /** \brief Whether two correspondences are an edge of the first-order graph. */
  bool
  isEdge(std::size_t i,
         std::size_t j,
         float length_tolerance,
         float min_length_sum) const
  {
    const PointPair a = pair(i), b = pair(j);
    return compatible(a, b, length_tolerance, min_length_sum) &&
           (!upright.required ||
            keepsHeight(
                a, b, rise[i], rise[j], length_tolerance, upright.squared_slope));
  }

  Vec3
  source(std::size_t i) const
  {
    return {sx[i], sy[i], sz[i]};
  }

  Vec3
  target(std::size_t i) const
  {
    return {tx[i], ty[i], tz[i]};
  }
};

/** \brief A pivot: an edge of the second-order graph, u < v. */
struct Edge {
  std::uint32_t u, v;
  std::uint32_t score;
};

/** \brief A 3-clique, u < v < w; its score is the sum of its edges' scores. */
struct Clique {
  std::uint32_t u, v, w;
  std::uint32_t score;
};

/** \brief See PoseEstimate::cliques. */
constexpr unsigned LISTED_CLIQUES = 64;

/** \brief A pose with what speaks for it, in the centred frames. */
struct ScoredPose {
  Pose pose;
  /** \brief In units of SCORE_UNIT. */
  std::int64_t score = 0;
  int inlier_count = 0;
};

} // namespace pcl_flashreg
