// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cloud_io_support.h"
#include "io/cloud_io.h"
#include "io/raw_bin.h"
#include "io/row_length.h"

#include <cmath>
#include <functional>
#include <map>

namespace pcl_flashreg::io {
namespace {

using Columns = std::vector<std::string>;

/** \brief The rows of a raw file that a sensor's driver, or somebody's script, makes of a
 * made scan. */
class RawScans : public ::testing::Test {
protected:
  static const Eigen::Matrix3Xd&
  scan(const std::string& name)
  {
    static std::map<std::string, Eigen::Matrix3Xd> scans;
    auto it = scans.find(name);
    if (it == scans.end()) {
      const std::string path = PCL_FLASHREG_SOURCE_DIR "/data/" + name + ".pcd";
      it = scans.emplace(name, coordinates(readCloud(path))).first;
    }
    return it->second;
  }

  static double
  valueAt(const std::string& column,
          const Eigen::Vector3d& p,
          double place,
          made::Random& random)
  {
    if (column == "intensity")
      return std::floor(100 * std::pow(random.uniform(0, 1), 2)) / 100;
    if (column == "gray")
      return std::floor(256 * std::pow(random.uniform(0, 1), 2));
    if (column == "ring") {
      const double elevation = std::atan2(p.z(), std::hypot(p.x(), p.y()));
      return std::clamp(std::floor(16 + 30 * elevation), 0.0, 31.0);
    }
    if (column == "time")
      return 0.1 * place;
    if (column == "epoch")
      return 1.53e9;
    if (column == "color")
      return std::floor(random.uniform(0, 256));
    if (column == "label")
      return 10 * std::floor(random.uniform(0, 5));
    if (column == "speed")
      return random.normal();
    return 0;
  }

  /** \param[in] rows which points, in which order
   * \param[in] columns behind x, y and z */
  static std::string
  rawBytes(const Eigen::Matrix3Xd& xyz,
           const std::vector<Eigen::Index>& rows,
           const Columns& columns)
  {
    made::Random random(columns.size());
    std::string bytes;
    for (const Eigen::Index i : rows) {
      const Eigen::Vector3d p = xyz.col(i);
      for (int axis = 0; axis < 3; ++axis)
        append(bytes, static_cast<float>(p[axis]));
      // Unit vectors, more often upwards than not.
      const Eigen::Vector3d normal =
          (random.inCube(2) - Eigen::Vector3d(1, 1, 0.5)).normalized();
      int axis = 0;
      for (const std::string& column : columns) {
        const double place = static_cast<double>(i) / static_cast<double>(xyz.cols());
        append(bytes,
               static_cast<float>(column == "normal"
                                      ? normal[axis++]
                                      : valueAt(column, p, place, random)));
      }
    }
    return bytes;
  }

