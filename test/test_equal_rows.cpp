// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "support/made_correspondences.h"

#include <pcl_flashreg/impl/equal_rows.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_flashreg {
namespace {

using detail::EqualRows;

EqualRows
rowsOf(const std::vector<float>& values, std::size_t length)
{
  return {values.size() / length, length, [&](std::size_t i) {
            return values.data() + i * length;
          }};
}

/** \brief Compares all with all. */
void
expectGroups(const std::vector<float>& values, std::size_t length)
{
  const EqualRows rows = rowsOf(values, length);
  const std::size_t count = values.size() / length;
  std::vector<char> met(count, 0);
  std::size_t groups = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (met[i])
      continue;
    ASSERT_LT(groups, rows.firsts().size());
    ASSERT_EQ(rows.firsts()[groups++], i);
    std::uint32_t next = rows.next(static_cast<std::uint32_t>(i));
    for (std::size_t j = i + 1; j < count; ++j)
      if (std::equal(values.begin() + static_cast<std::ptrdiff_t>(i * length),
                     values.begin() + static_cast<std::ptrdiff_t>((i + 1) * length),
                     values.begin() + static_cast<std::ptrdiff_t>(j * length))) {
        ASSERT_EQ(next, j);
        next = rows.next(next);
        met[j] = 1;
      }
    ASSERT_EQ(next, EqualRows::NONE);
  }
  EXPECT_EQ(rows.firsts().size(), groups);
  EXPECT_EQ(rows.allDiffer(), groups == count);
}

TEST(EqualRows, AreThoseWhoseValuesAreEqual)
{
  made::Random random(1);
  for (const std::size_t length : {1, 2, 3, 4, 5, 8, 33})
    for (const double kinds : {1.0, 2.0, 7.0, 1e6}) {
      std::vector<float> values;
      for (int i = 0; i < 300; ++i) {
        // Rows of one kind differ in the last value alone.
        values.insert(values.end(), length - 1, 0.5f);
        values.push_back(static_cast<float>(std::floor(random.uniform(0, kinds))));
      }
      expectGroups(values, length);
    }
}

TEST(EqualRows, EveryPlaceCounts)
{
  for (const std::size_t length : {1, 3, 4, 6, 33, 352}) {
    std::vector<float> values((length + 1) * length, 1);
    for (std::size_t i = 0; i < length; ++i)
      values[i * length + i] = 2;
    EXPECT_TRUE(rowsOf(values, length).allDiffer());
  }
}

TEST(EqualRows, ZeroHasNoSign)
{
  const EqualRows rows = rowsOf({0, 1, -0.0f, 0, 1, 0, -0.0f, 1, -0.0f}, 3);
  EXPECT_EQ(rows.firsts(), std::vector<std::uint32_t>{0});
  EXPECT_EQ(rows.next(0), 1u);
  EXPECT_EQ(rows.next(1), 2u);
}

TEST(EqualRows, MayBeNone)
{
  EXPECT_TRUE(rowsOf({}, 3).firsts().empty());
  EXPECT_TRUE(EqualRows().firsts().empty());
  EXPECT_TRUE(EqualRows().allDiffer());
}

} // namespace
} // namespace pcl_flashreg
