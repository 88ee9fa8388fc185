// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The parts of the feature pipeline, each against a slow and obvious form.

#include "scan/cpu/neighbor_grid.h"
#include "math/pair_features.h"
#include "math/symmetric3.h"
#include "support/made_correspondences.h"

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace pcl_flashreg {
namespace cpu {
namespace {

std::vector<float>
scatter(std::size_t count, double side, std::uint64_t seed)
{
  made::Random random(seed);
  std::vector<float> points;
  for (std::size_t i = 0; i < 3 * count; ++i)
    points.push_back(static_cast<float>(random.uniform(-side, side)));
  return points;
}

/** \brief Rows in reach of every row, by comparing all with all. */
std::vector<std::set<std::uint32_t>>
neighborsOracle(const std::vector<float>& points, float squared_radius)
{
  const std::size_t count = points.size() / 3;
  std::vector<std::set<std::uint32_t>> neighbors(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      const float dx = points[3 * j] - points[3 * i];
      const float dy = points[3 * j + 1] - points[3 * i + 1];
      const float dz = points[3 * j + 2] - points[3 * i + 2];
      if ((dx * dx + dy * dy) + dz * dz < squared_radius)
        neighbors[i].insert(static_cast<std::uint32_t>(j));
    }
  return neighbors;
}

class EachVariant : public testing::TestWithParam<std::size_t> {
protected:
  const Kernels&
  kernels() const
  {
    std::size_t count = 0;
    return *availableKernels(count)[GetParam()];
  }

  void
  expectNeighbors(const std::vector<float>& points, double radius) const
  {
    NeighborGrid grid;
    grid.build(points, radius);
    ASSERT_EQ(grid.size(), points.size() / 3);
    std::vector<std::uint32_t> indices(grid.capacity());
    std::vector<float> distances(grid.capacity());
    for (const double reach : {radius, 0.4 * radius}) {
      const auto squared = static_cast<float>(reach * reach);
      const auto expected = neighborsOracle(points, squared);
      for (std::size_t i = 0; i < grid.size(); ++i) {
        const std::size_t count =
            grid.collect(kernels(), i, squared, indices.data(), distances.data());
        std::set<std::uint32_t> rows;
        for (std::size_t n = 0; n < count; ++n) {
          rows.insert(grid.row(indices[n]));
          ASSERT_LT(distances[n], squared);
        }
        ASSERT_EQ(rows.size(), count);
        ASSERT_EQ(rows, expected[grid.row(i)]) << "row " << grid.row(i);
      }
    }
  }
};

std::size_t
variantCount()
{
  std::size_t count = 0;
  availableKernels(count);
  return count;
}

} // namespace

TEST_P(EachVariant, FindsAllNeighborsAndNoOthers)
{
  expectNeighbors(scatter(500, 1, 1), 0.3);
  expectNeighbors(scatter(300, 100, 2), 7);
  expectNeighbors(scatter(200, 0.1, 3), 1);  // all in reach of all
  expectNeighbors(scatter(100, 1, 4), 1e-3); // none
  for (std::size_t count = 1; count < 20; ++count)
    expectNeighbors(scatter(count, 1, 10 + count), 0.8);
}

TEST_P(EachVariant, FindsNeighborsOnALattice)
{
  // Distances that equal the radius, and points on the borders of cells.
  std::vector<float> points;
  for (int x = -4; x < 4; ++x)
    for (int y = -4; y < 4; ++y)
      for (int z = -2; z < 2; ++z)
        for (const int c : {x, y, z})
          points.push_back(0.05f * static_cast<float>(c));
  for (const double radius : {0.05, 0.10, 0.25})
    expectNeighbors(points, radius);
}

TEST_P(EachVariant, FindsNeighborsAmongFarOutliers)
{
  std::vector<float> points = scatter(300, 1, 5);
  for (const float far : {1e6f, -1e9f, 3e11f})
    points.insert(points.end(), {far, 0.5f * far, -far, far, 0, 0});
  expectNeighbors(points, 0.05);
}

TEST_P(EachVariant, LeavesOutRemovedPoints)
{
  const std::vector<float> points = scatter(100, 0.2, 6);
  NeighborGrid grid;
  grid.build(points, 1);
  for (std::size_t i = 0; i < grid.size(); i += 2)
    grid.remove(i);
  std::vector<std::uint32_t> indices(grid.capacity());
  std::vector<float> distances(grid.capacity());
  EXPECT_EQ(grid.collect(kernels(), 1, 1, indices.data(), distances.data()), 50u);
  for (std::size_t n = 0; n < 50; ++n)
    EXPECT_EQ(indices[n] % 2, 1u);
}

TEST_P(EachVariant, CountsEveryPairInItsBins)
{
  // Oriented points at random; pairBins() one by one is the slow form.
  constexpr std::size_t COUNT = 200;
  made::Random random(7);
  std::vector<float> columns[6];
  for (std::size_t i = 0; i < COUNT + NEIGHBOR_BLOCK; ++i) {
    Eigen::Vector3d n(random.normal(), random.normal(), random.normal());
    n.normalize();
    const bool up = i % 7 == 0, down = i % 11 == 0;
    if (up || down)
      n = {0, 0, up ? 1.0 : -1.0}; // parallel, and opposite: ties and half turns
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns[axis].push_back(static_cast<float>(random.uniform(0, 1)));
      columns[3 + axis].push_back(
          static_cast<float>(n[static_cast<Eigen::Index>(axis)]));
    }
    if (i % 14 == 0 || down)
      columns[2].back() = 0.5f;
  }
  columns[0][3] = columns[0][0]; // the same place, and straight above
  columns[1][3] = columns[1][0];
  columns[2][3] = columns[2][0];
  columns[0][4] = columns[0][0];
  columns[1][4] = columns[1][0];
  const SurfaceArrays arrays{columns[0].data(),
                             columns[1].data(),
                             columns[2].data(),
                             columns[3].data(),
                             columns[4].data(),
                             columns[5].data()};
  const auto oriented = [&](std::size_t i) {
    return OrientedPoint{columns[0][i],
                         columns[1][i],
                         columns[2][i],
                         columns[3][i],
                         columns[4][i],
                         columns[5][i]};
  };
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < COUNT; ++i)
    all.push_back(i);
  for (std::uint32_t query = 0; query < COUNT; ++query) {
    std::vector<std::uint32_t> indices = all;
    while (indices.size() % NEIGHBOR_BLOCK != 0)
      indices.push_back(query);
    std::uint32_t counts[FPFH_BINS] = {}, expected[FPFH_BINS] = {};
    kernels().pairHistogram(arrays, query, indices.data(), indices.size(), counts);
    for (std::size_t i = 0; i < COUNT; ++i) {
      PairBins bins;
      if (!pairBins(oriented(query), oriented(i), bins))
        continue;
      ++expected[bins.alpha_turn];
      ++expected[11 + bins.alpha];
      ++expected[22 + bins.phi];
    }
    for (std::size_t bin = 0; bin < FPFH_BINS; ++bin)
      ASSERT_EQ(counts[bin], expected[bin]) << "query " << query << " bin " << bin;
  }
}

