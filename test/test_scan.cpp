// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// What a scan is made from, and that a file gives it back.

#include "support/made_features.h"
#include "support/made_scans.h"

#include <pcl_flashreg/pair_registration.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <type_traits>
#include <utility>

namespace pcl_flashreg {
namespace {

using made::RoomScans;

constexpr double V = RoomScans::RESOLUTION;
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

const RoomScans&
room()
{
  static const RoomScans scans;
  return scans;
}

PairRegistration&
maker()
{
  static PairRegistration registration(BackendKind::Cpu, 2);
  return registration;
}

ScanInput<float>
inputOf(const std::vector<float>& xyz)
{
  ScanInput<float> input;
  input.points.data = xyz.data();
  input.points.size = xyz.size() / 3;
  return input;
}

std::vector<float>
toFloat(const std::vector<double>& values)
{
  return {values.begin(), values.end()};
}

bool
same(const Scan& a, const Scan& b)
{
  return a.serialize() == b.serialize();
}

TEST(Scan, OfNothingIsEmpty)
{
  const Scan nothing;
  EXPECT_TRUE(nothing.empty());
  EXPECT_EQ(nothing.features().size, 0u);
  EXPECT_EQ(nothing.origins(), nullptr);
  EXPECT_FALSE(nothing.viewpoint());
  EXPECT_TRUE(maker().makeScan(ScanInput<float>(), V).empty());
  EXPECT_TRUE(same(nothing, Scan::deserialize(nothing.serialize())));
}

TEST(Scan, HoldsKeypointsNormalsAndDescriptors)
{
  const Scan scan = maker().makeScan(room().targetInput(), V);
  ASSERT_GT(scan.size(), 500u);
  EXPECT_EQ(scan.spacing(), V);
  EXPECT_TRUE(scan.shift().isZero(0));
  ASSERT_TRUE(scan.viewpoint());
  EXPECT_EQ(*scan.viewpoint(), room().target_viewpoint);
  EXPECT_EQ(scan.features().size, scan.size());
  EXPECT_EQ(scan.features().dimension, 33u);
  EXPECT_EQ(scan.origins(), nullptr) << "centroids are nobody's points";
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3f> normal(scan.normals() + 3 * i);
    ASSERT_NEAR(normal.norm(), 1, 1e-5);
    ASSERT_GE(normal.cast<double>().dot(*scan.viewpoint() - scan.point(i)), 0);
  }
}

TEST(Scan, IsTheSameFromFloatsAndDoublesOnAnyNumberOfThreads)
{
  const std::vector<float> floats = toFloat(room().target);
  const std::vector<double> doubles(floats.begin(), floats.end());
  const Scan scan = maker().makeScan(inputOf(floats), V);
  PairRegistration alone(BackendKind::Cpu, 1);
  ScanInput<double> input = RoomScans::inputOf(doubles, Eigen::Vector3d::Zero());
  input.viewpoint_known = false;
  EXPECT_TRUE(same(scan, alone.makeScan(input, V)));
}

TEST(Scan, HonoursStrideAndIndicesAndSkipsWhatIsNotFinite)
{
  const std::vector<float> xyz = toFloat(room().target);
  std::vector<float> picked, rows;
  std::vector<std::int32_t> indices;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const bool bad = i % 7 == 3;
    rows.insert(rows.end(), &xyz[3 * i], &xyz[3 * i] + 3);
    rows.insert(rows.end(), {1e9f, NOT_A_NUMBER});
    if (bad)
      rows[rows.size() - 4] = NOT_A_NUMBER;
    if (i % 2 == 0) {
      indices.push_back(static_cast<std::int32_t>(i));
      if (!bad)
        picked.insert(picked.end(), &xyz[3 * i], &xyz[3 * i] + 3);
    }
  }
  ScanInput<float> input;
  input.points = {rows.data(), rows.size() / 5, 5, indices.data(), indices.size()};
  EXPECT_TRUE(same(maker().makeScan(input, V), maker().makeScan(inputOf(picked), V)));
}

TEST(Scan, OfLargeCoordinatesIsShifted)
{
  const Eigen::Vector3d away(4.5e5, 5.4e6, 120);
  std::vector<double> far = room().target;
  for (std::size_t i = 0; i < far.size(); ++i)
    far[i] += away[i % 3];
  const made::Features given = made::scattered(far.size() / 3, 4, 4, 3);
  ScanInput<double> input = RoomScans::inputOf(far, room().target_viewpoint + away);
  input.features = given.view();
  const Scan scan = maker().makeScan(input, V);
  EXPECT_FALSE(scan.shift().isZero(0));
  EXPECT_EQ(scan.shift(), singlePrecisionShift(input.points));
  ASSERT_TRUE(scan.viewpoint());
  EXPECT_EQ(*scan.viewpoint(), room().target_viewpoint + away);
  // Single precision has steps of half a metre there.
  ASSERT_EQ(scan.size(), far.size() / 3);
  for (std::size_t i = 0; i < scan.size(); ++i)
    ASSERT_LT((scan.point(i) - Eigen::Vector3d(&far[3 * i])).norm(), 1e-6);

  // Nobody saw that from the origin.
  EXPECT_NE(maker()
                .makeScan(RoomScans::inputOf(far, Eigen::Vector3d::Zero()), V)
                .viewpointSource(),
            ViewpointSource::Stated);
}

