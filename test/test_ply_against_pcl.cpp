// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Whatever pcl::PLYReader reads with the right coordinates, parsePly() reads, and so; and
// what it makes of the sensor's pose, parsePly() makes of it.

#include "io/file.h"
#include "io/ply.h"
#include "ply_forms.h"

#include <pcl/console/print.h>
#include <pcl/io/ply_io.h>
#include <pcl/pcl_config.h>

#include <Eigen/Geometry>

#include <filesystem>
#include <fstream>
#include <functional>

namespace fs = std::filesystem;

namespace pcl_flashreg::io {
namespace {

using forms::Column;
using forms::Element;
using forms::Encoding;
using forms::Form;

struct Variation {
  const char* label;
  /** \brief Whether PCL reads the points right; where it doesn't, we do nevertheless. */
  bool by_pcl;
  std::function<void(Form&)> change;
};

double
small(std::size_t row)
{
  return static_cast<double>(row % 5);
}

/** \brief Rotation by a third of a turn: no symmetry hides a transposed matrix. */
double
cameraValue(std::size_t k)
{
  constexpr double values[] = {1.5, -2, 30, 0, 0, 1, 1, 0, 0, 0, 1, 0};
  return k < 12 ? values[k] : 0;
}

/** \brief PCL's camera, each property of that type. */
Element
camera(const std::string& type)
{
  Element element{"camera", 1, {}, ""};
  const auto add = [&](const std::string& name, double (*value)(std::size_t)) {
    element.columns.push_back({type + ' ' + name, value, 2, {}});
  };
  add("view_px", [](std::size_t) { return cameraValue(0); });
  add("view_py", [](std::size_t) { return cameraValue(1); });
  add("view_pz", [](std::size_t) { return cameraValue(2); });
  add("x_axisx", [](std::size_t) { return cameraValue(3); });
  add("x_axisy", [](std::size_t) { return cameraValue(4); });
  add("x_axisz", [](std::size_t) { return cameraValue(5); });
  add("y_axisx", [](std::size_t) { return cameraValue(6); });
  add("y_axisy", [](std::size_t) { return cameraValue(7); });
  add("y_axisz", [](std::size_t) { return cameraValue(8); });
  add("z_axisx", [](std::size_t) { return cameraValue(9); });
  add("z_axisy", [](std::size_t) { return cameraValue(10); });
  add("z_axisz", [](std::size_t) { return cameraValue(11); });
  for (const char* name : {"focal", "scalex", "k1"})
    add(name, [](std::size_t) { return 0.0; });
  return element;
}

Element
faces()
{
  return {"face", 3, {{"list uchar int vertex_indices", small, 3, {}}}, ""};
}

std::function<void(Form&)>
column(const char* declaration, bool in_front = false)
{
  return [=](Form& f) {
    auto& columns = f.vertex().columns;
    columns.insert(in_front ? columns.begin() : columns.end(),
                   {declaration, small, 2, {}});
  };
}

std::function<void(Form&)>
line(const char* text)
{
  return [=](Form& f) {
    f.first_lines.push_back(text);
    f.last_lines.push_back(text);
  };
}

std::function<void(Form&)>
element(const Element& added, bool in_front)
{
  return [=](Form& f) {
    f.elements.insert(in_front ? f.elements.begin() : f.elements.end(), added);
  };
}

/** \brief What programs write into headers and bodies. */
std::vector<Variation>
layoutVariations()
{
  return {
      {"as it is", true, [](Form&) {}},
      {"CR LF", true, [](Form& f) { f.line_end = "\r\n"; }},
      {"blank behind ply", true, [](Form& f) { f.magic = "ply "; }},
      {"words behind ply", true, [](Form& f) { f.magic = "ply of mine"; }},
      {"comment", true, line("comment element vertex 3")},
      {"indented comment", true, line(" \tcomment x")},
      {"comment by PCL", true, line("comment PCL generated")},
      {"obj_info", true, line("obj_info is_mesh 0")},
      {"empty line", true, line("")},
      {"unknown line", true, line("texturefile a.png")},
      {"blank behind the version", false, [](Form& f) { f.format_tail = " 1.0  "; }},
      {"another version", false, [](Form& f) { f.format_tail = " 2.0"; }},
      {"blank behind the count", true, [](Form& f) { f.vertex().tail = " \t"; }},
      {"words behind the count", false, [](Form& f) { f.vertex().tail = "  "; }},
      {"blanks and words about a type",
       true,
       [](Form& f) { f.vertex().columns[1].declaration = "\tfloat   y  (metres)"; }},
      {"float32",
       true,
       [](Form& f) { f.vertex().columns[0].declaration = "float32 x"; }},
      {"z first",
       true,
       [](Form& f) { std::swap(f.vertex().columns[0], f.vertex().columns[2]); }},
      {"no rows behind",
       true,
       [](Form& f) {
         f.elements.push_back({"face", 0, {}, ""});
       }},
      {"no line end", true, [](Form& f) { f.rest = ""; }},
      {"more behind the body", true, [](Form& f) { f.rest = "1 2 3 and so on\n"; }},
      {"tabs", true, [](Form& f) { f.blank = "\t "; }},
      {"indented rows", true, [](Form& f) { f.indent = "  "; }},
      {"blanks behind rows", true, [](Form& f) { f.row_tail = " \t"; }},
  };
}

/** \brief Properties and elements beside the coordinates. */
std::vector<Variation>
contentVariations()
{
  std::vector<Variation> variations = {
      {"bytes", true, column("uchar label")},
      {"signed bytes in front", true, column("int8 label", true)},
      {"shorts", true, column("short s")},
      {"unsigned shorts in front", true, column("uint16 s", true)},
      {"ints", true, column("int i")},
      {"unsigned ints", true, column("uint32 u")},
      {"doubles in front", true, column("double time", true)},
      {"int64", false, column("int64 stamp")},
      {"normals",
       true,
       [](Form& f) {
         for (const char* name : {"float nx", "float ny", "float nz"})
           column(name)(f);
       }},
      {"colours",
       true,
       [](Form& f) {
         for (const char* name : {"uchar red", "uchar green", "uchar blue"})
           column(name)(f);
       }},
      {"diffuse colours",
       true,
       [](Form& f) {
         for (const char* name :
              {"uchar diffuse_red", "uchar diffuse_green", "uchar diffuse_blue"})
           column(name)(f);
       }},
      {"intensity in bytes", true, column("uchar intensity")},
      {"two of a name",
       false,
       [](Form& f) {
         column("float w")(f);
         column("uchar w")(f);
       }},
      {"list behind", true, column("list uint float h")},
      {"list of bytes", true, column("list uchar int h")},
      {"list with short lengths", true, column("list ushort double h")},
      {"faces in front", true, element(faces(), true)},
      {"faces behind", true, element(faces(), false)},
      {"camera in front", true, element(camera("float"), true)},
      {"camera behind", true, element(camera("float"), false)},
      {"camera of doubles", true, element(camera("double"), false)},
      {"element of an unknown type",
       false,
       element({"tag", 1, {{"int64 id", small, 2, {}}}, ""}, false)},
      {"words as values",
       true,
       [](Form& f) {
         f.vertex().columns.push_back({"float note", small, 2, {"-", "none", "1,5"}});
       }},
      {"numbers that do not fit",
       true,
       [](Form& f) {
         f.vertex().columns.push_back({"uchar gray", small, 2, {"300", "0.5", "-1"}});
       }},
  };
  return variations;
}

std::vector<Variation>
allVariations()
{
  std::vector<Variation> all = layoutVariations();
  for (const Variation& variation : contentVariations())
    all.push_back(variation);
  return all;
}

/** \brief What PCL makes of a file. */
struct ByPcl {
  bool right = false;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
};

class PlyAgainstPcl : public ::testing::Test {
protected:
  void
  SetUp() override
  {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = (fs::temp_directory_path() /
             (std::string("pcl_flashreg_ply_against_pcl_") + test->name() + ".ply"))
                .string();
  }

