// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// What the core says and writes is the same whatever locale the program has set.

#include "support/foreign_locale.h"
#include "support/made_scans.h"

#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/pair_registration.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>

namespace pcl_flashreg {
namespace {

/** \brief What a call complains of in a program with a foreign locale. */
template <typename Call>
std::string
complaintAbroad(const Call& call)
{
  const test::ForeignLocale abroad;
  try {
    call();
  }
  catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(Locale, TheTestHasAForeignOne)
{
  const test::ForeignLocale abroad;
  std::ostringstream text;
  text << 1234.5 << ' ' << 12345;
  EXPECT_EQ(text.str(), "1.234,5 12.345");
}

TEST(Locale, NumbersAreWrittenTheSame)
{
  const test::ForeignLocale abroad;
  EXPECT_EQ(detail::toText(1234.5), "1234.5");
  EXPECT_EQ(detail::toText(0.05f), "0.05");
  EXPECT_EQ(detail::toText(123456), "123456");
  EXPECT_EQ(detail::toText(1e-9), "1e-09");
}

TEST(Locale, ParametersAreNamedTheSame)
{
  Parameters parameters;
  parameters.inlier_distance = -1234.5f;
  EXPECT_EQ(
      complaintAbroad([&] { parameters.validate(); }),
      "inlier_distance = -1234.5 is out of range: it must be a finite length > 0");
  parameters = {};
  parameters.max_correspondences = 1234567;
  EXPECT_EQ(
      complaintAbroad([&] { parameters.validate(); }),
      "max_correspondences = 1234567 is out of range: it must lie in [3, 200000]");
  EXPECT_EQ(complaintAbroad([] { Parameters::fromResolution(-0.5); }),
            "resolution = -0.5 is out of range: it must be a finite length > 0");
  FeatureParameters features;
  features.voxel_size = -1234.5;
  EXPECT_NE(complaintAbroad([&] { features.validate(); }).find("voxel_size = -1234.5 "),
            std::string::npos);
}

TEST(Locale, InputsAreNamedTheSame)
{
  Estimator estimator(BackendKind::Cpu, 1);
  const double point[3] = {};
  const float normal[3] = {0, 0, 1};
  CloudPairView<double> clouds;
  clouds.source = clouds.target = {point, normal, 1, {}};
  clouds.spacing = -1234.5;
  const CorrespondenceView<double> none, missing{nullptr, nullptr, 12345};
  EXPECT_EQ(
      complaintAbroad([&] { estimator.estimate(none, {}, {}, &clouds); }),
      "clouds: spacing = -1234.5 is out of range: it must be a finite length > 0");
  EXPECT_NE(complaintAbroad([&] { estimator.estimate(missing); }).find("12345"),
            std::string::npos);
}

TEST(Locale, ScansAreTheSame)
{
  const made::RoomScans room;
  PairRegistration registration(BackendKind::Cpu, 1);
  const Scan scan = registration.makeScan(room.sourceInput(), room.RESOLUTION);
  const std::string path = testing::TempDir() + "pcl_flashreg_locale.scan";
  const test::ForeignLocale abroad;
  scan.save(path);
  EXPECT_EQ(Scan::load(path).serialize(), scan.serialize());
  std::remove(path.c_str());
  EXPECT_EQ(registration.makeScan(room.sourceInput(), room.RESOLUTION).serialize(),
            scan.serialize());
}

} // namespace
} // namespace pcl_flashreg