  static std::vector<Eigen::Index>
  inOrder(const Eigen::Matrix3Xd& xyz)
  {
    std::vector<Eigen::Index> rows(static_cast<std::size_t>(xyz.cols()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] = static_cast<Eigen::Index>(i);
    return rows;
  }

  static std::vector<Eigen::Index>
  anyOf(const Eigen::Matrix3Xd& xyz, std::size_t number)
  {
    made::Random random(number);
    std::vector<Eigen::Index> rows = inOrder(xyz);
    for (std::size_t i = 0; i < std::min(number, rows.size()); ++i)
      std::swap(rows[i], rows[i + random.next() % (rows.size() - i)]);
    rows.resize(std::min(number, rows.size()));
    return rows;
  }
};

const std::vector<Columns> LAYOUTS = {
    {},
    {"intensity"},
    {"gray"},
    {"zero"},
    {"time"},
    {"gray", "ring"},
    {"intensity", "ring"},
    {"gray", "time"},
    {"intensity", "epoch"},
    {"intensity", "zero"},
    {"intensity", "zero", "time"},
    {"color", "color", "color"},
    {"normal", "normal", "normal"},
    {"gray", "ring", "time"},
    {"zero", "zero", "zero"},
    {"speed", "speed", "speed", "time"},
    {"intensity", "normal", "normal", "normal"},
    {"color", "color", "color", "label"},
    {"normal", "normal", "normal", "intensity", "zero"},
    {"gray", "ring", "time", "label", "color"}};

std::string
nameOf(const Columns& columns)
{
  std::string name = "x y z";
  for (const std::string& column : columns)
    name += ' ' + column;
  return name;
}

TEST_F(RawScans, rowsAreToldByTheirColumns)
{
  for (const char* name :
       {"indoor/source", "indoor/target", "street/source", "street/target"}) {
    const Eigen::Matrix3Xd& xyz = scan(name);
    for (const Columns& columns : LAYOUTS)
      for (const auto& rows :
           {inOrder(xyz), anyOf(xyz, 1000000), anyOf(xyz, 3000), anyOf(xyz, 300)})
        EXPECT_EQ(rowLengthOf(rawBytes(xyz, rows, columns)), 3 + columns.size())
            << name << ": " << nameOf(columns) << ", " << rows.size() << " points";
  }
}

/** \brief Beams that take turns make every other row another kind of row. */
TEST_F(RawScans, beamsThatTakeTurnsAreNoColumns)
{
  const Eigen::Matrix3Xd& xyz = scan("street/source");
  std::vector<Eigen::Index> low, high;
  for (Eigen::Index i = 0; i < xyz.cols(); ++i)
    (xyz(2, i) < 0 ? low : high).push_back(i);
  const auto azimuth = [&](Eigen::Index i) { return std::atan2(xyz(1, i), xyz(0, i)); };
  for (auto* beam : {&low, &high})
    std::sort(beam->begin(), beam->end(), [&](Eigen::Index a, Eigen::Index b) {
      return azimuth(a) < azimuth(b);
    });
  std::vector<Eigen::Index> rows;
  constexpr int firings = 5000;
  constexpr double pi = 3.14159265358979323846;
  for (int k = 0; k < firings; ++k) {
    const double direction = -pi + 2 * pi * k / firings;
    for (const auto* beam : {&low, &high}) {
      const auto it = std::lower_bound(
          beam->begin(), beam->end(), direction, [&](Eigen::Index i, double angle) {
            return azimuth(i) < angle;
          });
      if (it != beam->end())
        rows.push_back(*it);
    }
  }
  for (const Columns& columns : LAYOUTS)
    EXPECT_EQ(rowLengthOf(rawBytes(xyz, rows, columns)), 3 + columns.size())
        << nameOf(columns);
}

TEST_F(RawScans, rowsOfNothingDoNotCount)
{
  const Eigen::Matrix3Xd& xyz = scan("street/source");
  made::Random random(1);
  for (const float nothing : {0.0f, std::nanf("")})
    for (const Columns& columns : LAYOUTS) {
      std::string bytes = rawBytes(xyz, inOrder(xyz), columns);
      const std::size_t row_size = (3 + columns.size()) * sizeof(float);
      for (std::size_t at = 0; at < bytes.size(); at += row_size)
        if (random.uniform(0, 1) < 0.4)
          for (std::size_t k = at; k < at + row_size; k += sizeof(float))
            std::memcpy(bytes.data() + k, &nothing, sizeof(float));
      EXPECT_EQ(rowLengthOf(bytes), 3 + columns.size()) << nameOf(columns);
    }
}

TEST_F(RawScans, fieldsHaveTheNamesOfTheirLayout)
{
  const Eigen::Matrix3Xd& xyz = scan("indoor/source");
  const auto names = [&](const Columns& columns, std::size_t row_length = 0) {
    std::string text;
    for (const Field& field :
         parseRawBin(rawBytes(xyz, inOrder(xyz), columns), row_length).fields)
      text += (text.empty() ? "" : " ") + field.name;
    return text;
  };
  EXPECT_EQ(names({}), "x y z");
  EXPECT_EQ(names({"intensity"}), "x y z intensity");
  EXPECT_EQ(names({"gray", "ring"}), "x y z intensity ring");
  EXPECT_EQ(names({"gray", "time"}), "x y z intensity field_4");
  EXPECT_EQ(names({"color", "color", "color"}), "x y z field_3 field_4 field_5");
}

TEST_F(RawScans, onlyKittisLayoutIsTakenWithoutAWord)
{
  const Eigen::Matrix3Xd& xyz = scan("street/target");
  const Cloud kitti = parseRawBin(rawBytes(xyz, inOrder(xyz), {"intensity"}));
  EXPECT_TRUE(kitti.notes.empty());
  EXPECT_EQ(kitti.size(), static_cast<std::size_t>(xyz.cols()));
  const std::string bytes = rawBytes(xyz, inOrder(xyz), {"gray", "ring"});
  const Cloud nuscenes = parseRawBin(bytes);
  EXPECT_EQ(nuscenes.size(), static_cast<std::size_t>(xyz.cols()));
  EXPECT_LT((coordinates(nuscenes) - xyz).norm(), 1e-3);
  ASSERT_EQ(nuscenes.notes.size(), 1u);
  EXPECT_TRUE(contains(nuscenes.notes[0], "rows of 5 float32 (x y z intensity ring)"));
  EXPECT_TRUE(parseRawBin(bytes, 5).notes.empty());
}

TEST_F(RawScans, whatIsNoneIsNamed)
{
  const Eigen::Matrix3Xd& xyz = scan("indoor/source");
  const auto complaint = [](const std::string& bytes, std::size_t row_length = 0) {
    return complaintOf([&](const std::string& b) { parseRawBin(b, row_length); },
                       bytes);
  };
  const std::string whole = rawBytes(xyz, inOrder(xyz), {"intensity"});
  EXPECT_TRUE(contains(complaint(whole.substr(0, whole.size() - 4)), "16 bytes"));
  EXPECT_TRUE(contains(complaint(whole.substr(0, whole.size() - 3)), "16 bytes"));
  EXPECT_TRUE(contains(complaint(whole + "abcd", 5), "20 bytes"));
  made::Random random(9);
  std::string doubles, coarse, noise, wide = whole;
  for (Eigen::Index i = 0; i < 2000; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      append(doubles, xyz(axis, i) + 1e-9);
      append(coarse, std::round(64 * xyz(axis, i)) / 64);
      append(noise, static_cast<float>(random.uniform(-80, 80)));
    }
  EXPECT_TRUE(contains(complaint(doubles), "float64"));
  EXPECT_TRUE(contains(complaint(doubles, 6), "float64"));
  EXPECT_TRUE(contains(complaint(coarse), "float64"));
  EXPECT_TRUE(contains(complaint(noise), "--bin-fields N"));
  EXPECT_EQ(parseRawBin(noise, 4).size(), 1500u);
  const float far = 1e20f;
  std::memcpy(wide.data() + 32, &far, sizeof(far));
  EXPECT_TRUE(contains(complaint(wide), "point 2 lies more than 100 km away"));
  EXPECT_TRUE(contains(complaint("1 2 3\n4 5 6\n"), "is text"));
  EXPECT_TRUE(contains(complaint("\x93NUMPY\x01" + whole), "NumPy"));
}

/** \brief Too little to tell anything by, and to register: KITTI's layout, as ever. */
TEST_F(RawScans, fewValuesAreRowsOfFour)
{
  std::string bytes;
  for (const float v : {1.0f, 2.0f, 3.0f, 0.5f, -4.0f, 5.0f, 6.0f, 0.25f})
    append(bytes, v);
  const Cloud cloud = parseRawBin(bytes);
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(valueOf(cloud, 1, "x"), -4);
  EXPECT_EQ(valueOf(cloud, 1, "intensity"), 0.25);
  EXPECT_EQ(parseRawBin(std::string(1584, '\0')).size(), 99u);
}

} // namespace
} // namespace pcl_flashreg::io