INSTANTIATE_TEST_SUITE_P(SurfaceKernels,
                         EachVariant,
                         testing::Range(std::size_t{0}, variantCount()));

TEST(PairBins, AreThoseOfTheAngles)
{
  // Eq. (1) of the FPFH paper, word by word, in double precision.
  made::Random random(8);
  int compared = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Eigen::Vector3d p[2], n[2];
    for (int k = 0; k < 2; ++k) {
      p[k] = random.inCube(1).cast<float>().cast<double>();
      n[k] = Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      n[k] = n[k].normalized().cast<float>().cast<double>();
    }
    Eigen::Vector3d line = (p[1] - p[0]).normalized();
    const bool swap = std::abs(n[0].dot(line)) < std::abs(n[1].dot(line));
    const Eigen::Vector3d u = swap ? n[1] : n[0], other = swap ? n[0] : n[1];
    if (swap)
      line = -line;
    const Eigen::Vector3d v = line.cross(u).normalized(), w = u.cross(v);
    const double values[3] = {(std::atan2(w.dot(other), u.dot(other)) + M_PI) /
                                  (2 * M_PI),
                              (v.dot(other) + 1) / 2,
                              (u.dot(line) + 1) / 2};
    bool borderline =
        std::abs(std::abs(n[0].dot(line)) - std::abs(n[1].dot(line))) < 1e-5;
    for (const double value : values)
      borderline |= std::abs(11 * value - std::round(11 * value)) < 1e-4;
    if (borderline)
      continue;
    const auto oriented = [&](int k) {
      const Eigen::Vector3f point = p[k].cast<float>(), normal = n[k].cast<float>();
      return OrientedPoint{
          point.x(), point.y(), point.z(), normal.x(), normal.y(), normal.z()};
    };
    PairBins bins;
    ASSERT_TRUE(pairBins(oriented(0), oriented(1), bins));
    EXPECT_EQ(bins.alpha_turn, static_cast<int>(11 * values[0]));
    EXPECT_EQ(bins.alpha, static_cast<int>(11 * values[1]));
    EXPECT_EQ(bins.phi, static_cast<int>(11 * values[2]));
    ++compared;
  }
  EXPECT_GT(compared, 19000);
}

