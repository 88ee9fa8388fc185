// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Places of a map that look the same: found from one of them and the correspondences.

#include "estimation/preparation.h"
#include "judgement/standing.h"
#include "judgement/twins.h"
#include "math/isometry.h"
#include "support/made_correspondences.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl_flashreg {
namespace {

constexpr float NEAR = 0.1f;
constexpr std::size_t COPIES = 5;

/** \brief Correspondences of a source that lies in five places of the target, turned in the
 * same way, one pair a place in turn; every second pair is of chance. */
class TwinsTest : public ::testing::Test {
protected:
  void
  SetUp() override
  {
    made::Random random(3);
    std::vector<double> source, target;
    for (int i = 0; i < 600; ++i) {
      const Eigen::Vector3d point = random.inCube(3);
      const Eigen::Vector3d match =
          i % 2 == 0 ? copy(static_cast<std::size_t>(i / 2) % COPIES) * point +
                           random.inCube(0.03)
                     : random.inCube(30);
      source.insert(source.end(), point.data(), point.data() + 3);
      target.insert(target.end(), match.data(), match.data() + 3);
    }
    const CorrespondenceView<double> view{source.data(), target.data(), 600, nullptr};
    prepare(view, Parameters(), std::nullopt, preparation_, problem_);
  }

  static Eigen::Isometry3d
  copy(std::size_t i)
  {
    Eigen::Isometry3d T(Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 5).normalized()));
    T.pretranslate(Eigen::Vector3d(4.0 * static_cast<double>(i), 1, -2));
    return T;
  }

  /** \brief In the frames of the problem. */
  Pose
  centred(const Eigen::Isometry3d& T) const
  {
    const auto eigen = [](const Vec3& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
    return toPose(Eigen::Translation3d(-eigen(preparation_.target_centre)) * T *
                  Eigen::Translation3d(eigen(preparation_.source_centre)));
  }

  bool
  isAmong(const std::vector<Pose>& poses, const Eigen::Isometry3d& T) const
  {
    const Eigen::Isometry3d wanted = toIsometry(centred(T));
    return std::any_of(poses.begin(), poses.end(), [&](const Pose& pose) {
      return (toIsometry(pose).matrix() - wanted.matrix()).norm() < NEAR;
    });
  }

  Preparation preparation_;
  Problem problem_;
};

TEST_F(TwinsTest, allPlacesAreFoundFromOne)
{
  const std::vector<Pose> twins = twinsOf(problem_, {centred(copy(2))}, NEAR, 8);
  EXPECT_LE(twins.size(), 8u);
  for (std::size_t i = 0; i < COPIES; ++i) {
    EXPECT_TRUE(isAmong(twins, copy(i))) << i;
    // Those that most agree in come first.
    EXPECT_TRUE(isAmong({twins.begin(), twins.begin() + COPIES}, copy(i))) << i;
  }
}

TEST_F(TwinsTest, turnsThatAreAlikeCountOnce)
{
  Eigen::Isometry3d other = copy(1);
  other.rotate(Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitX()));
  const std::vector<Pose> known{centred(copy(0)), centred(copy(1)), centred(other)};
  EXPECT_EQ(twinsOf(problem_, known, NEAR, 4).size(), 4u);
  other.rotate(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitX()));
  EXPECT_EQ(twinsOf(problem_, {known[0], centred(other)}, NEAR, 4).size(), 8u);
  EXPECT_TRUE(twinsOf(problem_, {}, NEAR, 4).empty());
  EXPECT_TRUE(twinsOf(problem_, known, NEAR, 0).empty());
}

TEST(StandingInMap, copiesAreAsLoudWhateverTheirCorrespondences)
{
  EXPECT_EQ(loudnessInMap(0, 0), 1);
  EXPECT_EQ(loudnessInMap(2, 0.4), 1);
  EXPECT_EQ(loudnessInMap(0, 3), 1);
  EXPECT_LT(loudnessInMap(2, 1), 0.05);
  const Standing best{{0.9, 0.01, 0}, 100}, other{{0.8, 0.05, 0}, 10};
  EXPECT_GT(leadByClouds(best, other), 0);
  EXPECT_GT(weightOf(best) - weightOf(other), leadByClouds(best, other));
  EXPECT_EQ(leadOf(best, nullptr), 5);
  EXPECT_EQ(leadOf(best, &other), weightOf(best) - weightOf(other));
}

} // namespace
} // namespace pcl_flashreg
