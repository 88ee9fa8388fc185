// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// What a registration of real scans has to keep to whatever the true pose is. Bounds are of
// other pairs than these.

#include "io/cloud_io.h"
#include "io/file.h"
#include "io/text.h"
#include "support/datasets.h"
#include "support/relations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace pcl_flashreg {
namespace {

using relations::Changed;
using relations::Cloud;
using relations::Pair;
using relations::Pose;

/** \brief Which pairs of the list: of each data set every so manieth, from one on. */
struct Choice {
  double resolution;
  std::size_t every, first;
};

const std::map<std::string, Choice>&
choices()
{
  static const std::map<std::string, Choice> all = {
      {"3DMatch", {0.05, 120, 77}},
      {"3DLoMatch", {0.05, 120, 77}},
      {"NCLT", {0.3, 14, 5}},
      {"Hilti14_basement", {0.1, 9, 5}},
      {"Indoor16line_rotating", {0.1, 8, 5}},
      {"UR5_D435_tabletop", {0.006, 8, 5}},
      {"BALM", {0.25, 8, 5}},
      {"stanford_bunny", {0.0025, 8, 5}},
      {"ICL_NUIM", {0.025, 7, 5}},
      {"KITTI_raw", {0.3, 3, 1}}};
  return all;
}

Cloud
load(const std::string& path)
{
  const io::Cloud file = io::readCloud(datasets::folder() + "/" + path);
  Cloud cloud;
  const Eigen::Matrix3Xd xyz = io::coordinates(file);
  for (const auto& point : xyz.colwise())
    if (point.allFinite())
      cloud.xyz.insert(cloud.xyz.end(), {point.x(), point.y(), point.z()});
  cloud.viewpoint = Eigen::Vector3d(file.viewpoint.data());
  return cloud;
}

struct NamedPair {
  std::string name;
  Pair pair;
};

std::vector<NamedPair>
choosePairs()
{
  const std::string list = io::readFile(datasets::folder() + "/pairs.tsv");
  std::vector<NamedPair> pairs;
  std::map<std::string, std::size_t> rows;
  io::LineReader lines(list);
  for (std::string_view line; lines.next(line);) {
    const std::vector<std::string_view> words = io::splitWords(line);
    const auto choice =
        words.empty() ? choices().end() : choices().find(std::string(words[0]));
    if (choice == choices().end() ||
        rows[choice->first]++ % choice->second.every != choice->second.first)
      continue;
    const std::string source(words[2]), target(words[3]);
    pairs.push_back({source + " and " + target,
                     {load(source), load(target), choice->second.resolution}});
  }
  return pairs;
}

/** \brief All pairs, and what is found of them as they are: once for all tests. */
class Relations : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    if (!datasets::exists("pairs.tsv"))
      return;
    pairs_ = choosePairs();
    registration_ = std::make_unique<PairRegistration>(BackendKind::Cpu);
    for (const NamedPair& named : pairs_) {
      as_they_are_.push_back(align(named.pair, true));
      estimated_.push_back(align(named.pair, false));
    }
  }

  static void
  TearDownTestSuite()
  {
    pairs_.clear();
    as_they_are_.clear();
    estimated_.clear();
    registration_.reset();
  }

  void
  SetUp() override
  {
    PCL_FLASHREG_NEEDS_DATA("pairs.tsv");
    ASSERT_GT(pairs_.size(), 30u);
  }

  /** \brief What two registrations are compared by. */
  struct Found {
    Pose pose;
    double confidence = 0, resolution = 0;
    bool trusted = false;
    std::size_t inliers = 0;
  };

  static Found
  align(const Pair& pair, bool with_resolution)
  {
    PairOptions options;
    if (with_resolution)
      options.resolution = pair.resolution;
    const PairResult result =
        registration_->align(pair.source.input(), pair.target.input(), options);
    return {result.pose.T_target_source.toIsometry(),
            result.pose.confidence,
            result.resolution,
            result.pose.converged,
            result.pose.inliers.size()};
  }

  using Change = std::function<Changed(const Pair&, made::Random&)>;

  /** \brief Calls compare(number of the pair, as it is, changed, its pose changed back). */
  template <typename Compare>
  static void
  forEachPair(const Change& change, bool with_resolution, const Compare& compare)
  {
    const auto& before = with_resolution ? as_they_are_ : estimated_;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      SCOPED_TRACE(pairs_[i].name);
      made::Random random(i);
      const Changed changed = change(pairs_[i].pair, random);
      Found found = align(changed.pair, with_resolution);
      found.pose = changed.back(found.pose);
      compare(i, before[i], found);
    }
  }

  /** \brief The change changes no bit. */
  static void
  expectExact(const Change& change, bool with_resolution = true)
  {
    forEachPair(change, with_resolution, [](std::size_t, const auto& a, const auto& b) {
      EXPECT_EQ(a.pose.matrix(), b.pose.matrix());
      EXPECT_EQ(a.confidence, b.confidence);
      EXPECT_EQ(a.inliers, b.inliers);
    });
  }

  /** \brief Voxels change, and with them keypoints and correspondences: verdicts agree of
   * nearly all pairs, and poses that are trusted are the same.
   * \param[in] median of how far trusted poses are apart, in voxels, at most
   * \param[in] agreement share of the verdicts that are equal, at least */
  static void
  expectClose(const Change& change, double median, double agreement)
  {
    std::size_t equal = 0;
    std::vector<double> apart;
    forEachPair(change, true, [&](std::size_t i, const auto& a, const auto& b) {
      equal += a.trusted == b.trusted;
      if (!a.trusted || !b.trusted)
        return;
      const Pair& pair = pairs_[i].pair;
      apart.push_back(relations::displacement(pair.source, a.pose, b.pose) /
                      pair.resolution);
      EXPECT_LT(apart.back(), 3) << "trusted both, and not the same";
    });
    EXPECT_GE(static_cast<double>(equal),
              agreement * static_cast<double>(pairs_.size()));
    ASSERT_GT(apart.size(), pairs_.size() / 2);
    std::sort(apart.begin(), apart.end());
    EXPECT_LT(apart[apart.size() / 2], median);
  }

  static std::vector<NamedPair> pairs_;
  static std::vector<Found> as_they_are_, estimated_;
  static std::unique_ptr<PairRegistration> registration_;
};

