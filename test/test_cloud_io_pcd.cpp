// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cloud_io_support.h"
#include "io/lzf.h"
#include "io/pcd.h"

#include <cmath>
#include <limits>

namespace pcl_flashreg::io {
namespace {

std::string
pcdHeader(const std::string& fields,
          const std::string& sizes,
          const std::string& types,
          const std::string& counts,
          const std::string& points,
          const std::string& data)
{
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " +
         types + "\nCOUNT " + counts + "\nWIDTH " + points +
         "\nHEIGHT 1\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS " + points + "\nDATA " + data +
         "\n";
}

TEST(Lzf, givesBackEveryLength)
{
  made::Random random(1);
  for (const std::size_t size : {0, 1, 2, 3, 4, 31, 32, 33, 263, 264, 265, 1000, 70000})
    for (const int alphabet : {1, 2, 256}) {
      std::vector<std::uint8_t> bytes(size);
      for (auto& byte : bytes)
        byte = static_cast<std::uint8_t>(random.next() % alphabet);
      const auto packed = compressLzf(bytes);
      EXPECT_LE(packed.size(), bytes.size() + bytes.size() / 32 + 1);
      const std::string_view view(reinterpret_cast<const char*>(packed.data()),
                                  packed.size());
      EXPECT_EQ(decompressLzf(view, size), bytes) << size << " of " << alphabet;
    }
}

TEST(Lzf, refusesDamage)
{
  using namespace std::string_view_literals;
  EXPECT_THROW(decompressLzf("\x05"sv, 6), InputError); // literals missing
  EXPECT_THROW(decompressLzf("\x00"sv
                             "A\x20\x05"sv,
                             4),
               InputError); // before the start
  EXPECT_THROW(decompressLzf("\x00"sv
                             "A"sv,
                             2),
               InputError);                             // too short
  EXPECT_THROW(decompressLzf("\xe0"sv, 9), InputError); // cut within a copy
  EXPECT_THROW(decompressLzf("\x00"sv
                             "A"sv,
                             std::size_t(1) << 60),
               InputError);
}

TEST(Pcd, keepsEveryField)
{
  const Cloud cloud = richCloud(1000);
  expectEqual(parsePcd(formatPcd(cloud)), cloud);
}

TEST(Pcd, keepsAnOrganizedShape)
{
  Cloud cloud = richCloud(12);
  cloud.width = 4;
  cloud.height = 3;
  expectEqual(parsePcd(formatPcd(cloud)), cloud);
}

TEST(Pcd, keepsSixtyFourBitIntegers)
{
  const std::string text =
      pcdHeader("x y z stamp", "4 4 4 8", "F F F U", "1 1 1 1", "1", "ascii") +
      "1 2 3 18446744073709551615\n";
  const Cloud cloud = parsePcd(text);
  std::uint64_t stamp = 0;
  std::memcpy(&stamp, cloud.point(0) + cloud.find("stamp")->offset, 8);
  EXPECT_EQ(stamp, std::numeric_limits<std::uint64_t>::max());
  expectEqual(parsePcd(formatPcd(cloud)), cloud);
}

TEST(Pcd, readsAsciiWithPaddingAndCrLf)
{
  const std::string text =
      pcdHeader("x _ y z i", "4 1 4 4 1", "F U F F I", "1 2 1 1 1", "2", "ascii") +
      "1.5 9 9 -2 nan -7\r\n\r\n1e3 9 9 +4 5 8";
  const Cloud cloud = parsePcd(text);
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.find("_"), nullptr);
  EXPECT_EQ(valueOf(cloud, 0, "x"), 1.5);
  EXPECT_TRUE(std::isnan(valueOf(cloud, 0, "z")));
  EXPECT_EQ(valueOf(cloud, 0, "i"), -7);
  EXPECT_EQ(valueOf(cloud, 1, "x"), 1000);
  EXPECT_EQ(valueOf(cloud, 1, "y"), 4);
  EXPECT_EQ(cloud.viewpoint[2], 3);
}

TEST(Pcd, readsBinaryWithPadding)
{
  std::string bytes =
      pcdHeader("x _ y z", "4 1 8 4", "F U F F", "1 4 1 1", "2", "binary");
  for (const double v : {1.0, 2.0}) {
    append(bytes, static_cast<float>(v));
    append(bytes, std::uint32_t(0xdeadbeef));
    append(bytes, 10 * v);
    append(bytes, static_cast<float>(100 * v));
  }
  const Cloud cloud = parsePcd(bytes);
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(valueOf(cloud, 1, "x"), 2);
  EXPECT_EQ(valueOf(cloud, 1, "y"), 20);
  EXPECT_EQ(valueOf(cloud, 1, "z"), 200);
}

TEST(Pcd, halfFloats)
{
  std::string bytes = pcdHeader("h", "2", "F", "7", "1", "binary");
  for (const unsigned half : {0x3c00, 0xc100, 0x0001, 0x8000, 0x7bff, 0xfc00, 0x7e00})
    append(bytes, static_cast<std::uint16_t>(half));
  const Cloud cloud = parsePcd(bytes);
  ASSERT_EQ(cloud.find("h")->type, ScalarType::Float32);
  const double expected[] = {1, -2.5, std::ldexp(1.0, -24), 0, 65504, -HUGE_VAL};
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_EQ(valueOf(cloud, 0, "h", k), expected[k]);
  EXPECT_TRUE(std::signbit(valueOf(cloud, 0, "h", 3)));
  EXPECT_TRUE(std::isnan(valueOf(cloud, 0, "h", 6)));
}

TEST(Pcd, notesWhatItGuessesAndLeavesOut)
{
  using Notes = std::vector<std::string>;
  const auto notesOf = [](const std::string& fields,
                          const std::string& sizes,
                          const std::string& types,
                          const std::string& row,
                          const std::string& data = "ascii") {
    std::string counts = "1";
    for (const char c : fields)
      counts += c == ' ' ? " 1" : "";
    return parsePcd(pcdHeader(fields, sizes, types, counts, "1", data) + row + "\n")
        .notes;
  };
  EXPECT_EQ(notesOf("x y z _", "4 4 4 1", "F F F U", "1 2 3 oh"), Notes{});
  EXPECT_EQ(notesOf("x y z a", "4 4 4 16", "F F F F", "1 2 3 4"),
            Notes{"the field 'a' has the unknown TYPE 'F' with SIZE '16': it is left "
                  "out"});
  EXPECT_EQ(notesOf("x y z a", "4 4 4 1", "F F F U", "1 2 3 300"),
            Notes{"the field 'a' is read as double: '300' does not fit its type"});
  EXPECT_EQ(notesOf("x y z a", "4 4 4 1", "F F F U", "1 2 3 \x18"),
            Notes{"the field 'a' is left out: '\\x18' is no number"});
  EXPECT_EQ(notesOf("X y Z", "4 4 4", "F F F", "1 2 3"),
            Notes{"fields are taken for coordinates: 'X' 'Z'"});
  EXPECT_EQ(notesOf("x y z x", "4 4 4 4", "F F F F", "1 2 3 4"),
            Notes{"there is more than one field 'x': another one is named 'x_2'"});
  EXPECT_EQ(notesOf("x y z", "4 4 4", "F F F", "1 2 3", "text"),
            Notes{"the DATA line says neither ascii, binary nor binary_compressed: it "
                  "is taken for ascii"});
  EXPECT_EQ(parsePcd("FIELDS x\nVIEWPOINT 1 2 3 4\nPOINTS 0\nDATA binary\n").notes,
            Notes{"VIEWPOINT is not seven numbers: the sensor is taken to stand at the "
                  "first three"});
}

TEST(Pcd, notesOfPointsThatLackValues)
{
  const Cloud cloud = parsePcd(
      pcdHeader(
          "x y z a tag b", "4 4 4 4 1 4", "F F F F U F", "1 1 1 1 1 1", "3", "ascii") +
      "1 2 3 4 \x18 5\n1 2 3 4   5\n1 2 3 4 \n 5\n");
  EXPECT_EQ(cloud.notes,
            (std::vector<std::string>{
                "the field 'tag' is left out: '\\x18' is no number",
                "the field 'b' is left out: line 13 has 5 of 6 values"}));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(valueOf(cloud, i, "a"), 4);
}

TEST(Pcd, writesWhatItKept)
{
  const Cloud cloud = parsePcd(pcdHeader("X Y Z _ i i h a tag",
                                         "4 4 4 1 1 2 2 1 1",
                                         "f f f u u u f u u",
                                         "1 1 1 2 1 1 3 1 1",
                                         "1",
                                         "ascii") +
                               "1 2 3 0 0 5 6 0.5 0.25 nan -1 ?\n");
  ASSERT_EQ(cloud.notes.size(), 4u);
  const Cloud again = parsePcd(formatPcd(cloud));
  EXPECT_EQ(again.notes.size(), 0u);
  expectEqual(again, cloud);
  EXPECT_EQ(valueOf(again, 0, "i_2"), 6);
  EXPECT_EQ(valueOf(again, 0, "h", 1), 0.25);
  EXPECT_EQ(valueOf(again, 0, "a"), -1);
  EXPECT_EQ(again.find("tag"), nullptr);
}

TEST(BadPcd, saysWhatIsWrong)
{
  const auto xyz = [](const std::string& n, const std::string& data) {
    return pcdHeader("x y z", "4 4 4", "F F F", "1 1 1", n, data);
  };
  const std::string huge = "1000000000000000000";
  const std::vector<std::pair<std::string, std::string>> table = {
      {"hello", "unknown keyword 'hello'"},
      {"VERSION 0.7\n", "no DATA line"},
      {"DATA ascii\n", "no FIELDS line"},
      {xyz("3", "ascii") + "1 2 3\n", "cut off"},
      {xyz("2", "ascii") + "1.25 2.25 3.25\n1.25 2.25\n",
       "line 13: expected 3 values, found 2"},
      {xyz("2", "ascii") + "1 2 3\n1 2 oh\n", "'oh' is no value for the field 'z'"},
      {xyz("2", "binary") + "12345678901234567890", "cut off"},
      {xyz(huge, "binary") + "1234", "cut off"},
      {xyz(huge, "ascii") + "1 2 3", "cut off"},
      {xyz(huge, "binary_compressed") + std::string(8, '\0'), "cut off"},
      {xyz("1", "binary_compressed") + "1234", "lacks its sizes"},
      {xyz("1", "binary_compressed") + "\x09" + std::string(7, '\0'), "cut off"},
      {xyz("1", "rot13"), "the DATA line"},
      {xyz("-1", "ascii"), "expected a number after 'WIDTH'"},
      {xyz("99999999999999999999999", "ascii"), "expected a number after 'WIDTH'"},
      {pcdHeader("x y", "4 4 4", "F F F", "1 1 1", "1", "ascii"), "same number"},
      {pcdHeader("x", "3", "F", "1", "1", "ascii"), "unknown TYPE"},
      {pcdHeader("x", "4", "Q", "1", "1", "ascii"), "unknown TYPE"},
      {pcdHeader("x", "4", "F", "-1", "1", "ascii"), "impossible COUNT"},
      {pcdHeader("x", "4", "F", "some", "1", "ascii"), "impossible COUNT"},
      {pcdHeader("x", "4", "F", "0", "1", "ascii"), "declares no values"},
      {pcdHeader("a", "?", "F", "1", "1", "binary"), "'a' has no SIZE"},
      {pcdHeader("x", "4", "F", huge, "1", "binary"), "impossible COUNT"},
      {"FIELDS x\nWIDTH 4294967296\nHEIGHT 4294967297\nDATA binary\n",
       "impossibly large"},
      {"FIELDS x\nWIDTH 2\nHEIGHT 2\nPOINTS 5\nDATA binary\n", "POINTS is 5"},
      {"FIELDS x\nHEIGHT 2\nDATA binary\n", "neither WIDTH nor POINTS"},
      {pcdHeader("x y z i", "4 4 4 1", "F F F U", "1 1 1 1", "2", "ascii") +
           "1.5 2.5 3.5 4\n1 2 3\n",
       "line 13 has 3 of 4 values"},
      {pcdHeader("i x y z", "1 4 4 4", "U F F F", "1 1 1 1", "1", "ascii") + " 1 2 3\n",
       "line 12: expected 4 values, found 3"},
      {xyz("1", "ascii") + "1 2 \x1b[1m\n",
       "'\\x1b[1m' is no value for the field 'z'"}};
  for (const auto& [bytes, complaint] : table)
    EXPECT_TRUE(contains(complaintOf(parsePcd, bytes), complaint))
        << complaint << "\n  but: " << complaintOf(parsePcd, bytes);
}

} // namespace
} // namespace pcl_flashreg::io