TEST(Scan, OfASurfaceHasNoDescriptors)
{
  const Scan scan = maker().makeScan(room().targetInput(), V);
  const Scan surface = maker().makeScan(room().targetInput(), V, ScanContent::Surface);
  EXPECT_EQ(surface.features().dimension, 0u);
  EXPECT_GE(surface.size(), scan.size());
  std::set<std::vector<float>> points;
  for (std::size_t i = 0; i < surface.size(); ++i)
    points.insert({surface.points() + 3 * i, surface.points() + 3 * i + 3});
  for (std::size_t i = 0; i < scan.size(); ++i)
    EXPECT_EQ(points.count({scan.points() + 3 * i, scan.points() + 3 * i + 3}), 1u);
}

TEST(Scan, TakesGivenNormals)
{
  const std::vector<float> xyz = toFloat(room().target);
  // Rows of four, of any length; nobody has turned them. Few keypoints: with such normals
  // the viewpoint could not be told from a false one.
  constexpr double COARSE = 0.4;
  std::vector<float> normals;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i)
    normals.insert(normals.end(), {0, i % 2 ? 3.0f : -2.0f, 0, NOT_A_NUMBER});
  ScanInput<float> input = inputOf(xyz);
  input.normals = normals.data();
  input.normal_stride = 4;
  input.viewpoint = {1, 50, 1};
  for (const ScanContent content : {ScanContent::Surface, ScanContent::Descriptors}) {
    input.viewpoint_known = true;
    const Scan towards = maker().makeScan(input, COARSE, content);
    ASSERT_GT(towards.size(), 100u);
    for (std::size_t i = 0; i < towards.size(); ++i) {
      ASSERT_EQ(towards.normals()[3 * i], 0);
      ASSERT_EQ(towards.normals()[3 * i + 1], 1);
      ASSERT_EQ(towards.curvatures()[i], 0);
    }
    input.viewpoint_known = false;
    const Scan unturned = maker().makeScan(input, COARSE, content);
    std::size_t down = 0;
    for (std::size_t i = 0; i < unturned.size(); ++i)
      down += unturned.normals()[3 * i + 1] == -1;
    EXPECT_GT(down, 10u);
    EXPECT_LT(down, unturned.size());
  }
}

TEST(Scan, ComputesNormalsThatAreMissing)
{
  const Scan computed = maker().makeScan(room().targetInput(), V, ScanContent::Surface);
  const std::vector<float> xyz = toFloat(room().target);
  std::vector<float> none(xyz.size(), 0.0f);
  none[7] = NOT_A_NUMBER;
  ScanInput<double> input = room().targetInput();
  input.normals = none.data();
  const Scan filled = maker().makeScan(input, V, ScanContent::Surface);
  EXPECT_TRUE(same(computed, filled));
}

TEST(Scan, TakesDescriptorsOfTheCallers)
{
  std::vector<float> xyz = toFloat(room().target);
  const std::size_t size = xyz.size() / 3;
  xyz[3 * 10] = NOT_A_NUMBER;
  const made::Features given = made::scattered(size, 32, 40, 3);
  std::vector<std::int32_t> indices;
  for (std::size_t i = 0; i < size; i += 2)
    indices.push_back(static_cast<std::int32_t>(i));
  ScanInput<float> input = inputOf(xyz);
  input.points.indices = indices.data();
  input.points.index_count = indices.size();
  input.features = given.view();
  const Scan scan = maker().makeScan(input, 0.08);
  ASSERT_EQ(scan.size(), indices.size() - 1) << "all but the one that is not finite";
  ASSERT_NE(scan.origins(), nullptr);
  EXPECT_EQ(scan.features().dimension, 32u);
  std::size_t with_normal = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const auto origin = static_cast<std::size_t>(scan.origins()[i]);
    ASSERT_EQ(origin % 2, 0u);
    ASSERT_NE(origin, 10u);
    ASSERT_TRUE(
        std::equal(&xyz[3 * origin], &xyz[3 * origin] + 3, scan.points() + 3 * i));
    const float* row = scan.features().data + i * scan.features().stride;
    ASSERT_TRUE(std::equal(row, row + 32, given.values.data() + 40 * origin));
    with_normal += std::isfinite(scan.normals()[3 * i]);
  }
  EXPECT_GT(with_normal, scan.size() * 9 / 10);

  // For correspondences the same input is a cloud like any other.
  const Scan surface = maker().makeScan(input, V, ScanContent::Surface);
  EXPECT_EQ(surface.features().dimension, 0u);
  EXPECT_LT(surface.size(), scan.size() * 9 / 10);
}

