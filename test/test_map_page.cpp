// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "map/page.h"
#include "map/page_table.h"

#include <gtest/gtest.h>

namespace pcl_flashreg::map {
namespace {

class MapPage : public ::testing::Test {
protected:
  /** \brief A map of four, one of two, two scans by themselves. */
  MapPage()
  {
    result_.groups = {{0, 1, 2, 3}, {4, 5}, {6}, {7}};
    result_.scans.resize(8);
    for (std::size_t g = 0; g < result_.groups.size(); ++g)
      for (const std::size_t i : result_.groups[g]) {
        result_.scans[i].group = g;
        result_.scans[i].confidence = 0.999 - 0.01 * double(i);
        result_.scans[i].edges = 3;
      }
    for (std::size_t i = 0; i < 8; ++i)
      names_.push_back("s" + std::to_string(i));
    add(0, 1, EdgeFate::Used, 0.9, 0.01, 0.002);
    add(0, 2, EdgeFate::Used, 0.9, 0.02, 0.004);
    add(0, 3, EdgeFate::Used, 0.9, 0.03, 0.001);
    add(1, 2, EdgeFate::Used, 0.9, 0.005, 0.003);
    add(1, 3, EdgeFate::Disagrees, 0.2, 0, 0);
    add(2, 3, EdgeFate::Disagrees, 0.6, 0, 0);
    add(4, 5, EdgeFate::Used, 0.9, 0.004, 0.009);
    add(0, 6, EdgeFate::Apart, 0.3, 0, 0);
    add(5, 6, EdgeFate::Apart, 0.8, 0, 0);
  }

  void
  add(std::size_t target,
      std::size_t source,
      EdgeFate fate,
      double confidence,
      double rotation,
      double translation)
  {
    MapEdge edge;
    edge.target = target;
    edge.source = source;
    edge.fate = fate;
    edge.pair_confidence = confidence;
    edge.rotation_residual = rotation;
    edge.translation_residual = translation;
    result_.edges.push_back(edge);
  }

  std::string
  page() const
  {
    return formatPage({names_, result_, 28, 0.05, {"--leaf 0.05"}, {{"total", 12340}}});
  }

  void
  expectPart(const std::string& part) const
  {
    EXPECT_NE(page().find(part), std::string::npos) << part << "\nin\n" << page();
  }

  void
  expectNo(const std::string& part) const
  {
    EXPECT_EQ(page().find(part), std::string::npos) << part << "\nin\n" << page();
  }

  MultiviewResult result_;
  std::vector<std::string> names_;
};

TEST_F(MapPage, summarizes)
{
  expectPart("# Map of 8 scans\n");
  expectPart("placed: 6 of 8 scans, in 2 maps");
  expectPart("pairs: 28 registered\n");
  expectPart("edges: 5 used, 2 rejected (1 of them certain by "
             "themselves), 2 between");
  expectPart("loops: 1 independent");
  expectPart("resolution: 0.05\n");
  expectPart("options: `--leaf 0.05`");
  expectPart("time: total 12.3 s\n");
}

TEST_F(MapPage, listsMapsWhereThereAreSeveral)
{
  expectPart("| 1: s0 and others |     4 |     4 |     1 |\n"
             "| 2: s4 and others |     2 |     1 |     0 |\n");
  result_.groups = {{0, 1, 2, 3, 4, 5, 6, 7}};
  for (ScanPlace& scan : result_.scans)
    scan.group = 0;
  expectNo("## Maps");
  expectNo("not placed");
}

TEST_F(MapPage, saysWhyScansAreNotPlaced)
{
  expectPart("its pair with s5 (confidence 0.80) does not fit what other scans say");
  expectPart("no pair with another scan has a pose");
  result_.edges.pop_back();
  expectPart("no pair is certain, the best is that with s0 (confidence 0.30)");
}

TEST_F(MapPage, namesTheWorstResiduals)
{
  // 0.01 and 0.03 rad.
  expectPart("| rotation [deg] |  0.573 | 1.719 | s3 to s0 |");
  expectPart("| translation    |  0.003 | 0.009 | s5 to s4 |");
  for (MapEdge& edge : result_.edges)
    edge.fate = EdgeFate::Apart;
  expectNo("Residuals");
}

TEST_F(MapPage, namesTheLeastCertainScans)
{
  expectPart("| s5   |      0.949 |     3 |\n| s4   |      0.959 |     3 |\n");
  expectNo("| s0 "); // five of six
}

TEST_F(MapPage, ofNothingIsShort)
{
  result_ = {};
  result_.groups = {{0}};
  result_.scans.resize(1);
  expectPart("placed: 0 of 1 scan, in 0 maps");
  expectPart("loops: 0 independent");
  expectNo("Weakest");
}

TEST(PageTable, alignsAndEscapes)
{
  EXPECT_EQ(formatTable("lr", {{"name", "n"}, {"a|b\n", "10000"}, {"\xc3\xa4", "1"}}),
            "| name  |     n |\n"
            "|:------|------:|\n"
            "| a\\|b  | 10000 |\n"
            "| \xc3\xa4     |     1 |\n");
}

} // namespace
} // namespace pcl_flashreg::map
