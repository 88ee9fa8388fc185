// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What a backend makes of a problem, stage by stage, and the comparison of two of them.

#include "estimation/backend.h"
#include "estimation/preparation.h"
#include "support/problems.h"
#include "estimation/trace.h"

#include <gtest/gtest.h>

#include <cstring>

namespace pcl_flashreg {

struct Recording {
  PoseEstimate estimate;
  Trace trace;
  StageTimings timings;
};

/** \brief For a CPU backend that is compared with. */
inline ThreadPool&
oneThread()
{
  static ThreadPool pool(1);
  return pool;
}

inline Recording
record(Backend& backend,
       const Problem& problem,
       const Parameters& parameters,
       const std::optional<Pose>& guess = std::nullopt)
{
  Recording recording;
  StageClock clock(recording.timings);
  recording.estimate =
      backend.run(problem, parameters, guess, true, clock, &recording.trace);
  return recording;
}

/** \brief The problem as the stages get it. */
inline void
pack(const made::NamedProblem& named, Problem& problem)
{
  prepare(named.correspondences.view(), named.parameters, problem);
}

template <typename Value>
bool
sameBytes(const std::vector<Value>& a, const std::vector<Value>& b)
{
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

inline bool
samePose(const Pose& a, const Pose& b)
{
  return std::memcmp(&a, &b, sizeof(Pose)) == 0;
}

/** \brief Every stage for equality, to the last bit. */
inline void
expectSame(const Recording& expected, const Recording& found)
{
  const Trace &a = expected.trace, &b = found.trace;
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.words_per_row, b.words_per_row);
  EXPECT_TRUE(sameBytes(a.first_order_graph, b.first_order_graph));
  EXPECT_TRUE(sameBytes(a.second_order_graph, b.second_order_graph));
  EXPECT_TRUE(sameBytes(a.pools, b.pools));
  EXPECT_TRUE(sameBytes(a.pivots, b.pivots));
  EXPECT_TRUE(sameBytes(a.cliques, b.cliques));
  EXPECT_EQ(a.hypothesis_valid, b.hypothesis_valid);
  EXPECT_EQ(a.scores, b.scores);
  ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
  for (std::size_t i = 0; i < a.hypotheses.size(); ++i) {
    ASSERT_TRUE(!a.hypothesis_valid[i] || samePose(a.hypotheses[i], b.hypotheses[i]))
        << i;
  }

  EXPECT_EQ(expected.estimate.status, found.estimate.status);
  EXPECT_TRUE(sameBytes(expected.estimate.cliques, found.estimate.cliques));
  EXPECT_EQ(expected.estimate.second_order, found.estimate.second_order);
  EXPECT_EQ(expected.estimate.inliers, found.estimate.inliers);
  ASSERT_EQ(expected.estimate.candidates.size(), found.estimate.candidates.size());
  for (std::size_t i = 0; i < found.estimate.candidates.size(); ++i) {
    ASSERT_TRUE(samePose(expected.estimate.candidates[i], found.estimate.candidates[i]))
        << i;
  }
  const auto &p = expected.estimate.hypotheses, &q = found.estimate.hypotheses;
  ASSERT_EQ(p.size(), q.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_EQ(p[i].score, q[i].score) << i;
    EXPECT_EQ(p[i].inlier_count, q[i].inlier_count) << i;
    EXPECT_TRUE(samePose(p[i].pose, q[i].pose)) << i;
  }
}

} // namespace pcl_flashreg