TEST(Scan, CanForgetItsViewpoint)
{
  const Scan scan = maker().makeScan(room().targetInput(), V);
  const Scan blind = scan.withoutViewpoint();
  EXPECT_TRUE(scan.viewpoint());
  EXPECT_FALSE(blind.viewpoint());
  EXPECT_EQ(blind.points(), scan.points()) << "the memory is shared";
}

TEST(Scan, IsTakenWhereItWasMadeBefore)
{
  ScanInput<double> input = room().targetInput();
  const Scan scan = maker().makeScan(input, V);
  input.made = &scan;
  EXPECT_EQ(maker().makeScan(input, V).points(), scan.points());
  EXPECT_NE(maker().makeScan(input, 2 * V).points(), scan.points());
  EXPECT_NE(maker().makeScan(input, V, ScanContent::Surface).points(), scan.points());
}

TEST(Scan, CanBeCopiedMovedAndUsedAfter)
{
  Scan scan = maker().makeScan(room().targetInput(), V);
  const std::size_t size = scan.size();
  const Scan moved = std::move(scan);
  EXPECT_EQ(moved.size(), size);
  // NOLINTNEXTLINE(bugprone-use-after-move): whoever was moved from still has its data.
  EXPECT_EQ(scan.size(), size);
}

TEST(Scan, RefusesWhatIsOutOfRange)
{
  const std::vector<float> xyz = toFloat(room().target);
  const auto expect_refused = [&](const char* word, const auto& spoil) {
    ScanInput<float> input = inputOf(xyz);
    double resolution = V;
    std::vector<std::int32_t> indices;
    spoil(input, resolution, indices);
    try {
      maker().makeScan(input, resolution);
      ADD_FAILURE() << word;
    }
    catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
          << error.what();
    }
  };
  using Input = ScanInput<float>;
  using Indices = std::vector<std::int32_t>;
  for (const double bad : {0.0, -1.0, double{NOT_A_NUMBER}})
    expect_refused("resolution",
                   [&](Input&, double& resolution, Indices&) { resolution = bad; });
  expect_refused("too small", [](Input&, double& r, Indices&) { r = 1e-17; });
  expect_refused("stride", [](Input& i, double&, Indices&) { i.points.stride = 2; });
  expect_refused("index", [](Input& i, double&, Indices& indices) {
    indices = {0, static_cast<std::int32_t>(i.points.size)};
    i.points.indices = indices.data();
    i.points.index_count = indices.size();
  });
  expect_refused("normal_stride", [&](Input& i, double&, Indices&) {
    i.normals = xyz.data();
    i.normal_stride = 2;
  });
  expect_refused("features.size", [&](Input& i, double&, Indices&) {
    i.features = {xyz.data(), 5, 3, 3};
  });
  expect_refused("features.stride", [&](Input& i, double&, Indices&) {
    i.features = {xyz.data(), i.points.size, 3, 2};
  });
  expect_refused("viewpoint",
                 [](Input& i, double&, Indices&) { i.viewpoint.y() = NOT_A_NUMBER; });
}

class ScanFile : public testing::Test {
protected:
  ScanFile()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("scan_file_" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(folder_);
  }
  ~ScanFile() override
  {
    std::filesystem::remove_all(folder_);
  }

  std::string
  path(const std::string& name) const
  {
    return (folder_ / name).string();
  }

  static Scan
  scan()
  {
    return maker().makeScan(room().targetInput(), V);
  }