TEST(PairBins, NeedALineThatIsNotTheNormal)
{
  PairBins bins;
  const OrientedPoint origin{0, 0, 0, 0, 0, 1};
  EXPECT_FALSE(pairBins(origin, origin, bins));
  EXPECT_FALSE(pairBins(origin, {0, 0, 2, 0, 0, 1}, bins));
  EXPECT_FALSE(pairBins(origin, {NAN, 0, 2, 0, 0, 1}, bins));
  EXPECT_FALSE(pairBins(origin, {1, 0, 2, 0, NAN, 1}, bins));
  EXPECT_TRUE(pairBins(origin, {1, 0, 2, 0, 0, 1}, bins));
}

TEST(Symmetric3, HasTheSmallestEigenpairOfEigen)
{
  made::Random random(9);
  for (int trial = 0; trial < 5000; ++trial) {
    // Spreads from a plane to a ball, over many orders of magnitude.
    Eigen::Matrix3d A;
    for (int i = 0; i < 9; ++i)
      A(i / 3, i % 3) = random.normal();
    const double scale = std::pow(10, random.uniform(-6, 6));
    Eigen::Matrix3d C = A * A.transpose();
    if (trial % 2 == 0) {
      const Eigen::Quaterniond turn =
          Eigen::Quaterniond(
              Eigen::Vector4d(random.normal(), random.normal(), random.normal(), 1))
              .normalized();
      C = turn * Eigen::Vector3d(random.uniform(0, 1e-3), 0.5, 1).asDiagonal() *
          turn.toRotationMatrix().transpose();
    }
    C *= scale;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(C);
    const Eigen::Vector3d values = solver.eigenvalues();
    const Symmetric3 a{C(0, 0), C(0, 1), C(0, 2), C(1, 1), C(1, 2), C(2, 2)};
    const double smallest = smallestEigenvalue(a);
    EXPECT_NEAR(smallest, values[0], 1e-9 * values[2]);
    Vec3 direction;
    ASSERT_TRUE(smallestEigenvector(a, smallest, direction));
    if (values[1] - values[0] < 1e-4 * values[2])
      continue;
    const Eigen::Vector3d found(direction.x, direction.y, direction.z);
    EXPECT_NEAR(found.norm(), 1, 1e-12);
    EXPECT_LT(found.cross(solver.eigenvectors().col(0)).norm(), 1e-6);
  }
}

TEST(Symmetric3, OfALineHasNoDirection)
{
  for (const Eigen::Vector3d& line : {Eigen::Vector3d(1, 0, 0),
                                      Eigen::Vector3d(0, 1, 0),
                                      Eigen::Vector3d(0, 0, 1),
                                      Eigen::Vector3d(1, -2, 3)}) {
    const Eigen::Matrix3d C = line * line.transpose();
    const Symmetric3 a{C(0, 0), C(0, 1), C(0, 2), C(1, 1), C(1, 2), C(2, 2)};
    Vec3 direction;
    EXPECT_FALSE(smallestEigenvector(a, smallestEigenvalue(a), direction));
  }
}

TEST(Symmetric3, OfNothingHasNoDirection)
{
  Vec3 direction;
  EXPECT_FALSE(smallestEigenvector({0, 0, 0, 0, 0, 0}, 0, direction));
  EXPECT_FALSE(smallestEigenvector({NAN, 0, 0, 1, 0, 1}, 0, direction));
  // Spread alike everywhere: any direction, but one.
  EXPECT_TRUE(smallestEigenvector(
      {2, 0, 0, 2, 0, 2}, smallestEigenvalue({2, 0, 0, 2, 0, 2}), direction));
  EXPECT_NEAR(dot(direction, direction), 1, 1e-12);
}

} // namespace cpu
} // namespace pcl_flashreg