  void
  TearDown() override
  {
    fs::remove(path_);
  }

  ByPcl
  readByPcl(const std::string& bytes) const
  {
    std::ofstream(path_, std::ios::binary) << bytes;
    pcl::PLYReader reader;
    pcl::PCLPointCloud2 cloud;
    ByPcl result;
    int version = 0;
    if (reader.read(path_, cloud, result.origin, result.orientation, version) != 0 ||
        cloud.width * cloud.height != Form::POINTS)
      return result;
    result.right = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int index = pcl::getFieldIndex(cloud, std::string(1, "xyz"[axis]));
      result.right = result.right && index >= 0 &&
                     cloud.fields[static_cast<std::size_t>(index)].datatype ==
                         pcl::PCLPointField::FLOAT32;
      if (!result.right)
        break;
      for (std::size_t i = 0; i < Form::POINTS; ++i) {
        float value = 0;
        std::memcpy(&value,
                    cloud.data.data() + i * cloud.point_step +
                        cloud.fields[static_cast<std::size_t>(index)].offset,
                    sizeof(value));
        result.right = result.right && value == forms::coordinate(i, axis);
      }
    }
    return result;
  }

  static void
  expectRead(const std::string& bytes, const ByPcl& by_pcl, const std::string& label)
  {
    Cloud cloud;
    ASSERT_NO_THROW(cloud = parsePly(bytes))
        << label << ": " << complaintOf(parsePly, bytes);
    ASSERT_EQ(cloud.size(), Form::POINTS) << label;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < Form::POINTS; ++i)
        ASSERT_EQ(valueOf(cloud, i, std::string(1, "xyz"[axis])),
                  forms::coordinate(i, axis))
            << label;
    // PCL takes the camera's numbers as float32 alone.
    if (by_pcl.right && givesPoses() && label.find("of doubles") == std::string::npos)
      expectSamePose(cloud, by_pcl.origin, by_pcl.orientation, label);
  }

