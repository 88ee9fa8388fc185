// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/parameters.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

namespace pcl_flashreg {
namespace {

constexpr float NAN_F = std::numeric_limits<float>::quiet_NaN();
constexpr float INF_F = std::numeric_limits<float>::infinity();

TEST(Parameters, DefaultsAreValid)
{
  EXPECT_NO_THROW(Parameters{}.validate());
}

TEST(Parameters, ResolutionGivesThePresetsOfThePaper)
{
  const Parameters indoor = Parameters::fromResolution(0.05);
  EXPECT_FLOAT_EQ(indoor.length_tolerance, 0.012f);
  EXPECT_FLOAT_EQ(indoor.min_length_sum, 0.15f);
  EXPECT_FLOAT_EQ(indoor.inlier_distance, 0.1f);
  const Parameters outdoor = Parameters::fromResolution(0.3);
  EXPECT_FLOAT_EQ(outdoor.length_tolerance, 0.072f);
  EXPECT_FLOAT_EQ(outdoor.inlier_distance, 0.6f);
}

TEST(Parameters, RefusesResolutionsThatMakeNoLength)
{
  for (const double resolution :
       {0.0, -0.05, 1e-60, 1e60, double{NAN_F}, double{INF_F}})
    EXPECT_THROW(Parameters::fromResolution(resolution), std::invalid_argument)
        << resolution;
}

struct BadField {
  const char* name;
  std::function<void(Parameters&)> spoil;
};

class BadFields : public testing::TestWithParam<BadField> {};

TEST_P(BadFields, AreNamedWithTheirValue)
{
  Parameters parameters;
  GetParam().spoil(parameters);
  try {
    parameters.validate();
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).rfind(GetParam().name, 0), 0u) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Fields,
    BadFields,
    testing::Values(
        BadField{"length_tolerance", [](Parameters& p) { p.length_tolerance = 0; }},
        BadField{"length_tolerance", [](Parameters& p) { p.length_tolerance = NAN_F; }},
        BadField{"min_length_sum", [](Parameters& p) { p.min_length_sum = -1; }},
        BadField{"inlier_distance", [](Parameters& p) { p.inlier_distance = INF_F; }},
        BadField{"max_correspondences",
                 [](Parameters& p) { p.max_correspondences = 2; }},
        BadField{"max_correspondences",
                 [](Parameters& p) { p.max_correspondences = 1 << 30; }},
        BadField{"pivots", [](Parameters& p) { p.pivots = 0; }},
        BadField{"cliques_per_pivot", [](Parameters& p) { p.cliques_per_pivot = 17; }},
        BadField{"row_capacity", [](Parameters& p) { p.row_capacity = 0; }},
        BadField{"pool_capacity", [](Parameters& p) { p.pool_capacity = 129; }},
        BadField{"motion",
                 [](Parameters& p) { p.motion = static_cast<MotionModel>(2); }},
        BadField{"max_tilt", [](Parameters& p) { p.max_tilt = 0; }},
        BadField{"max_tilt", [](Parameters& p) { p.max_tilt = 30.5f; }},
        BadField{"max_tilt", [](Parameters& p) { p.max_tilt = NAN_F; }},
        BadField{"source_gravity",
                 [](Parameters& p) {
                   p.source_gravity = {0, 0, 0};
                 }},
        BadField{"source_gravity", [](Parameters& p) { p.source_gravity[1] = INF_F; }},
        BadField{"target_gravity",
                 [](Parameters& p) {
                   p.target_gravity = {0, 0, 0};
                 }},
        BadField{"target_gravity", [](Parameters& p) { p.target_gravity[2] = NAN_F; }},
        BadField{"refinement_iterations",
                 [](Parameters& p) { p.refinement_iterations = -1; }},
        BadField{"max_hypotheses", [](Parameters& p) { p.max_hypotheses = 0; }},
        BadField{"min_confidence", [](Parameters& p) { p.min_confidence = 1.5f; }},
        BadField{"second_order",
                 [](Parameters& p) { p.second_order = static_cast<SecondOrder>(7); }}),
    [](const auto& test) { return test.param.name + std::to_string(test.index); });

} // namespace
} // namespace pcl_flashreg