  static std::string
  complaintOf(const std::string& bytes)
  {
    try {
      Scan::deserialize(bytes);
    }
    catch (const ScanFileError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(ScanFile, GivesBackTheSameBits)
{
  const std::vector<float> xyz = toFloat(room().target);
  const made::Features given = made::scattered(xyz.size() / 3, 5, 5, 3);
  ScanInput<float> with_features = inputOf(xyz);
  with_features.features = given.view();
  for (const Scan& scan :
       {scan(),
        scan().withoutViewpoint(),
        maker().makeScan(room().targetInput(), V, ScanContent::Surface),
        maker().makeScan(with_features, V)}) {
    scan.save(path("a.scan"));
    const Scan loaded = Scan::load(path("a.scan"));
    EXPECT_TRUE(same(scan, loaded));
    EXPECT_EQ(loaded.viewpoint().has_value(), scan.viewpoint().has_value());
    EXPECT_EQ(loaded.features().dimension, scan.features().dimension);
    EXPECT_EQ(loaded.origins() == nullptr, scan.origins() == nullptr);
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1)
      << "nothing else is left";
}

TEST_F(ScanFile, RegistersLikeTheScanThatWasSaved)
{
  const Scan source = maker().makeScan(room().sourceInput(), V), target = scan();
  source.save(path("source.scan"));
  target.save(path("target.scan"));
  const Result made = maker().align(source, target).pose;
  const Result loaded =
      maker()
          .align(Scan::load(path("source.scan")), Scan::load(path("target.scan")))
          .pose;
  EXPECT_TRUE(made.converged);
  EXPECT_EQ(made.T_target_source.toMatrix<double>(),
            loaded.T_target_source.toMatrix<double>());
  EXPECT_EQ(made.confidence, loaded.confidence);
  EXPECT_EQ(made.inliers, loaded.inliers);
}

/** \brief The same on every machine, whatever its own order: read byte by byte. */
TEST_F(ScanFile, HasLittleEndianNumbers)
{
  const Scan scan = this->scan();
  const std::string bytes = scan.serialize();
  const auto number = [&bytes](std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;)
      value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
  };
  const auto bits = [](auto value) {
    std::conditional_t<sizeof(value) == 4, std::uint32_t, std::uint64_t> word;
    std::memcpy(&word, &value, sizeof(value));
    return static_cast<std::uint64_t>(word);
  };
  EXPECT_EQ(bytes.substr(12, 4), "\x04\x03\x02\x01");
  EXPECT_EQ(number(8, 4), 2u) << "version";
  EXPECT_EQ(number(16, 8), scan.size());
  EXPECT_EQ(number(24, 8), scan.features().dimension);
  EXPECT_EQ(number(40, 8), bits(V)) << "spacing";
  constexpr std::size_t POINTS = 128;
  EXPECT_EQ(number(POINTS, 4), bits(scan.points()[0]));
  EXPECT_EQ(number(POINTS + 4, 4), bits(scan.points()[1]));
  std::uint64_t sum = 0xcbf29ce484222325u;
  for (std::size_t i = 0; i + 8 < bytes.size(); i += 8) {
    sum = (sum ^ number(i, 8)) * 0x100000001b3u;
    sum ^= sum >> 32;
  }
  EXPECT_EQ(number(bytes.size() - 8, 8), sum);
}

TEST_F(ScanFile, ThatIsCutIsRefused)
{
  const std::string good = scan().serialize();
  for (const std::size_t size : {std::size_t{0},
                                 std::size_t{5},
                                 std::size_t{50},
                                 std::size_t{96},
                                 std::size_t{200},
                                 good.size() / 2,
                                 good.size() - 8,
                                 good.size() - 1})
    EXPECT_NE(complaintOf(good.substr(0, size)), "") << size;
  EXPECT_NE(complaintOf(good.substr(0, good.size() / 2)).find("incomplete"),
            std::string::npos);
  EXPECT_NE(complaintOf(good + "x").find("bytes"), std::string::npos);
}

TEST_F(ScanFile, WithAnyBitFlippedIsRefused)
{
  const std::string good = scan().serialize();
  for (std::size_t byte = 0; byte < good.size(); byte += byte < 200 ? 1 : 997) {
    std::string flipped = good;
    flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << byte % 8));
    EXPECT_NE(complaintOf(flipped), "") << byte;
  }
}

TEST_F(ScanFile, OfAnotherKindOrVersionIsRefused)
{
  EXPECT_NE(complaintOf("# .PCD v0.7 - Point Cloud Data file format").find("no scan"),
            std::string::npos);
  std::string newer = scan().serialize();
  newer[8] = 3;
  EXPECT_NE(complaintOf(newer).find("format 3"), std::string::npos);
  std::string swapped = scan().serialize();
  std::reverse(swapped.begin() + 12, swapped.begin() + 16);
  EXPECT_NE(complaintOf(swapped).find("byte order"), std::string::npos);
}

TEST_F(ScanFile, ErrorsNameThePath)
{
  const auto complaint = [&](const auto& action) {
    try {
      action();
    }
    catch (const ScanFileError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string none = path("none.scan");
  EXPECT_EQ(complaint([&] { Scan::load(none); }).find(none + ": "), 0u);
  EXPECT_EQ(complaint([&] { Scan::load(folder_.string()); }).find(folder_.string()),
            0u);
  const std::string nowhere = path("no/such/folder.scan");
  EXPECT_EQ(complaint([&] { scan().save(nowhere); }).find(nowhere + ": "), 0u);
  std::ofstream(path("text.scan")) << "text";
  EXPECT_EQ(complaint([&] { Scan::load(path("text.scan")); }).find(path("text.scan")),
            0u);
}

} // namespace
} // namespace pcl_flashreg