std::vector<NamedPair> Relations::pairs_;
std::vector<Relations::Found> Relations::as_they_are_, Relations::estimated_;
std::unique_ptr<PairRegistration> Relations::registration_;

TEST_F(Relations, OrderOfThePointsChangesNothing)
{
  expectExact(relations::permuted);
  expectExact(relations::permuted, false);
}

TEST_F(Relations, PointsThatAreThereTwiceChangeNothing)
{
  expectExact(relations::doubled);
}

TEST_F(Relations, UnitsThatAreAPowerOfTwoChangeNothing)
{
  expectExact([](const Pair& pair, auto&) { return relations::scaled(pair, 128); });
}

TEST_F(Relations, StrayPointsFarAwayChangeNothing)
{
  for (const double far : {3.0, 1e6})
    expectExact([far](const Pair& pair, auto& random) {
      return relations::cluttered(pair, far, random);
    });
}

TEST_F(Relations, MillimetresAreMetres)
{
  expectClose(
      [](const Pair& pair, auto&) { return relations::scaled(pair, 1000); }, 0.1, 0.95);
}

TEST_F(Relations, PoseFollowsMotionsOfBoth)
{
  expectClose(relations::turned, 0.5, 0.85);
  expectClose(relations::turnedOnGrid, 0.5, 0.85);
}

TEST_F(Relations, PoseOfTheSwappedPairIsTheInverse)
{
  expectClose(relations::swapped, 0.5, 0.85);
}

/** \brief An estimate is rounded to one of ten numbers a decade: the next one at most. */
TEST_F(Relations, ResolutionFollowsUnitsAndHoldsUnderMotionsAndStrayPoints)
{
  const auto resolution = [](const Pair& pair) {
    return registration_->chooseResolution(pair.source.input(), pair.target.input());
  };
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    SCOPED_TRACE(pairs_[i].name);
    const Pair& pair = pairs_[i].pair;
    const double before = resolution(pair);
    EXPECT_EQ(before, estimated_[i].resolution);
    EXPECT_NEAR(
        resolution(relations::scaled(pair, 1000).pair), 1000 * before, 1e-6 * before);
    made::Random random(i);
    for (const Changed& changed :
         {relations::turned(pair, random), relations::cluttered(pair, 3, random)})
      EXPECT_LT(std::abs(std::log(resolution(changed.pair) / before)), std::log(1.3));
  }
}

} // namespace
} // namespace pcl_flashreg