  static void
  expectSamePose(const Cloud& cloud,
                 const Eigen::Vector4f& origin,
                 const Eigen::Quaternionf& orientation,
                 const std::string& label)
  {
    const auto& v = cloud.viewpoint;
    EXPECT_EQ(Eigen::Vector3d(v.data()), origin.head<3>().cast<double>()) << label;
    const Eigen::Quaterniond rotation(v[3], v[4], v[5], v[6]);
    EXPECT_LT(rotation.angularDistance(orientation.cast<double>()), 1e-6) << label;
  }

  /** \brief The reader of PCL 1.13 forgets the pose that it has read. */
  static bool
  givesPoses()
  {
    return PCL_VERSION_COMPARE(>=, 1, 14, 0);
  }

  std::string path_;
};

TEST_F(PlyAgainstPcl, readsEveryVariation)
{
  for (const Variation& variation : allVariations())
    for (const Encoding encoding : forms::ENCODINGS) {
      Form form;
      variation.change(form);
      const std::string label = std::string(variation.label) + ", " + nameOf(encoding);
      const std::string bytes = form.bytes(encoding);
      const ByPcl by_pcl = readByPcl(bytes);
      EXPECT_TRUE(by_pcl.right || !variation.by_pcl) << "not by PCL: " << label;
      expectRead(bytes, by_pcl, label);
    }
}

