// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/feature_matching.h>
#include <pcl_flashreg/impl/equal_rows.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_flashreg {

/** \brief The descriptors of a set that are finite, and of equal ones the first. */
struct DistinctFeatures {
  FeatureView view;
  /** \brief The finite rows of the view, ascending. */
  std::vector<std::int32_t> finite;
  /** \brief Which of these equal each other. */
  detail::EqualRows equal;
  /** \brief Rows of the view that differ from each other, ascending. */
  std::vector<std::int32_t> rows;
  /** \brief The largest absolute value in them. */
  float largest = 0;

  explicit DistinctFeatures(const FeatureView& features);

  /** \brief One that was made before, of the same descriptors. */
  DistinctFeatures(const FeatureView& features,
                   std::vector<std::int32_t> finite_rows,
                   detail::EqualRows equal_rows,
                   float largest_value);

  std::size_t
  size() const
  {
    return rows.size();
  }

  const float*
  operator[](std::size_t i) const
  {
    return of(rows[i]);
  }

private:
  void
  findRows();

  const float*
  of(std::int32_t row) const
  {
    return view.data + static_cast<std::size_t>(row) * view.stride;
  }
};

} // namespace pcl_flashreg
