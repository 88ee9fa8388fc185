// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "io/correspondence_io.h"
#include "io/error.h"
#include "io/transform_io.h"
#include "support/foreign_locale.h"
#include "support/made_correspondences.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_flashreg::io {
namespace {

template <typename Function>
std::string
complaintOf(Function function)
{
  try {
    function();
  }
  catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(NumberTable, readsCommentsCommasAndBlankLines)
{
  const NumberTable table =
      parseNumberTable("# head\n\n 1 2.5e1,-3 # tail\r\n\t+4, 5 nan\n");
  ASSERT_EQ(table.columns, 3u);
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.row(0)[1], 25);
  EXPECT_EQ(table.row(1)[0], 4);
  EXPECT_TRUE(std::isnan(table.row(1)[2]));
  EXPECT_EQ(table.lines, (std::vector<std::size_t>{3, 4}));
}

TEST(NumberTable, numbersOfAnySize)
{
  const NumberTable table =
      parseNumberTable("1e999 -1e999 1e-999 0.1 123456789.123456789");
  EXPECT_TRUE(std::isinf(table.row(0)[0]));
  EXPECT_EQ(table.row(0)[1], -table.row(0)[0]);
  EXPECT_EQ(table.row(0)[2], 0);
  EXPECT_EQ(table.row(0)[3], 0.1);
  EXPECT_EQ(table.row(0)[4], 123456789.123456789);
}

TEST(NumberTable, saysWhereARowIsWrong)
{
  const auto complaint = [](const std::string& text) {
    return complaintOf([&] { parseNumberTable(text); });
  };
  EXPECT_EQ(complaint("1 2 3\n# x\n1 two 3\n"), "line 3: 'two' is not a number");
  EXPECT_EQ(complaint("1 2 3\n4 5\n"),
            "line 2: expected 3 numbers, as in the first row, found 2");
  EXPECT_EQ(complaint("1 2 3x\n"), "line 1: '3x' is not a number");
  EXPECT_EQ(complaint("# nothing\n\n"), "holds no rows of numbers");
  EXPECT_EQ(complaint(""), "holds no rows of numbers");
}

TEST(NumberTable, refusesDecimalCommas)
{
  const auto complaint = [](const std::string& text) {
    return complaintOf([&] { parseNumberTable(text); });
  };
  for (const char* row : {"1,5 2,5 3,5",
                          "1,5\t2,5\t3,5 # three numbers, read as six columns",
                          "1,5;2,5;3,5",
                          "1,5; 2,5; 3,5",
                          "1,5, 2,5, 3,5",
                          "0 0 -1,25e-3 4",
                          "1 0 0 4,5"})
    EXPECT_NE(complaint(std::string("0 0 0\n") + row)
                  .find("' has a decimal comma: write decimal points"),
              std::string::npos)
        << row << ": " << complaint(row);
  EXPECT_EQ(complaint("1 2 3\n1,5 2 3\n").substr(0, 13), "line 2: '1,5'");
}

TEST(NumberTable, commasThatSeparateMayStandAnyhow)
{
  for (const char* row : {"1,2,3,4,5,6",
                          "1, 2, 3, 4, 5, 6",
                          "1 ,2 ,3 , 4,  5\t,6",
                          "1,2,3 4,5,6",
                          "1.0,2.0 3.0,4.0 5.0,6.0",
                          "1,2,3,4,5,6,",
                          " 1,2,3,4,5,6 # 1,5 2,5"}) {
    const NumberTable table = parseNumberTable(row);
    ASSERT_EQ(table.columns, 6u) << row;
    EXPECT_EQ(table.row(0)[5], 6) << row;
  }
  EXPECT_EQ(parseNumberTable("7,12\n3,8\n").columns, 2u) << "index pairs";
}

TEST(Correspondences, ofSixColumns)
{
  const NumberTable table = parseNumberTable("1 2 3 4 5 6\n7 8 9 10 11 12\n");
  ASSERT_EQ(formOf(table), CorrespondenceForm::Coordinates);
  const Correspondences c = fromCoordinates(table);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_EQ(c.source.col(1), Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(c.target.col(0), Eigen::Vector3d(4, 5, 6));
}

TEST(Correspondences, ofIndexPairs)
{
  Eigen::Matrix3Xd source(3, 2), target(3, 3);
  source << 0, 1, 0, 1, 0, 1;
  target << 5, 6, 7, 5, 6, 7, 5, 6, 7;
  const NumberTable table = parseNumberTable("1 2\n0 0\n");
  ASSERT_EQ(formOf(table), CorrespondenceForm::Indices);
  const Correspondences c = fromIndices(table, source, target);
  EXPECT_EQ(c.source.col(0), Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(c.target.col(0), Eigen::Vector3d(7, 7, 7));
  const auto complaint = [&](const std::string& text) {
    return complaintOf([&] { fromIndices(parseNumberTable(text), source, target); });
  };
  EXPECT_EQ(complaint("0 0\n2 0\n"),
            "line 2: 2 is no index of a source point (0 to 1)");
  EXPECT_EQ(complaint("0 3\n"), "line 1: 3 is no index of a target point (0 to 2)");
  EXPECT_NE(complaint("-1 0\n"), "");
  EXPECT_NE(complaint("0.5 0\n"), "");
  EXPECT_NE(complaint("nan 0\n"), "");
  EXPECT_NE(complaint("1e300 0\n"), "");
}

TEST(Correspondences, areTheSameInEveryLocale)
{
  RigidTransform T;
  T.translation << 1234.5, -0.25, 1e-7;
  const std::string text = formatTransform(T);
  const test::ForeignLocale abroad;
  EXPECT_EQ(formatTransform(T), text);
  EXPECT_EQ(parseTransform(text).translation, T.translation);
  const NumberTable table = parseNumberTable("1234.5 2\n12345 0\n");
  EXPECT_EQ(table.row(0)[0], 1234.5);
  EXPECT_EQ(table.row(1)[0], 12345);
  const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 2);
  const auto complaint = [&](const std::string& pairs) {
    return complaintOf([&] { fromIndices(parseNumberTable(pairs), points, points); });
  };
  EXPECT_EQ(complaint("1234.5 0\n"),
            "line 1: 1234.5 is no index of a source point (0 to 1)");
  EXPECT_EQ(complaint("0 12345\n"),
            "line 1: 12345 is no index of a target point (0 to 1)");
}

TEST(Correspondences, ofTwoFiles)
{
  const NumberTable a = parseNumberTable("1 2 3\n4 5 6\n");
  const NumberTable b = parseNumberTable("7 8 9\n10 11 12\n");
  const Correspondences c = fromPointTables(a, b);
  EXPECT_EQ(c.source.col(1), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(c.target.col(1), Eigen::Vector3d(10, 11, 12));
  const NumberTable one = parseNumberTable("1 2 3\n");
  const NumberTable flat = parseNumberTable("1 2\n");
  EXPECT_NE(complaintOf([&] { fromPointTables(a, one); }).find("has 2 rows"),
            std::string::npos);
  EXPECT_NE(complaintOf([&] { fromPointTables(one, flat); }).find("target file"),
            std::string::npos);
}

TEST(Correspondences, otherNumbersOfColumnsAreNone)
{
  for (const char* text : {"1\n", "1 2 3\n", "1 2 3 4 5 6 7\n"})
    EXPECT_THROW(formOf(parseNumberTable(text)), InputError);
}

TEST(Transform, survivesText)
{
  made::Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Isometry3d pose = random.pose(4e6);
    RigidTransform transform;
    transform.rotation = pose.linear();
    transform.translation = pose.translation();
    const RigidTransform read = parseTransform(formatTransform(transform));
    EXPECT_EQ(read.translation, transform.translation);
    EXPECT_LT((read.rotation - transform.rotation).norm(), 1e-14);
  }
}

TEST(Transform, takesThreeRowsAndOneLine)
{
  const Eigen::Vector3d translation(4, 8, 12);
  for (const char* text : {"1 0 0 4\n0 1 0 8\n0 0 1 12\n",
                           "1 0 0 4 0 1 0 8 0 0 1 12",
                           "1 0 0 4\n0 1 0 8\n0 0 1 12\n0 0 0 1\n"})
    EXPECT_EQ(parseTransform(text).translation, translation) << text;
}

TEST(Transform, refusesWhatIsNotRigid)
{
  for (const char* text : {"1 0 0 0\n",
                           "1 0 0\n0 1 0\n0 0 1\n",
                           "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n",
                           "-1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n",
                           "1 0 0 nan\n0 1 0 0\n0 0 1 0\n0 0 0 1\n",
                           "1 0 0 0,5\n0 1 0 0\n0 0 1 0\n",
                           "1 0 0 0\n0 1 0 0\n0 0 1 0\n1 2 3 4\n"})
    EXPECT_THROW(parseTransform(text), InputError) << text;
}

} // namespace
} // namespace pcl_flashreg::io
