// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Features: kept as long as a pair needs them, and on disk.

#include "evaluate/features/correspondences.h"
#include "evaluate/features/feature_store.h"
#include "evaluate/features/truth.h"
#include "evaluate_support.h"
#include "io/file.h"
#include "support/whole_file.h"

namespace pcl_flashreg::evaluate {
namespace {

constexpr double LEAF = 0.2;

void
expectSame(const StoredScan& a, const StoredScan& b)
{
  EXPECT_TRUE(a.scan.serialize() == b.scan.serialize());
}

class EvaluateFeatures : public EvaluateTest {
protected:
  void
  SetUp() override
  {
    EvaluateTest::SetUp();
    writeFragments("room");
  }

  FeatureStore::Cloud
  describe(double leaf = LEAF) const
  {
    return FeatureStore(path(), leaf, 2, path("cache")).get("room/cloud_bin_0.pcd");
  }

  std::vector<fs::path>
  cached() const
  {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(path("cache")))
      files.push_back(entry.path());
    return files;
  }

  std::string
  bytes() const
  {
    return read("cache/" + cached().at(0).filename().string());
  }

  void
  overwrite(const std::string& text) const
  {
    write("cache/" + cached().at(0).filename().string(), text);
  }
};

TEST_F(EvaluateFeatures, areDroppedAfterTheLastPairThatNeedsThem)
{
  FeatureStore store(path(), LEAF, 2, "");
  Pair pair, self;
  pair.source = "room/cloud_bin_1.pcd";
  pair.target = self.source = self.target = "room/cloud_bin_0.pcd";
  for (const Pair& p : {pair, self})
    store.expect(p);
  const auto first = store.get(pair.target);
  store.get(pair.source);
  EXPECT_EQ(store.size(), 2u);
  store.release(pair);
  EXPECT_EQ(store.size(), 1u);
  EXPECT_EQ(store.get(self.source), first) << "computed again";
  store.release(self);
  EXPECT_EQ(store.size(), 0u);
}

TEST_F(EvaluateFeatures, comeBackFromTheCache)
{
  const auto computed = describe();
  ASSERT_GT(computed->scan.size(), 100u);
  ASSERT_EQ(cached().size(), 1u);
  const auto loaded = describe();
  expectSame(*computed, *loaded);
  // Even the time: it is what computing took, not what reading did.
  EXPECT_EQ(loaded->features_ms, computed->features_ms);
}

TEST_F(EvaluateFeatures, theCacheIsReallyRead)
{
  const auto computed = describe();
  // What is cached under the key of this cloud is believed: here, another cloud's.
  const std::string key = cached().at(0).filename().string();
  fs::copy_file(path("room/cloud_bin_1.pcd"),
                path("room/cloud_bin_0.pcd"),
                fs::copy_options::overwrite_existing);
  const auto other = describe();
  ASSERT_EQ(cached().size(), 2u) << "other points, other key";
  EXPECT_NE(other->scan.size(), computed->scan.size());
  for (const fs::path& file : cached())
    if (file.filename() != key)
      fs::copy_file(path("cache/" + key), file, fs::copy_options::overwrite_existing);
  expectSame(*describe(), *computed);
}

TEST_F(EvaluateFeatures, anotherLeafIsAnotherKey)
{
  const auto computed = describe();
  const auto coarser = describe(0.3);
  EXPECT_EQ(cached().size(), 2u);
  EXPECT_LT(coarser->scan.size(), computed->scan.size());
}

TEST_F(EvaluateFeatures, anotherWayToReadRawFilesIsAnotherKey)
{
  const io::Cloud cloud = io::readCloud(path("room/cloud_bin_0.pcd"));
  ASSERT_EQ(cloud.point_size, 3 * sizeof(float));
  // So many that they can be read as rows of four, too.
  const std::size_t size = cloud.size() / 4 * 4 * cloud.point_size;
  write("raw.bin", {cloud.data.data(), cloud.data.data() + size});
  const auto read = [&](std::size_t bin_fields) {
    return FeatureStore(path(), LEAF, 2, path("cache"), Descriptors::Native, bin_fields)
        .get("raw.bin");
  };
  const auto right = read(3);
  const auto wrong = read(4);
  EXPECT_EQ(cached().size(), 2u);
  EXPECT_NE(right->scan.size(), wrong->scan.size());
  expectSame(*right, *read(3));
}

TEST_F(EvaluateFeatures, damagedFilesAreComputedAgain)
{
  const auto computed = describe();
  const std::string good = bytes();
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 1);
  for (const std::string& damaged : {flipped,
                                     good.substr(0, good.size() - 100),
                                     good.substr(0, 5),
                                     std::string(),
                                     std::string("something else"),
                                     good + "more"}) {
    overwrite(damaged);
    expectSame(*describe(), *computed);
    EXPECT_EQ(bytes().size(), good.size()) << "is not mended";
  }
}

