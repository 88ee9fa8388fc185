// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <gtest/gtest.h>

namespace pcl_flashreg {

/** \brief To the last bit, but for the times. */
inline void
expectSameResult(const Result& expected, const Result& found)
{
  const auto matrixOf = [](const RigidTransform& T) { return T.toMatrix<double>(); };
  EXPECT_EQ(found.status, expected.status);
  EXPECT_EQ(matrixOf(found.T_target_source), matrixOf(expected.T_target_source));
  EXPECT_EQ(found.converged, expected.converged);
  EXPECT_EQ(found.confidence, expected.confidence);
  EXPECT_EQ(found.inliers, expected.inliers);
  EXPECT_EQ(found.score, expected.score);
  EXPECT_EQ(found.distinctness, expected.distinctness);
  EXPECT_EQ(found.information, expected.information);
  EXPECT_EQ(found.evidence.log_chance, expected.evidence.log_chance);
  EXPECT_EQ(found.evidence.mirrored, expected.evidence.mirrored);
  EXPECT_EQ(found.correspondences_used, expected.correspondences_used);
  EXPECT_EQ(found.correspondences_dropped, expected.correspondences_dropped);
  EXPECT_EQ(found.correspondences_invalid, expected.correspondences_invalid);
  EXPECT_EQ(found.backend, expected.backend);
  EXPECT_EQ(found.second_order, expected.second_order);
  ASSERT_EQ(found.hypotheses.size(), expected.hypotheses.size());
  for (std::size_t i = 0; i < found.hypotheses.size(); ++i)
    EXPECT_EQ(matrixOf(found.hypotheses[i].T_target_source),
              matrixOf(expected.hypotheses[i].T_target_source));
}

} // namespace pcl_flashreg
