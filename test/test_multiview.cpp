// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// MultiviewRegistration: a hall from six places and a room from two, mixed.

#include "support/made_hall_scans.h"
#include "support/made_scans.h"

#include <pcl_flashreg/multiview_registration.h>

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

namespace pcl_flashreg {
namespace {

constexpr double RESOLUTION = made::HallScans::RESOLUTION;

/** \brief The hall's scans, then the room's target and source. */
struct Mixture {
  static constexpr std::size_t HALL = 6, ROOM = 2;

  made::HallScans hall{false};
  made::RoomScans room;
  std::vector<Scan> scans;

  Mixture()
  {
    PairRegistration registration(BackendKind::Cpu, 2);
    for (const auto& points : hall.scans) {
      ScanInput<double> input;
      input.points.data = points.front().data();
      input.points.size = points.size();
      input.viewpoint_known = true;
      scans.push_back(registration.makeScan(input, RESOLUTION));
    }
    scans.push_back(registration.makeScan(room.targetInput(), RESOLUTION));
    scans.push_back(registration.makeScan(room.sourceInput(), RESOLUTION));
  }

  std::vector<Scan>
  ofHall() const
  {
    return {scans.begin(), scans.begin() + HALL};
  }

  MultiviewRegistration::ScanSource
  source() const
  {
    return [this](std::size_t i) { return scans[i]; };
  }
};

const Mixture&
mixture()
{
  static const Mixture mixture;
  return mixture;
}

/** \brief All pairs, once for all tests. */
const std::vector<ScanRelation>&
relations()
{
  static const std::vector<ScanRelation> all =
      MultiviewRegistration(BackendKind::Cpu, 2)
          .relate(mixture().source(),
                  MultiviewRegistration::allPairs(mixture().scans.size()));
  return all;
}

MultiviewResult
place(const std::vector<ScanRelation>& of, unsigned threads = 2)
{
  return MultiviewRegistration(BackendKind::Cpu, threads)
      .place(mixture().scans.size(), mixture().source(), of);
}

std::vector<ScanRelation>
without(const std::vector<ScanRelation>& all, std::size_t scan)
{
  std::vector<ScanRelation> kept;
  for (const ScanRelation& relation : all)
    if (relation.source != scan && relation.target != scan)
      kept.push_back(relation);
  return kept;
}

Eigen::Isometry3d
between(const MultiviewResult& result, std::size_t target, std::size_t source)
{
  return result.scans[target].T_group_scan.toIsometry().inverse() *
         result.scans[source].T_group_scan.toIsometry();
}

const MapEdge*
edgeOf(const MultiviewResult& result, std::size_t target, std::size_t source)
{
  for (const MapEdge& edge : result.edges)
    if (edge.target == target && edge.source == source)
      return &edge;
  return nullptr;
}

/** \brief Every bit of where the scans are. */
bool
samePlaces(const MultiviewResult& a, const MultiviewResult& b)
{
  if (a.scans.size() != b.scans.size())
    return false;
  for (std::size_t i = 0; i < a.scans.size(); ++i) {
    const ScanPlace &x = a.scans[i], &y = b.scans[i];
    if (x.group != y.group || x.confidence != y.confidence || x.edges != y.edges ||
        x.T_group_scan.rotation != y.T_group_scan.rotation ||
        x.T_group_scan.translation != y.T_group_scan.translation)
      return false;
  }
  return true;
}

TEST(Multiview, TwoPlacesComeBackAsTwoGroups)
{
  const MultiviewResult result = place(relations());
  ASSERT_EQ(result.groups.size(), 2u);
  EXPECT_EQ(result.groups[0], (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(result.groups[1], (std::vector<std::size_t>{6, 7}));
  EXPECT_EQ(result.placed(), mixture().scans.size());
  for (std::size_t target = 0; target < Mixture::HALL; ++target)
    for (std::size_t source = 0; source < Mixture::HALL; ++source)
      EXPECT_LT(mixture().hall.error(between(result, target, source), target, source),
                RESOLUTION / 2);
  const Eigen::Isometry3d off =
      between(result, 6, 7) * mixture().room.T_target_source.inverse();
  EXPECT_LT(off.translation().norm(), RESOLUTION);
  for (const ScanPlace& scan : result.scans)
    EXPECT_GT(scan.confidence, 0.9);
}

TEST(Multiview, EachGroupIsInTheFrameOfItsFirstScan)
{
  const MultiviewResult result = place(relations());
  for (const std::vector<std::size_t>& group : result.groups) {
    const RigidTransform& first = result.scans[group.front()].T_group_scan;
    EXPECT_TRUE(first.rotation.isIdentity(1e-12));
    EXPECT_LT(first.translation.norm(), 1e-12);
  }
}

TEST(Multiview, TheThreadsMakeNoDifference)
{
  EXPECT_TRUE(samePlaces(place(relations(), 1), place(relations(), 3)));
  const auto relate = [](unsigned threads) {
    return MultiviewRegistration(BackendKind::Cpu, threads)
        .relate(mixture().source(), {{0, 1}, {2, 5}, {6, 7}});
  };
  const auto one = relate(1), three = relate(3);
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].poses.size(), three[i].poses.size());
    for (std::size_t k = 0; k < one[i].poses.size(); ++k) {
      EXPECT_EQ(one[i].poses[k].probability, three[i].poses[k].probability);
      EXPECT_EQ(one[i].poses[k].T_target_source.rotation,
                three[i].poses[k].T_target_source.rotation);
    }
  }
}

TEST(Multiview, TheOrderOfTheRelationsMakesNoDifference)
{
  std::vector<ScanRelation> reversed = relations();
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_TRUE(samePlaces(place(relations()), place(reversed)));
}

TEST(Multiview, AScanThatNothingIsKnownOfStaysAlone)
{
  const MultiviewResult result = place(without(relations(), 3));
  EXPECT_EQ(result.placed(), mixture().scans.size() - 1);
  EXPECT_EQ(result.scans[3].confidence, 0);
  EXPECT_EQ(result.scans[3].edges, 0u);
  EXPECT_EQ(result.groups.back(), (std::vector<std::size_t>{3}));
}

/** \brief A pair that is certain of a wrong pose changes nothing, and is named. */
TEST(Multiview, ACertainButWrongPairIsOverruled)
{
  std::vector<ScanRelation> misled = relations();
  for (ScanRelation& relation : misled)
    if (relation.target == 0 && relation.source == 4) {
      RelativePose wrong = relation.poses.front();
      wrong.T_target_source.translation += Eigen::Vector3d(1.5, -0.5, 0.3);
      wrong.probability = 0.9995;
      relation.poses = {wrong};
    }
  const MultiviewResult result = place(misled);
  ASSERT_EQ(result.groups.front().size(), Mixture::HALL);
  EXPECT_LT(mixture().hall.error(between(result, 0, 4), 0, 4), RESOLUTION / 2);
  const MapEdge* edge = edgeOf(result, 0, 4);
  ASSERT_TRUE(edge);
  // What the surfaces say is used in its place; nobody but the map vouches for it.
  EXPECT_TRUE(edge->fate == EdgeFate::Disagrees || edge->pair_confidence == 0);
}

/** \brief The right pose is the second most probable of its pair. */
TEST(Multiview, ARivalThatOthersVouchForBeatsTheWinner)
{
  std::vector<ScanRelation> misled = relations();
  for (ScanRelation& relation : misled)
    if (relation.source == 5 || relation.target == 5)
      for (const RelativePose right = relation.poses.empty() ? RelativePose()
                                                             : relation.poses.front();
           relation.poses.size() != 2;) {
        RelativePose wrong = right;
        wrong.T_target_source.translation +=
            Eigen::Vector3d(1 + 0.5 * static_cast<double>(relation.target), 0.7, -0.2);
        wrong.probability = 0.5;
        relation.poses = {wrong, right};
        relation.poses[1].probability = 0.25;
      }
  const MultiviewResult result = place(without(misled, 6));
  ASSERT_EQ(result.groups.front().size(), Mixture::HALL);
  EXPECT_LT(mixture().hall.error(between(result, 0, 5), 0, 5), RESOLUTION / 2);
}

TEST(Multiview, EdgesAcrossGroupsAreApart)
{
  const MultiviewResult result = place(relations());
  std::size_t used = 0;
  for (const MapEdge& edge : result.edges) {
    EXPECT_LT(edge.target, edge.source);
    const bool together =
        result.scans[edge.target].group == result.scans[edge.source].group;
    EXPECT_EQ(edge.fate == EdgeFate::Apart, !together);
    if (edge.fate == EdgeFate::Used) {
      ++used;
      EXPECT_GT(edge.agreement.matched, 0);
      EXPECT_LT(edge.translation_residual, RESOLUTION);
      EXPECT_GE(edge.confidence, 0.9);
    }
  }
  EXPECT_GE(used, Mixture::HALL + Mixture::ROOM - 2);
}

/** \brief Turning the target by a small angle about its origin moves the far end of what
 * touches; the quadratic form of the information is that of the points, wherever the origin
 * of the target's frame is. */
TEST(Multiview, InformationIsAboutTheOriginOfTheTarget)
{
  const MultiviewResult result = place(relations());
  for (const MapEdge& edge : result.edges) {
    if (edge.fate != EdgeFate::Used)
      continue;
    EXPECT_TRUE(edge.information.isApprox(edge.information.transpose(), 1e-9));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(
        edge.information, Eigen::EigenvaluesOnly);
    EXPECT_GT(solver.eigenvalues().minCoeff(), 0);
    // A motion that turns about a point of the scene, not the origin, is held less than one
    // that moves all of the scene by the same way as its far end.
    Eigen::Matrix<double, 6, 1> shift = Eigen::Matrix<double, 6, 1>::Zero();
    shift.tail<3>() << 0, 0, 0.01;
    EXPECT_GT(shift.dot(edge.information * shift), 0.01);
  }
}

/** \brief The pairs that are asked for, round by round, until there are no more. */
std::vector<std::vector<MultiviewRegistration::ScanPair>>
roundsOf(const MultiviewOptions& options, MultiviewResult* map = nullptr)
{
  MultiviewRegistration registration(BackendKind::Cpu, 2);
  std::vector<std::vector<MultiviewRegistration::ScanPair>> rounds;
  const auto relate = [&](const std::vector<MultiviewRegistration::ScanPair>& pairs) {
    rounds.push_back(pairs);
    return registration.relate(mixture().source(), pairs, options);
  };
  const MultiviewResult result =
      registration.align(mixture().scans.size(), mixture().source(), relate, options);
  if (map)
    *map = result;
  return rounds;
}

TEST(Multiview, PairsAreTriedInRounds)
{
  MultiviewOptions options;
  options.alike = 2;
  MultiviewResult map;
  const auto rounds = roundsOf(options, &map);
  ASSERT_GE(rounds.size(), 2u);
  const auto& first = rounds.front();
  EXPECT_GE(first.size(), mixture().scans.size());
  EXPECT_LT(first.size(), 2 * mixture().scans.size() + 1);
  EXPECT_TRUE(std::is_sorted(first.begin(), first.end()));
  // The room looks like itself.
  EXPECT_EQ(std::count(first.begin(), first.end(), std::pair(6ul, 7ul)), 1);

  // No pair twice; what is asked the other way round was asked before.
  std::set<MultiviewRegistration::ScanPair> asked;
  for (const auto& round : rounds)
    for (const auto& [target, source] : round) {
      EXPECT_TRUE(asked.insert({target, source}).second);
      if (target > source) {
        EXPECT_EQ(asked.count({source, target}), 1u);
      }
    }
  // Of few scans, all pairs that the map does not tie.
  for (const auto& [target, source] :
       MultiviewRegistration::allPairs(mixture().scans.size()))
    if (map.scans[target].group != map.scans[source].group) {
      EXPECT_EQ(asked.count({target, source}), 1u) << target << ' ' << source;
    }
}

TEST(Multiview, OfManyScansFewPairsAreTried)
{
  MultiviewOptions options;
  options.alike = 1;
  options.all_pairs_up_to = 3;
  std::vector<std::size_t> tries(mixture().scans.size());
  for (const auto& round : roundsOf(options)) {
    EXPECT_LE(round.size(), mixture().scans.size());
    for (const auto& [target, source] : round)
      if (target < source) {
        ++tries[target];
        ++tries[source];
      }
  }
  EXPECT_LT(*std::max_element(tries.begin(), tries.end()), tries.size() - 1);
}

TEST(Multiview, OfASequenceNeighboursAreTried)
{
  MultiviewOptions options;
  options.alike = 1;
  options.sequence = true;
  const auto pairs = roundsOf(options).front();
  for (std::size_t i = 0; i + 1 < mixture().scans.size(); ++i)
    EXPECT_EQ(std::count(pairs.begin(), pairs.end(), std::pair(i, i + 1)), 1) << i;
}

TEST(Multiview, WhatTheRelatingThrowsEndsIt)
{
  struct Enough {};
  MultiviewRegistration registration(BackendKind::Cpu, 2);
  const auto relate = [](const auto&) -> std::vector<ScanRelation> { throw Enough(); };
  EXPECT_THROW(registration.align(2, mixture().source(), relate), Enough);
  // It is of use after that.
  EXPECT_EQ(registration.align({mixture().scans[6], mixture().scans[7]}).placed(), 2u);
}

TEST(Multiview, AlignDoesItAll)
{
  MultiviewRegistration registration(BackendKind::Cpu, 2);
  std::size_t reported = 0;
  MultiviewOptions options;
  options.on_relation = [&](const ScanRelation&, std::size_t done, std::size_t all) {
    EXPECT_LE(done, all);
    ++reported;
  };
  const MultiviewResult result = registration.align(mixture().ofHall(), options);
  EXPECT_EQ(result.groups.size(), 1u);
  EXPECT_EQ(reported, Mixture::HALL * (Mixture::HALL - 1) / 2);
  EXPECT_LT(mixture().hall.error(between(result, 0, 3), 0, 3), RESOLUTION / 2);
}

TEST(Multiview, FewScansAreNoProblem)
{
  MultiviewRegistration registration(BackendKind::Cpu, 2);
  EXPECT_TRUE(registration.align({}).scans.empty());
  const MultiviewResult one = registration.align({mixture().scans[0]});
  EXPECT_EQ(one.groups.size(), 1u);
  EXPECT_EQ(one.placed(), 0u);
  const MultiviewResult two =
      registration.align({mixture().scans[6], mixture().scans[7]});
  EXPECT_EQ(two.placed(), 2u);
  EXPECT_EQ(two.edges.size(), 1u);
  const MultiviewResult empty = registration.align({Scan(), mixture().scans[7]});
  EXPECT_EQ(empty.placed(), 0u);
  EXPECT_EQ(empty.groups.size(), 2u);
}

TEST(Multiview, WhatCantBeIsSaid)
{
  MultiviewRegistration registration(BackendKind::Cpu, 1);
  const auto place = [&](const std::vector<ScanRelation>& of,
                         const MultiviewOptions& options = {}) {
    return registration.place(2, mixture().source(), of, options);
  };
  const auto relation = [](std::size_t target, std::size_t source) {
    ScanRelation r;
    r.target = target;
    r.source = source;
    return r;
  };
  EXPECT_THROW(place({relation(0, 0)}), std::invalid_argument);
  EXPECT_THROW(place({relation(0, 2)}), std::invalid_argument);
  EXPECT_THROW(place({relation(0, 1), relation(0, 1)}), std::invalid_argument);
  EXPECT_NO_THROW(place({relation(0, 1), relation(1, 0)}));
  MultiviewOptions options;
  for (const double confidence : {0.0, 1.0, -1.0, std::nan("")}) {
    options.min_confidence = confidence;
    EXPECT_THROW(place({}, options), std::invalid_argument) << confidence;
  }
  options = {};
  options.alike = 0;
  EXPECT_THROW(registration.align(mixture().ofHall(), options), std::invalid_argument);
}

/** \brief Pairs that overlap are found as well, and what does not is certain of nothing. */
TEST(Multiview, GivingUpEarlyLosesNoPair)
{
  PairRegistration registration(BackendKind::Cpu, 2);
  PairOptions hasty;
  hasty.give_up_early = true;
  const auto& scans = mixture().scans;
  const PairResult slow = registration.align(scans[1], scans[0]);
  const PairResult fast = registration.align(scans[1], scans[0], hasty);
  ASSERT_TRUE(slow.pose.converged);
  EXPECT_EQ(slow.pose.confidence, fast.pose.confidence);
  EXPECT_EQ(slow.pose.T_target_source.translation,
            fast.pose.T_target_source.translation);
  EXPECT_FALSE(registration.align(scans[6], scans[2], hasty).pose.converged);
}

} // namespace
} // namespace pcl_flashreg