TEST_F(EvaluateFeatures, whatAKilledProcessLeftIsNoObstacle)
{
  describe();
  const std::string key = cached().at(0).filename().string();
  fs::remove(path("cache/" + key));
  write(partNameOf("cache/" + key), "half");
  describe();
  ASSERT_EQ(cached().size(), 1u);
  EXPECT_EQ(cached().at(0).filename().string(), key);
}

TEST_F(EvaluateFeatures, errorsNameTheFile)
{
  FeatureStore store(path(), 1e-30, 2, "");
  EXPECT_EQ(complaintOf([&] {
              store.get("room/cloud_bin_0.pcd");
            }).find(path("room/cloud_bin_0.pcd") + ": "),
            0u);
  EXPECT_NE(complaintOf([&] { store.get("room/none.pcd"); }).find("none.pcd"),
            std::string::npos);
  write("file", "x");
  EXPECT_NE(complaintOf([&] { FeatureStore(path(), 1, 1, path("file")); }).find("file"),
            std::string::npos);
}

class EvaluateTruth : public EvaluateTest {
protected:
  void
  SetUp() override
  {
    EvaluateTest::SetUp();
    const fs::path bundled = fs::path(PCL_FLASHREG_SOURCE_DIR) / "data/street";
    for (const char* name : {"source.pcd", "target.pcd"})
      fs::copy_file(bundled / name, folder_ / name);
    truth_ =
        io::parseFile((bundled / "T_target_source.txt").string(), io::parseTransform);
    pair_.source = "source.pcd";
    pair_.target = "target.pcd";
    pair_.refine_truth = true;
    // As far off as KITTI's poses are.
    pair_.T_target_source = truth_;
    pair_.T_target_source.translation += Eigen::Vector3d(0.12, -0.08, 0.05);
  }

  RigidTransform
  refine(const std::string& cache = "") const
  {
    return TruthStore(path(), cache).get(pair_);
  }

  RigidTransform truth_;
  Pair pair_;
};

TEST_F(EvaluateTruth, isRefinedWhereTheDataSetAsksForIt)
{
  const RigidTransform refined = refine();
  const double before = (pair_.T_target_source.translation - truth_.translation).norm();
  EXPECT_LT((refined.translation - truth_.translation).norm(), 0.3 * before);
  EXPECT_LT(made::rotationError(refined.rotation, truth_.rotation), 0.1);
  EXPECT_NEAR(refined.rotation.determinant(), 1, 1e-12);
  pair_.refine_truth = false;
  EXPECT_EQ(refine().translation, pair_.T_target_source.translation);
}

TEST_F(EvaluateTruth, isCachedAndNotBelievedWhenDamaged)
{
  fs::create_directories(path("cache"));
  const RigidTransform refined = refine(path("cache"));
  const fs::path file = fs::directory_iterator(path("cache"))->path();
  EXPECT_EQ(refine(path("cache")).translation, refined.translation);
  std::string text = io::readFile(file.string());
  const std::size_t last_digit = text.rfind("0 0 0 1") - 2;
  text[last_digit] = text[last_digit] == '7' ? '8' : '7';
  write("cache/" + file.filename().string(), text);
  EXPECT_EQ(refine(path("cache")).translation, refined.translation);
  EXPECT_NE(io::readFile(file.string()), text) << "is not mended";
}

TEST_F(EvaluateFeatures, correspondencesAreReadFromOneFileOrTwo)
{
  write("one.txt", "1 2 3 4 5 6\n7 8 9 10 11 12\n");
  write("two_src.txt", "1 2 3\n7 8 9\n");
  write("two_dst.txt", "4 5 6\n10 11 12\n");
  for (const char* name : {"one.txt", "two_{src,dst}.txt"}) {
    const Correspondences read = readCorrespondences(path(name));
    EXPECT_EQ(read.source, (std::vector<double>{1, 2, 3, 7, 8, 9}));
    EXPECT_EQ(read.target, (std::vector<double>{4, 5, 6, 10, 11, 12}));
    EXPECT_TRUE(read.ranks.empty());
  }
  const auto complaint = [&](const std::string& name) {
    return complaintOf([&] { readCorrespondences(path(name)); });
  };
  write("one.txt", "1 2 3 4 5 6\n7 8 nine 10 11 12\n");
  EXPECT_EQ(complaint("one.txt").find(path("one.txt") + ": line 2: "), 0u);
  write("one.txt", "1 2\n");
  EXPECT_EQ(complaint("one.txt").find(path("one.txt") + ": holds index pairs"), 0u);
  write("two_dst.txt", "4 5 6\n");
  EXPECT_EQ(complaint("two_{src,dst}.txt").find(path("two_{src,dst}.txt") + ": "), 0u);
}

} // namespace
} // namespace pcl_flashreg::evaluate
