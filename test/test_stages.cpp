// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stages 1 to 4 against the slow reference, for equality.

#include "estimation/preparation.h"
#include "support/problems.h"
#include "support/reference.h"
#include "estimation/trace.h"

#include <pcl_flashreg/estimator.h>

#include <gtest/gtest.h>

namespace pcl_flashreg {
namespace {

class StagesAgainstReference
    : public testing::TestWithParam<std::tuple<std::size_t, SecondOrder>> {
protected:
  void
  SetUp() override
  {
    problem_ = made::problems()[std::get<0>(GetParam())];
    problem_.parameters.second_order = std::get<1>(GetParam());
    Estimator estimator(BackendKind::Cpu, 2);
    estimator.setTrace(&trace_);
    result_ = estimator.estimate(problem_.correspondences.view(), problem_.parameters);

    // The centred coordinates are the library's; everything after them is not.
    Problem packed;
    prepare(problem_.correspondences.view(), problem_.parameters, packed);
    for (std::size_t i = 0; i < packed.size; ++i) {
      source_.insert(source_.end(), {packed.sx[i], packed.sy[i], packed.sz[i]});
      target_.insert(target_.end(), {packed.tx[i], packed.ty[i], packed.tz[i]});
    }
    rise_.assign(packed.rise.begin(),
                 packed.rise.begin() + (packed.upright.required ? packed.size : 0));
  }

  made::NamedProblem problem_;
  Trace trace_;
  Result result_;
  std::vector<float> source_, target_;
  /** \brief Of upright motions alone. */
  std::vector<float> rise_;
};

TEST_P(StagesAgainstReference, AreEqual)
{
  const Parameters& p = problem_.parameters;
  const bool exact = p.second_order == SecondOrder::Exact;
  if (source_.size() / 3 < 3) {
    EXPECT_EQ(result_.status, Status::TooFewCorrespondences);
    return;
  }
  auto graph = reference::firstOrderGraph(
      source_, target_, p.length_tolerance, p.min_length_sum);
  if (p.motion == MotionModel::Upright)
    reference::keepHeights(source_, rise_, p.length_tolerance, p.max_tilt, graph);
  ASSERT_EQ(trace_.size, graph.n);
  for (std::size_t i = 0; i < graph.n; ++i)
    for (std::size_t j = 0; j < graph.n; ++j)
      ASSERT_EQ(trace_.hasEdge(i, j), graph.at(i, j) != 0) << i << ", " << j;

  const auto scores = exact ? reference::exactScores(graph)
                            : reference::boundedScores(graph, p.row_capacity);
  reference::Matrix<int> found(graph.n);
  for (const Edge& edge : trace_.second_order_graph) {
    ASSERT_LT(edge.u, edge.v);
    found.at(edge.u, edge.v) = static_cast<int>(edge.score);
  }
  for (std::size_t i = 0; i < graph.n; ++i)
    for (std::size_t j = i + 1; j < graph.n; ++j)
      ASSERT_EQ(found.at(i, j), scores.at(i, j)) << i << ", " << j;

  const auto pivots = exact ? reference::pivots(scores, p.pivots)
                            : reference::pivots(scores, p.pivots, p.pool_capacity);
  ASSERT_EQ(trace_.pivots.size(), pivots.size());
  for (std::size_t i = 0; i < pivots.size(); ++i) {
    ASSERT_EQ(trace_.pivots[i].u, pivots[i].u) << i;
    ASSERT_EQ(trace_.pivots[i].v, pivots[i].v) << i;
    ASSERT_EQ(trace_.pivots[i].score, static_cast<std::uint32_t>(pivots[i].score)) << i;
  }

  const auto cliques = reference::cliques(scores, pivots, p.cliques_per_pivot);
  ASSERT_EQ(trace_.cliques.size(), cliques.size());
  for (std::size_t i = 0; i < cliques.size(); ++i) {
    ASSERT_EQ(trace_.cliques[i].u, cliques[i].u) << i;
    ASSERT_EQ(trace_.cliques[i].v, cliques[i].v) << i;
    ASSERT_EQ(trace_.cliques[i].w, cliques[i].w) << i;
    ASSERT_EQ(trace_.cliques[i].score, static_cast<std::uint32_t>(cliques[i].score))
        << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Problems,
    StagesAgainstReference,
    testing::Combine(testing::Range(std::size_t{0}, made::problems().size()),
                     testing::Values(SecondOrder::Exact, SecondOrder::Bounded)),
    [](const auto& test) {
      std::string name = made::problems()[std::get<0>(test.param)].name;
      std::replace(name.begin(), name.end(), '.', '_');
      return name +
             (std::get<1>(test.param) == SecondOrder::Exact ? "_exact" : "_bounded");
    });

} // namespace
} // namespace pcl_flashreg
