// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cloud_io_support.h"
#include "io/ply.h"

#include <cmath>

namespace pcl_flashreg::io {
namespace {

TEST(Ply, keepsEveryField)
{
  Cloud cloud = richCloud(200);
  const Cloud read = parsePly(formatPly(cloud));
  // PLY has no fields of several values.
  EXPECT_EQ(read.fields.size(), cloud.fields.size() + 4);
  EXPECT_EQ(read.data, cloud.data);
  EXPECT_EQ(valueOf(read, 9, "histogram_4"), valueOf(cloud, 9, "histogram", 4));
  EXPECT_EQ(read.find("x")->type, ScalarType::Float64);
  for (std::size_t k = 0; k < 7; ++k)
    EXPECT_NEAR(read.viewpoint[k], cloud.viewpoint[k], 1e-15) << k;
  EXPECT_TRUE(read.notes.empty());
}

TEST(Ply, noCameraIsWrittenForTheViewpointThatFilesHaveWithoutOne)
{
  Cloud cloud = richCloud(3);
  const auto has_camera = [&] { return contains(formatPly(cloud), "element camera"); };
  EXPECT_TRUE(has_camera());
  cloud.viewpoint = {0, 0, 0, 1, 0, 0, 0};
  EXPECT_FALSE(has_camera());
  cloud.viewpoint = {0, 0, 0, -3, 0, 0, 0};
  EXPECT_FALSE(has_camera()) << "the same rotation";
  cloud.viewpoint = {0, 0, 1, 0, 0, 0, 0};
  EXPECT_TRUE(has_camera());
  EXPECT_EQ(parsePly(formatPly(cloud)).viewpoint,
            (std::array<double, 7>{0, 0, 1, 1, 0, 0, 0}));
  cloud.viewpoint[0] = std::nan("");
  EXPECT_FALSE(has_camera());
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
      {ply("ascii 1.0\nelement vertex -2\nend_header\n"), "makes no sense"},
      {ply("ascii 1.0\nelement face 0\nend_header\n"), "no vertices"},
      {ply("ascii 1.0\nelement vertex 2\nend_header\n"), "no properties"},
      {ply("ascii 1.0\nproperty float x\nend_header\n"), "before any element"},
      {ply("binary_little_endian 1.0\nelement vertex 999999999999999999\n"
           "property double x\nend_header\n12345678"),
       "cut off"},
      {ply("binary_little_endian 1.0\nelement a 1\nproperty list char int l\n"
           "element vertex 1\nproperty float x\nend_header\n\xfd"
           "1234"),
       "negative length"},
      {ply("ascii 1.0\nelement a 1\nproperty list char int l\nelement vertex 1\n"
           "property float x\nend_header\nfew 1\n"),
       "a length of the list 'l' is no number"},
      {ply("binary_little_endian 1.0\nelement a 1\nproperty list uint int l\n"
           "element vertex 1\nproperty float x\nend_header\n\xff\xff\xff\xff"),
       "cut off"}};
  for (const auto& [bytes, complaint] : table)
    EXPECT_TRUE(contains(complaintOf(parsePly, bytes), complaint))
        << complaint << "\n  but: " << complaintOf(parsePly, bytes);
}

// Fields beside the coordinates ------------------------------------------------------

std::string
asciiPly(const std::string& properties, const std::string& body)
{
  return "ply\nformat ascii 1.0\nelement vertex 2\n" + properties + "end_header\n" +
         body;
}

const std::string XYZ = "property float x\nproperty float y\nproperty float z\n";

TEST(Ply, propertiesOfOneNameGetDifferentOnes)
{
  const Cloud cloud = parsePly(asciiPly(
      XYZ + "property uchar a\nproperty float a\nproperty int a_2\nproperty int a\n",
      "0 0 0 1 2 3 4\n0 0 0 5 6 7 8\n"));
  ASSERT_EQ(cloud.fields.size(), 7u);
  EXPECT_EQ(valueOf(cloud, 1, "a"), 5);
  EXPECT_EQ(valueOf(cloud, 1, "a_3"), 6);
  EXPECT_EQ(valueOf(cloud, 1, "a_2"), 7);
  EXPECT_EQ(valueOf(cloud, 1, "a_4"), 8);
}

TEST(Ply, capitalsAreCoordinatesWhereThereAreNoOthers)
{
  const Cloud capital = parsePly(asciiPly(
      "property float X\nproperty float Y\nproperty float Z\n", "1 2 3\n4 5 6\n"));
  EXPECT_EQ(valueOf(capital, 1, "z"), 6);
  const Cloud both =
      parsePly(asciiPly(XYZ + "property float X\n", "1 2 3 7\n4 5 6 8\n"));
  EXPECT_EQ(valueOf(both, 1, "x"), 4);
  EXPECT_EQ(valueOf(both, 1, "X"), 8);
}

TEST(Ply, valuesThatDoNotFitMakeTheirFieldOneOfDoubles)
{
  const Cloud cloud = parsePly(asciiPly(
      "property uchar a\n" + XYZ + "property short b\n", "7 1 2 3 -1\n300 4 5 6 8\n"));
  EXPECT_EQ(cloud.find("a")->type, ScalarType::Float64);
  EXPECT_EQ(cloud.find("b")->type, ScalarType::Int16);
  EXPECT_EQ(valueOf(cloud, 0, "a"), 7);
  EXPECT_EQ(valueOf(cloud, 1, "a"), 300);
  EXPECT_EQ(valueOf(cloud, 0, "b"), -1);
  EXPECT_EQ(valueOf(cloud, 1, "z"), 6);
  EXPECT_TRUE(cloud.notes.empty());
}

TEST(Ply, wordsThatAreNoNumbersCostTheirFieldAlone)
{
  const Cloud cloud =
      parsePly(asciiPly("property uchar a\n" + XYZ + "property float b\n",
                        "none 1 2 3 0.5\n- 4 5 6 0.25\n"));
  EXPECT_EQ(cloud.find("a"), nullptr);
  EXPECT_EQ(valueOf(cloud, 1, "b"), 0.25);
  EXPECT_EQ(valueOf(cloud, 1, "x"), 4);
  ASSERT_EQ(cloud.notes.size(), 1u);
  EXPECT_EQ(cloud.notes[0], "'none' is no value for the property 'a': it is left out");
}

TEST(Ply, aListThatIsNotThereMayHaveANegativeLength)
{
  const Cloud cloud =
      parsePly(asciiPly("property list int int l\n" + XYZ, "-1 1 2 3\n2 8 9 4 5 6\n"));
  EXPECT_EQ(valueOf(cloud, 0, "x"), 1);
  EXPECT_EQ(valueOf(cloud, 1, "z"), 6);
}

// The camera ---------------------------------------------------------------------------

std::string
cameraPly(const std::string& camera, const std::string& rows, std::size_t number = 1)
{
  return "ply\nformat ascii 1.0\nelement vertex 2\n" + XYZ +
         "element face 1\n"
         "property list uchar int vertex_indices\nelement camera " +
         std::to_string(number) + "\n" + camera +
         "end_header\n1 2 3\n4 5 6\n3 0 1 0\n" + rows;
}

const std::string PLACE =
    "property float view_px\nproperty float view_py\nproperty double view_pz\n";
const std::string AXES =
    "property float x_axisx\nproperty float x_axisy\nproperty float x_axisz\n"
    "property float y_axisx\nproperty float y_axisy\nproperty float y_axisz\n"
    "property float z_axisx\nproperty float z_axisy\nproperty float z_axisz\n";

TEST(PlyCamera, isTheViewpoint)
{
  // The axes by rows: a quarter of a turn about z.
  const Cloud cloud = parsePly(cameraPly(PLACE + AXES, "7 8 9.5 0 -1 0 1 0 0 0 0 1\n"));
  const double half = std::sqrt(0.5);
  const double expected[] = {7, 8, 9.5, half, 0, 0, half};
  for (std::size_t k = 0; k < 7; ++k)
    EXPECT_NEAR(cloud.viewpoint[k], expected[k], 1e-12) << k;
  EXPECT_TRUE(cloud.notes.empty());
}

TEST(PlyCamera, countsAsFarAsItMakesSense)
{
  const std::array<double, 7> none = {0, 0, 0, 1, 0, 0, 0};
  std::array<double, 7> placed = none;
  placed = {7, 8, 9, 1, 0, 0, 0};
  const std::string two = PLACE.substr(0, PLACE.find("property double"));
  struct Row {
    std::string camera, rows;
    std::array<double, 7> viewpoint;
    std::string note;
  };
  const std::vector<Row> table = {
      {PLACE, "7 8 9\n", placed, ""},
      {two, "7 8\n", none, ""},
      {"property float focal\n" + PLACE, "35 7 8 9\n", placed, ""},
      {PLACE, "7 nan 9\n", none, "not finite"},
      {PLACE, "7 8 up\n", none, "'up' is no value for the property 'view_pz'"},
      {PLACE + AXES, "7 8 9 0 0 0 0 0 0 0 0 0\n", placed, "no rotation"},
      {PLACE + AXES, "7 8 9 1 0 0 0 1 0 0 0 -1\n", placed, "no rotation"},
      {PLACE + AXES, "7 8 9 1 0 0 0 nan 0 0 0 1\n", placed, "no rotation"},
      {PLACE + AXES, "7 8 9 2 0 0 0 2 0 0 0 2\n", placed, "no rotation"},
      {PLACE + AXES, "7 8 9 1 0 0 0 1\n", none, "cut off"},
      {PLACE, "", none, "cut off"},
      {PLACE + "property quad q\n", "7 8 9 1\n", none, "unknown type 'quad'"},
      {"", "", none, ""}};
  for (const Row& row : table) {
    const Cloud cloud = parsePly(cameraPly(row.camera, row.rows));
    EXPECT_EQ(cloud.viewpoint, row.viewpoint) << row.rows;
    EXPECT_EQ(valueOf(cloud, 1, "z"), 6);
    if (row.note.empty())
      EXPECT_TRUE(cloud.notes.empty()) << cloud.notes[0];
    else {
      ASSERT_EQ(cloud.notes.size(), 1u) << row.rows;
      EXPECT_TRUE(contains(cloud.notes[0], row.note)) << cloud.notes[0];
    }
  }
}

TEST(PlyCamera, ofSeveralTheLastOneCounts)
{
  const Cloud cloud = parsePly(cameraPly(PLACE, "7 8 9\n1 2 3\n", 2));
  EXPECT_EQ(cloud.viewpoint[2], 3);
  ASSERT_EQ(cloud.notes.size(), 1u);
  EXPECT_TRUE(contains(cloud.notes[0], "2 cameras"));
}

TEST(PlyCamera, offsetsOfOtherProgramsAreNotTheSensors)
{
  const std::string offsets =
      "obj_info echo_rgb_offset_x 1\nobj_info echo_rgb_offset_y 2\n"
      "obj_info echo_rgb_offset_z 3\n";
  const std::string rest = "element vertex 1\n" + XYZ + "end_header\n0 0 0\n";
  const std::string head = "ply\nformat ascii 1.0\n";
  EXPECT_EQ(parsePly(head + offsets + rest).viewpoint[2], 0);
  EXPECT_EQ(parsePly(head + "comment PCL generated\n" + offsets + rest).viewpoint[2],
            3);
}

} // namespace
} // namespace pcl_flashreg::io
