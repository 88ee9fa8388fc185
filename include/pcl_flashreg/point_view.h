// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_flashreg {

/** \brief Points as rows of numbers that begin with x, y, z; nothing is copied or owned.
 * \tparam Scalar float or double
 */
template <typename Scalar>
struct BasicPointView {
  /** \brief First coordinate of the first point. */
  const Scalar* data = nullptr;
  /** \brief Number of points. */
  std::size_t size = 0;
  /** \brief Numbers from one point to the next, >= 3. */
  std::size_t stride = 3;
  /** \brief Which of the points to use; null for all of them. */
  const std::int32_t* indices = nullptr;
  /** \brief Number of indices. */
  std::size_t index_count = 0;
};

using PointView = BasicPointView<float>;

} // namespace pcl_flashreg
