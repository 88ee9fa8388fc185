// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cloud_io_support.h"
#include "io/ply.h"

namespace pcl_flashreg::io {
namespace {

TEST(Ply, keepsEveryField)
{
  Cloud cloud = richCloud(200);
  const Cloud read = parsePly(formatPly(cloud));
  // PLY has neither a viewpoint nor fields of several values.
  EXPECT_EQ(read.fields.size(), cloud.fields.size() + 4);
  EXPECT_EQ(read.data, cloud.data);
  EXPECT_EQ(valueOf(read, 9, "histogram_4"), valueOf(cloud, 9, "histogram", 4));
  EXPECT_EQ(read.find("x")->type, ScalarType::Float64);
}

TEST(Ply, refusesToWriteSixtyFourBitIntegers)
{
  Cloud cloud;
  cloud.addField("x", ScalarType::Float32);
  cloud.addField("stamp", ScalarType::Uint64);
  EXPECT_TRUE(contains(complaintOf([&](const std::string&) { formatPly(cloud); }, ""),
                       "'stamp'"));
}

class PlyEncoding : public ::testing::TestWithParam<std::string> {};

/** \brief An element with a list before the vertices, a list among their properties,
 * and faces behind them. */
TEST_P(PlyEncoding, stepsOverListsAndOtherElements)
{
  const std::string encoding = GetParam();
  std::string bytes =
      "ply\r\nformat " + encoding +
      " 1.0\r\ncomment made\r\nelement camera 2\r\nproperty uchar k\r\n"
      "property list uchar short values\r\nelement vertex 2\r\n"
      "property double x\r\nproperty list int float w\r\n"
      "property double y\r\nproperty float z\r\nproperty ushort ring\r\n"
      "element face 1\r\nproperty list uchar int vertex_indices\r\n"
      "end_header\r\n";
  if (encoding == "ascii") {
    bytes +=
        "5 3 -1 -2 -3\n6 0\n0.1 2 8 9 0.2 0.3 7\n4000000.25 0 1.2 1.3 65535\n3 0 1 0\n";
  }
  else {
    const bool big = encoding == "binary_big_endian";
    append(bytes, std::uint8_t(5));
    append(bytes, std::uint8_t(3));
    for (const std::int16_t v : {-1, -2, -3})
      append(bytes, v, big);
    append(bytes, std::uint8_t(6));
    append(bytes, std::uint8_t(0));
    append(bytes, 0.1, big);
    append(bytes, std::int32_t(2), big);
    append(bytes, 8.0f, big);
    append(bytes, 9.0f, big);
    append(bytes, 0.2, big);
    append(bytes, 0.3f, big);
    append(bytes, std::uint16_t(7), big);
    append(bytes, 4000000.25, big);
    append(bytes, std::int32_t(0), big);
    append(bytes, 1.2, big);
    append(bytes, 1.3f, big);
    append(bytes, std::uint16_t(65535), big);
    append(bytes, std::uint8_t(0));
  }
  const Cloud cloud = parsePly(bytes);
  ASSERT_EQ(cloud.size(), 2u);
  ASSERT_EQ(cloud.fields.size(), 4u);
  EXPECT_EQ(valueOf(cloud, 0, "x"), 0.1);
  EXPECT_EQ(valueOf(cloud, 0, "y"), 0.2);
  EXPECT_EQ(valueOf(cloud, 0, "z"), double(0.3f));
  EXPECT_EQ(valueOf(cloud, 0, "ring"), 7);
  EXPECT_EQ(valueOf(cloud, 1, "x"), 4000000.25);
  EXPECT_EQ(valueOf(cloud, 1, "ring"), 65535);
}

INSTANTIATE_TEST_SUITE_P(All,
                         PlyEncoding,
                         ::testing::Values("ascii",
                                           "binary_little_endian",
                                           "binary_big_endian"));

TEST(BadPly, saysWhatIsWrong)
{
  const auto ply = [](const std::string& rest) { return "ply\nformat " + rest; };
  const std::string vertex = "ascii 1.0\nelement vertex 2\nproperty float x\n";
  const std::vector<std::pair<std::string, std::string>> table = {
      {"hello", "not a PLY file"},
      {"ply\n", "no end_header line"},
      {"ply\nend_header\n", "no format line"},
      {ply("morse 1.0\nend_header\n"), "the format line"},
      {ply(vertex), "no end_header line"},
      {ply(vertex + "end_header\n1"), "cut off"},
      {ply(vertex + "end_header\n1\nup"), "'up' is no value for the property 'x'"},
      {ply(vertex + "property quad y\nend_header\n"), "unknown type 'quad'"},
      {ply(vertex + "property list float int y\nend_header\n"), "makes no sense"},
      {ply(vertex + "property float x\nend_header\n1 2 3 4"), "declared twice"},
      {ply(vertex + "surprise\nend_header\n"), "unknown keyword 'surprise'"},
      {ply("ascii 1.0\nelement vertex -2\nend_header\n"), "makes no sense"},
      {ply("ascii 1.0\nelement face 0\nend_header\n"), "no vertices"},
      {ply("ascii 1.0\nelement vertex 2\nend_header\n"), "no properties"},
      {ply("binary_little_endian 1.0\nelement vertex 999999999999999999\n"
           "property double x\nend_header\n12345678"),
       "cut off"},
      {ply("ascii 1.0\nelement a 1\nproperty list char int l\nelement vertex 1\n"
           "property float x\nend_header\n-3 1\n"),
       "negative length"},
      {ply("binary_little_endian 1.0\nelement a 1\nproperty list uint int l\n"
           "element vertex 1\nproperty float x\nend_header\n\xff\xff\xff\xff"),
       "cut off"}};
  for (const auto& [bytes, complaint] : table)
    EXPECT_TRUE(contains(complaintOf(parsePly, bytes), complaint))
        << complaint << "\n  but: " << complaintOf(parsePly, bytes);
}

} // namespace
} // namespace pcl_flashreg::io
