// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/lazy_kdtree.h>

#include <pcl/registration/registration.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
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

/** \brief Some points many times, before, among and behind the others. */
Cloud::Ptr
roomWithCopies(std::size_t copies)
{
  const Cloud::Ptr cloud = room();
  const pcl::PointXYZ some[] = {
      (*cloud)[5], (*cloud)[70], {0, 0, 0}, {-0.0f, 0, -0.0f}};
  for (std::size_t i = 0; i < copies; ++i) {
    const auto at = static_cast<std::ptrdiff_t>(i * (cloud->size() - 1) / copies);
    cloud->insert(cloud->begin() + at, std::begin(some), std::end(some));
  }
  made::spoil(*cloud, 40);
  return cloud;
}

/** \brief Shows how many points the tree inside was given. */
class OpenTree : public Tree {
public:
  std::size_t
  held() const
  {
    return tree_->getIndices() ? tree_->getIndices()->size()
                               : tree_->getInputCloud()->size();
  }
};

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

TEST(LazyKdTree, FindsEqualPointsAsPclsTreeDoes)
{
  const auto cloud = roomWithCopies(60);
  const pcl::IndicesPtr some_twice(new pcl::Indices);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    for (std::size_t times = 0; times < (i % 5 + 1) / 2; ++times)
      some_twice->push_back(static_cast<pcl::index_t>(i));
  for (const bool sorted : {true, false})
    for (const auto& indices : {pcl::IndicesPtr(), some_twice}) {
      Tree lazy(sorted);
      pcl::search::KdTree<pcl::PointXYZ> reference(sorted);
      lazy.setInputCloud(cloud, indices);
      reference.setInputCloud(cloud, indices);
      const auto expect_same = [](Neighbors a, Neighbors b) {
        std::sort(a.squared_distances.begin(), a.squared_distances.end());
        std::sort(b.squared_distances.begin(), b.squared_distances.end());
        EXPECT_EQ(a.squared_distances, b.squared_distances);
        EXPECT_EQ(a.indices.size(), a.squared_distances.size());
      };
      for (std::size_t i = 0; i < cloud->size(); i += 97) {
        const pcl::PointXYZ& query = (*cloud)[i];
        Neighbors a, b;
        for (const int k : {1, 5, 100, 1000000}) {
          EXPECT_EQ(lazy.nearestKSearch(query, k, a.indices, a.squared_distances),
                    reference.nearestKSearch(query, k, b.indices, b.squared_distances));
          expect_same(a, b);
          EXPECT_TRUE(
              std::is_sorted(a.squared_distances.begin(), a.squared_distances.end()));
        }
        for (const unsigned most : {0u, 1u, 7u, 200u}) {
          EXPECT_EQ(
              lazy.radiusSearch(query, 0.2, a.indices, a.squared_distances, most),
              reference.radiusSearch(query, 0.2, b.indices, b.squared_distances, most));
          expect_same(a, b);
          std::sort(a.indices.begin(), a.indices.end());
          std::sort(b.indices.begin(), b.indices.end());
          EXPECT_TRUE(most > 0 || a.indices == b.indices);
        }
      }
    }
}

TEST(LazyKdTree, EqualPointsComeInTheirOrder)
{
  const Cloud::Ptr cloud(new Cloud(9, 1, pcl::PointXYZ(1, 2, 3)));
  for (const std::size_t other : {0, 4, 8})
    (*cloud)[other].x = static_cast<float>(10 + other);
  Tree tree;
  tree.setInputCloud(cloud);
  Neighbors found;
  EXPECT_EQ(tree.nearestKSearch(
                pcl::PointXYZ(1, 2, 4), 7, found.indices, found.squared_distances),
            7);
  EXPECT_EQ(found.indices, (pcl::Indices{1, 2, 3, 5, 6, 7, 0}));
  EXPECT_EQ(tree.nearestKSearch(
                pcl::PointXYZ(1, 2, 4), 4, found.indices, found.squared_distances),
            4);
  EXPECT_EQ(found.indices, (pcl::Indices{1, 2, 3, 5}));
  EXPECT_EQ(found.squared_distances, std::vector<float>(4, 1));
}

TEST(LazyKdTree, HoldsEqualPointsOnce)
{
  const auto without = roomWithCopies(0), with = roomWithCopies(500);
  OpenTree tree;
  Neighbors found;
  for (const auto& cloud : {without, with, without}) {
    tree.setInputCloud(cloud);
    tree.nearestKSearch(
        pcl::PointXYZ(1, 1, 1), 1, found.indices, found.squared_distances);
    std::set<std::array<float, 3>> places;
    for (const auto& point : *cloud)
      if (pcl::isXYZFinite(point))
        places.insert({point.x, point.y, point.z});
    EXPECT_EQ(tree.held(), places.size() + (cloud == without ? 1 : 0));
    EXPECT_LT(places.size(), without->size() + 2);
  }
  EXPECT_EQ(
      tree.nearestKSearch((*without)[7], 1, found.indices, found.squared_distances), 1);
  EXPECT_EQ(found.indices[0], 7);
}

TEST(LazyKdTree, PointsAreEqualWhereTheirRepresentationIs)
{
  /** \brief Tells points apart by their intensity, too. */
  struct WithIntensity : pcl::PointRepresentation<pcl::PointXYZI> {
    WithIntensity()
    {
      nr_dimensions_ = 4;
    }
    void
    copyToFloatArray(const pcl::PointXYZI& point, float* out) const override
    {
      std::copy_n(point.data, 3, out);
      out[3] = point.intensity;
    }
  };
  const pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  for (int i = 0; i < 40; ++i) {
    pcl::PointXYZI point;
    point.getVector3fMap().setOnes();
    point.intensity = static_cast<float>(i % 20);
    cloud->push_back(point);
  }
  LazyKdTree<pcl::PointXYZI> tree;
  tree.setPointRepresentation(pcl::shared_ptr<WithIntensity>(new WithIntensity));
  tree.setInputCloud(cloud);
  Neighbors found;
  EXPECT_EQ(
      tree.nearestKSearch((*cloud)[13], 2, found.indices, found.squared_distances), 2);
  EXPECT_EQ(found.indices, (pcl::Indices{13, 33}));
  EXPECT_EQ(found.squared_distances, (std::vector<float>{0, 0}));
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