TEST_F(PlyAgainstPcl, readsEveryPairOfVariations)
{
  const std::vector<Variation> all = allVariations();
  std::size_t by_pcl_too = 0;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b)
      for (const Encoding encoding : forms::ENCODINGS) {
        Form form;
        all[a].change(form);
        all[b].change(form);
        const std::string bytes = form.bytes(encoding);
        const ByPcl by_pcl = readByPcl(bytes);
        by_pcl_too += by_pcl.right ? 1 : 0;
        expectRead(bytes,
                   by_pcl,
                   std::string(all[a].label) + " + " + all[b].label + ", " +
                       nameOf(encoding));
        if (HasFatalFailure())
          return;
      }
  EXPECT_GT(by_pcl_too, 2000u);
}

/** \brief A cloud whose sensor stood somewhere and was turned. */
pcl::PCLPointCloud2
cloudOfPcl()
{
  pcl::PointCloud<pcl::PointXYZ> points(3, 2);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].getVector3fMap().setConstant(static_cast<float>(i));
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(points, cloud);
  return cloud;
}

const Eigen::Vector4f ORIGIN(1.25f, -20.5f, 3, 0);
const Eigen::Quaternionf ORIENTATION =
    Eigen::Quaternionf(0.9f, 0.1f, -0.3f, 0.2f).normalized();

TEST_F(PlyAgainstPcl, readsThePoseThatPclWrites)
{
  const pcl::PCLPointCloud2 cloud = cloudOfPcl();
  pcl::PLYWriter writer;
  ASSERT_EQ(writer.writeASCII(path_, cloud, ORIGIN, ORIENTATION, 9, true), 0);
  expectSamePose(parsePly(readFile(path_)), ORIGIN, ORIENTATION, "ascii");
  ASSERT_EQ(writer.writeBinary(path_, cloud, ORIGIN, ORIENTATION, true), 0);
  expectSamePose(parsePly(readFile(path_)), ORIGIN, ORIENTATION, "binary");
  // Without a camera PCL writes the origin alone.
  ASSERT_EQ(writer.writeASCII(path_, cloud, ORIGIN, ORIENTATION, 9, false), 0);
  const Eigen::Quaternionf none = Eigen::Quaternionf::Identity();
  expectSamePose(parsePly(readFile(path_)), ORIGIN, none, "obj_info");
}

TEST_F(PlyAgainstPcl, writesThePoseAsPclDoes)
{
  ASSERT_EQ(
      pcl::PLYWriter().writeBinary(path_, cloudOfPcl(), ORIGIN, ORIENTATION, true), 0);
  const std::string by_pcl = readFile(path_);
  Cloud cloud = parsePly(by_pcl);
  cloud.width = 3;
  cloud.height = 2;
  const std::string by_us = formatPly(cloud);
  const auto cameraLines = [](const std::string& bytes) {
    const std::size_t begin = bytes.find("element camera");
    return bytes.substr(begin, bytes.find("end_header") - begin);
  };
  EXPECT_EQ(cameraLines(by_us), cameraLines(by_pcl));
  constexpr std::size_t row = 21 * sizeof(float);
  const auto values = [](const std::string& bytes) {
    std::array<float, 19> read{};
    std::memcpy(read.data(), bytes.data() + bytes.size() - row, 17 * sizeof(float));
    std::memcpy(read.data() + 17, bytes.data() + bytes.size() - 2 * sizeof(float), 8);
    return read;
  };
  for (std::size_t k = 0; k < 19; ++k)
    EXPECT_NEAR(values(by_us)[k], values(by_pcl)[k], 1e-6) << k;
  // Width and height.
  EXPECT_EQ(by_us.substr(by_us.size() - 16, 8), by_pcl.substr(by_pcl.size() - 16, 8));
  writeFile(path_, by_us);
  pcl::PCLPointCloud2 again;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  ASSERT_EQ(pcl::PLYReader().read(path_, again, origin, orientation, version), 0);
  EXPECT_EQ(again.width, 3u);
  EXPECT_EQ(again.height, 2u);
  if (givesPoses())
    expectSamePose(cloud, origin, orientation, "by PCL");
}

} // namespace
} // namespace pcl_flashreg::io
