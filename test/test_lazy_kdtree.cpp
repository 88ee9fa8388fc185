// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/lazy_kdtree.h>

#include <pcl/registration/registration.h>

#include <thread>

#include "pcl_fixtures.h"

using namespace pcl_flashreg;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Tree = LazyKdTree<pcl::PointXYZ>;

namespace {

struct Neighbors {
  pcl::Indices indices = pcl::Indices(1);
  std::vector<float> squared_distances = std::vector<float>(1);
};

Cloud::Ptr
room()
{
  return made::RoomPairXYZ().target;
}

/** \brief What pcl::Registration does by itself. */
class DoesNothing : public pcl::Registration<pcl::PointXYZ, pcl::PointXYZ> {
  void
  computeTransformation(Cloud&, const Matrix4&) override
  {
  }
};

} // namespace

TEST(LazyKdTree, IsBuiltByTheFirstQuery)
{
  Tree tree;
  tree.setInputCloud(room());
  EXPECT_FALSE(tree.isBuilt());
  Neighbors found;
  EXPECT_EQ(tree.nearestKSearch(
                pcl::PointXYZ(1, 1, 1), 1, found.indices, found.squared_distances),
            1);
  EXPECT_TRUE(tree.isBuilt());
  tree.setInputCloud(room());
  EXPECT_FALSE(tree.isBuilt());
}

TEST(LazyKdTree, FindsWhatPclsTreeFinds)
{
  const auto cloud = room();
  const pcl::IndicesPtr every_third(new pcl::Indices);
  for (std::size_t i = 0; i < cloud->size(); i += 3)
    every_third->push_back(static_cast<pcl::index_t>(i));
  for (const auto& indices : {pcl::IndicesPtr(), every_third}) {
    Tree lazy;
    pcl::search::KdTree<pcl::PointXYZ> reference;
    lazy.setInputCloud(cloud, indices);
    reference.setInputCloud(cloud, indices);
    Neighbors a, b;
    for (std::size_t i = 0; i < cloud->size(); i += 97) {
      EXPECT_EQ(
          lazy.nearestKSearch((*cloud)[i], 5, a.indices, a.squared_distances),
          reference.nearestKSearch((*cloud)[i], 5, b.indices, b.squared_distances));
      EXPECT_EQ(a.indices, b.indices);
      EXPECT_EQ(
          lazy.radiusSearch((*cloud)[i], 0.2, a.indices, a.squared_distances),
          reference.radiusSearch((*cloud)[i], 0.2, b.indices, b.squared_distances));
      EXPECT_EQ(a.indices, b.indices);
    }
  }
}

TEST(LazyKdTree, RadiusSearchBuildsToo)
{
  Tree tree;
  tree.setInputCloud(room());
  Neighbors found;
  EXPECT_GT(tree.radiusSearch(
                pcl::PointXYZ(1, 1, 0), 0.5, found.indices, found.squared_distances),
            0);
}

TEST(LazyKdTree, SearchesByIndexAndThroughTheBaseClass)
{
  const auto cloud = room();
  const Tree::Ptr tree(new Tree);
  const pcl::search::Search<pcl::PointXYZ>::Ptr base = tree;
  base->setInputCloud(cloud);
  EXPECT_FALSE(tree->isBuilt());
  EXPECT_EQ(base->getInputCloud(), cloud);
  Neighbors found;
  ASSERT_EQ(base->nearestKSearch(7, 1, found.indices, found.squared_distances), 1);
  EXPECT_EQ(found.indices[0], 7);
  ASSERT_EQ(base->nearestKSearch(*cloud, 8, 1, found.indices, found.squared_distances),
            1);
  EXPECT_EQ(found.indices[0], 8);
}

TEST(LazyKdTree, HasNoNeighboursForAPointThatIsNotFinite)
{
  Tree tree;
  tree.setInputCloud(room());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Neighbors found;
  EXPECT_EQ(tree.nearestKSearch(
                pcl::PointXYZ(nan, 0, 0), 1, found.indices, found.squared_distances),
            0);
  ASSERT_EQ(found.squared_distances.size(), 1u);
  EXPECT_TRUE(std::isinf(found.squared_distances[0]));
  EXPECT_EQ(tree.radiusSearch(
                pcl::PointXYZ(0, nan, 0), 1, found.indices, found.squared_distances),
            0);
}

TEST(LazyKdTree, WithoutAPointHasNoNeighbours)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Cloud::Ptr all_nan(new Cloud(10, 1, pcl::PointXYZ(nan, nan, nan)));
  for (const auto& cloud : {Cloud::Ptr(), Cloud::Ptr(new Cloud), all_nan}) {
    Tree tree;
    tree.setInputCloud(cloud);
    Neighbors found;
    EXPECT_EQ(tree.nearestKSearch(
                  pcl::PointXYZ(0, 0, 0), 1, found.indices, found.squared_distances),
              0);
    EXPECT_EQ(tree.radiusSearch(
                  pcl::PointXYZ(0, 0, 0), 1, found.indices, found.squared_distances),
              0);
  }
}

TEST(LazyKdTree, IsBuiltOnceByManyThreads)
{
  const auto cloud = room();
  Tree tree;
  tree.setInputCloud(cloud);
  std::vector<pcl::Indices> nearest(4);
  std::vector<std::thread> threads;
  for (auto& own : nearest)
    threads.emplace_back([&tree, &cloud, &own] {
      Neighbors found;
      for (std::size_t i = 0; i < cloud->size(); i += 31) {
        tree.nearestKSearch((*cloud)[i], 1, found.indices, found.squared_distances);
        own.push_back(found.indices[0]);
      }
    });
  for (auto& thread : threads)
    thread.join();
  for (std::size_t i = 0; i < nearest[0].size(); ++i)
    EXPECT_EQ(nearest[0][i], static_cast<pcl::index_t>(31 * i));
  for (const auto& other : nearest)
    EXPECT_EQ(other, nearest[0]);
}

TEST(LazyKdTree, IsLeftAloneByAlignAndServesTheFitnessScore)
{
  const auto cloud = room();
  const Cloud::Ptr shifted(new Cloud(*cloud));
  for (auto& point : *shifted)
    point.z += 0.001f;
  made::spoil(*shifted, 3);
  DoesNothing registration;
  const Tree::Ptr tree(new Tree);
  registration.setSearchMethodTarget(tree);
  registration.setInputSource(shifted);
  registration.setInputTarget(cloud);
  Cloud aligned;
  registration.align(aligned);
  EXPECT_FALSE(tree->isBuilt());
  EXPECT_NEAR(registration.getFitnessScore(), 1e-6, 1e-7);
  EXPECT_TRUE(tree->isBuilt());
}
