// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Every form of PCD header and body that programs write, one by one and in combination:
// parsePcd() reads each of them, and PCL's reader none with other coordinates.

#include "cloud_io_support.h"
#include "io/pcd.h"
#include "pcd_variations.h"
#include "pcl_fixtures.h"

#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>

#include <optional>
#include <sstream>

namespace pcl_flashreg::io {
namespace {

using forms::Encoding;
using forms::Form;
using forms::Variation;

/** \brief What pcl::PCDReader makes of a file. */
struct PclCloud {
  pcl::PointCloud<pcl::PointXYZ> points;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
};

/** \brief Calls PCL's parts as PCDReader::read() does for a file; nothing where one refuses.
 */
std::optional<PclCloud>
readWithPcl(const std::string& bytes)
{
  PclCloud read;
  pcl::PCLPointCloud2 blob;
  pcl::PCDReader reader;
  std::istringstream stream(bytes);
  int version = 0, type = 0;
  unsigned body = 0;
  try {
    if (reader.readHeader(
            stream, blob, read.origin, read.orientation, version, type, body) < 0)
      return std::nullopt;
    stream.clear();
    stream.seekg(body);
    std::size_t size = blob.data.size();
    if (type == 2) {
      std::uint32_t compressed = 0;
      stream.read(reinterpret_cast<char*>(&compressed), sizeof(compressed));
      size = compressed + 8;
    }
    if (type != 0 && body + size > bytes.size())
      return std::nullopt;
    const auto* map = reinterpret_cast<const unsigned char*>(bytes.data());
    const int result = type == 0
                           ? reader.readBodyASCII(stream, blob, version)
                           : reader.readBodyBinary(map, blob, version, type == 2, body);
    if (result < 0 || blob.width * blob.height == 0)
      return std::nullopt;
  }
  catch (const std::exception&) {
    return std::nullopt;
  }
  // Where the lines are in another order than its own, PCL computes this too early.
  blob.row_step = blob.point_step * blob.width;
  if (blob.data.size() < blob.row_step * blob.height)
    return std::nullopt;
  pcl::fromPCLPointCloud2(blob, read.points);
  return read;
}

/** \brief Whether PCL reads the points that the form has, and where the sensor stood. */
bool
pclIsRight(const Form& form, const std::string& bytes)
{
  const made::Silence silence;
  const auto read = readWithPcl(bytes);
  if (!read || read->points.width != form.width || read->points.height != form.height)
    return false;
  for (std::size_t i = 0; i < form.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (read->points[i].data[axis] != form.coordinate(i, axis))
        return false;
  if (!form.pcl_keeps_viewpoint)
    return true;
  const Eigen::Quaternionf& q = read->orientation;
  const std::array<double, 7> viewpoint = {
      read->origin.x(), read->origin.y(), read->origin.z(), q.w(), q.x(), q.y(), q.z()};
  return viewpoint == form.viewpoint;
}

/** \brief Fails where parsePcd() does not give what the form has. */
void
expectRead(const Form& form, const std::string& bytes)
{
  Cloud cloud;
  try {
    cloud = parsePcd(bytes);
  }
  catch (const InputError& error) {
    FAIL() << error.what();
  }
  ASSERT_EQ(cloud.width, form.width);
  ASSERT_EQ(cloud.height, form.height);
  const Eigen::Matrix3Xd xyz = coordinates(cloud);
  for (std::size_t i = 0; i < form.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_EQ(xyz(axis, static_cast<Eigen::Index>(i)), form.coordinate(i, axis))
          << "point " << i;
  EXPECT_EQ(cloud.viewpoint, form.viewpoint);
  for (std::size_t c = 0; c < form.columns.size(); ++c) {
    const std::string& name = form.columns[c].kept_as;
    ASSERT_EQ(cloud.find(form.columns[c].name) != nullptr ||
                  cloud.find(name) != nullptr,
              !name.empty())
        << form.columns[c].name;
    if (name.empty())
      continue;
    for (std::size_t i = 0; i < form.size(); ++i)
      for (std::size_t k = 0; k < form.columns[c].count; ++k)
        ASSERT_EQ(valueOf(cloud, i, name, k), form.value(i, c, k)) << name;
  }
  for (const std::string& note : cloud.notes)
    for (const char letter : note)
      ASSERT_TRUE(letter >= ' ' && letter < 127) << note;
}

TEST(PcdAgainstPcl, eachVariation)
{
  for (const std::vector<Variation>& group : forms::variations())
    for (const Variation& variation : group)
      for (const Encoding encoding : forms::ENCODINGS) {
        Form form;
        variation.change(form);
        SCOPED_TRACE(std::string(variation.label) + ", " + forms::nameOf(encoding));
        const std::string bytes = form.bytes(encoding);
        expectRead(form, bytes);
        EXPECT_TRUE(!variation.pclReads(encoding) || pclIsRight(form, bytes));
      }
}

TEST(PcdAgainstPcl, variationsTogether)
{
  constexpr int rounds = 5000;
  made::Random random(1);
  const std::vector<std::vector<Variation>> groups = forms::variations();
  int asked = 0;
  for (int round = 0; round < rounds; ++round)
    for (const Encoding encoding : forms::ENCODINGS) {
      Form form;
      std::string labels = forms::nameOf(encoding);
      bool pcl_reads = true;
      for (const std::vector<Variation>& group : groups) {
        // Every second file has nothing that PCL cannot read.
        const Variation* variation = nullptr;
        do
          variation = &group[random.next() % group.size()];
        while (round % 2 == 0 && !variation->pclReads(encoding));
        variation->change(form);
        labels += std::string(", ") + variation->label;
        pcl_reads = pcl_reads && variation->pclReads(encoding);
      }
      const std::string bytes = form.bytes(encoding);
      SCOPED_TRACE(labels + ":\n" + bytes);
      expectRead(form, bytes);
      if (pcl_reads) {
        ++asked;
        EXPECT_TRUE(pclIsRight(form, bytes));
      }
      if (HasFailure())
        return;
    }
  EXPECT_GE(asked, rounds);
}

/** \brief A word of an ascii file, and the number that it is. */
struct Word {
  std::string text;
  std::optional<double> number;
};

std::vector<Word>
oddWords()
{
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {{"300", 300},
          {"-1", -1},
          {"-0", 0},
          {"2.5", 2.5},
          {"1e2", 100},
          {"4294967296", 4294967296.0},
          {"-9223372036854775809", -9223372036854775808.0},
          {"18446744073709551616", 18446744073709551616.0},
          {"1e400", infinity},
          {"nan", nan},
          {"-nan(ind)", nan},
          {"-1.#IND", nan},
          {"-Inf", -infinity},
          {"a", std::nullopt},
          {"true", std::nullopt},
          {"0x1F", std::nullopt},
          {"12a", std::nullopt},
          {"1,5", std::nullopt},
          {"--", std::nullopt},
          {"#", std::nullopt},
          {"\x18", std::nullopt},
          {"\xff", std::nullopt},
          {std::string(1, '\0'), std::nullopt}};
}

TEST(PcdAgainstPcl, wordsThatFitNoField)
{
  const std::vector<std::pair<char, std::size_t>> types = {{'U', 1},
                                                           {'I', 1},
                                                           {'U', 2},
                                                           {'I', 2},
                                                           {'U', 4},
                                                           {'I', 4},
                                                           {'U', 8},
                                                           {'I', 8},
                                                           {'B', 1},
                                                           {'F', 2},
                                                           {'F', 4},
                                                           {'F', 8}};
  for (const auto& [type, size] : types)
    for (const std::size_t place : {0, 2, 3})
      for (const Word& word : oddWords()) {
        Form form;
        std::vector<forms::Column> columns = {{"x"}, {"y"}, {"z"}};
        columns.insert(columns.begin() + static_cast<std::ptrdiff_t>(place),
                       {"a", type, size});
        if (!word.number)
          columns[place].kept_as = "";
        form.setColumns(columns);
        form.odd_column = place;
        form.odd_words = {"1", word.text};
        const std::string bytes = form.bytes(Encoding::Ascii);
        SCOPED_TRACE(bytes);
        const Cloud cloud = parsePcd(bytes);
        EXPECT_TRUE(pclIsRight(form, bytes));
        const Eigen::Matrix3Xd xyz = coordinates(cloud);
        for (std::size_t i = 0; i < form.size(); ++i)
          for (int axis = 0; axis < 3; ++axis)
            ASSERT_EQ(xyz(axis, static_cast<Eigen::Index>(i)),
                      form.coordinate(i, axis));
        ASSERT_EQ(cloud.find("a") != nullptr, word.number.has_value());
        if (!word.number)
          continue;
        for (std::size_t i = 0; i < form.size(); ++i) {
          double expected = i == 0 ? 1 : i == 1 ? *word.number : form.value(i, place);
          if (type == 'F' && size <= 4)
            expected = static_cast<float>(expected);
          const double value = valueOf(cloud, i, "a");
          EXPECT_TRUE(value == expected || std::isnan(expected)) << value;
          EXPECT_EQ(std::isnan(value), std::isnan(expected));
        }
      }
}

TEST(PcdAgainstPcl, bytesThatAreWrittenAsCharacters)
{
  const forms::Column tag = {"tag", 'U', 1, 1, ""};
  const std::vector<std::vector<forms::Column>> layouts = {
      {{"x"}, {"y"}, {"z"}, tag},
      {{"x"}, {"y"}, {"z"}, {"i"}, tag, {"stamp", 'F', 8}},
      {{"x"}, {"y"}, {"z"}, tag, {"line", 'U', 1}, {"a"}, {"b"}}};
  for (const auto& columns : layouts)
    for (const char* const line_end : {"\n", "\r\n"})
      for (int byte = 0; byte < 256; ++byte) {
        const std::string character(1, static_cast<char>(byte));
        const bool separates = contains(" \t\r\n", character) && byte != 0;
        Form form;
        form.setColumns(columns);
        form.line_end = line_end;
        form.odd_column = columns[3].name == "tag" ? 3 : 4;
        form.odd_words = {"\x80", character, character, "\x81", "7", character};
        const std::string bytes = form.bytes(Encoding::Ascii);
        SCOPED_TRACE(bytes);
        EXPECT_EQ(pclIsRight(form, bytes), !separates);
        // '\v' and '\f' separate words, too, but PCL's.
        if (separates || byte == '\v' || byte == '\f')
          for (std::size_t c = form.odd_column; c < form.columns.size(); ++c)
            form.columns[c].kept_as = "";
        expectRead(form, bytes);
      }
}

/** \brief Files that are refused, as what must be done to a good one. */
struct Refusal {
  const char* complaint;
  void (*spoil)(std::string& bytes);
};

void
replace(std::string& bytes, const std::string& what, const std::string& by)
{
  const std::size_t at = bytes.find(what);
  ASSERT_NE(at, std::string::npos) << what;
  bytes.replace(at, what.size(), by);
}

TEST(PcdAgainstPcl, refusesWhatPclDoesNotRead)
{
  const std::vector<Refusal> refusals = {
      {"POINTS is 7", [](std::string& b) { replace(b, "POINTS 6", "POINTS 7"); }},
      {"POINTS is 6", [](std::string& b) { replace(b, "HEIGHT 1", "HEIGHT 2"); }},
      {"number after 'WIDTH'",
       [](std::string& b) { replace(b, "WIDTH 6", "WIDTH w"); }},
      {"number after 'WIDTH'", [](std::string& b) { replace(b, "WIDTH 6", "WIDTH"); }},
      {"number after 'WIDTH'",
       [](std::string& b) { replace(b, "WIDTH 6", "WIDTH -6"); }},
      {"same number", [](std::string& b) { replace(b, "SIZE 4", "SIZE"); }},
      {"same number", [](std::string& b) { replace(b, "x y z i", "x y z"); }},
      {"keyword 'FRAME'",
       [](std::string& b) { replace(b, "WIDTH", "FRAME map\nWIDTH"); }},
      {"unknown TYPE 'Q'", [](std::string& b) { replace(b, "F F F U", "Q F F U"); }},
      {"unknown TYPE 'F'", [](std::string& b) { replace(b, "4 4 4 1", "4 4 3 1"); }},
      {"no DATA line", [](std::string& b) { b.resize(b.find("DATA")); }},
      {"cut off", [](std::string& b) {
         replace(b, "WIDTH 6", "WIDTH 7");
         replace(b, "POINTS 6", "POINTS 7");
       }}};
  for (const Refusal& refusal : refusals)
    for (const Encoding encoding : forms::ENCODINGS) {
      Form form;
      std::string bytes = form.bytes(encoding);
      refusal.spoil(bytes);
      SCOPED_TRACE(std::string(refusal.complaint) + ", " + forms::nameOf(encoding));
      EXPECT_TRUE(contains(complaintOf(parsePcd, bytes), refusal.complaint))
          << complaintOf(parsePcd, bytes);
      EXPECT_FALSE(pclIsRight(form, bytes));
    }
}

} // namespace
} // namespace pcl_flashreg::io
