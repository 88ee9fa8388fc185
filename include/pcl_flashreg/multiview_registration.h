// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/pair_registration.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pcl_flashreg {

/** \brief One way in which two scans may lie to each other. */
struct RelativePose {
  RigidTransform T_target_source;
  /** \brief That it is the right one, by these two scans alone; in [0, 1]. */
  double probability = 0;
  /** \brief Correspondences that agree. */
  int inliers = 0;
};

/** \brief What two scans say of each other. Asked the other way round, with source and target
 * exchanged, they may say something else: where both ways were asked, they speak with half
 * their voice each. */
struct ScanRelation {
  /** \brief Numbers of the scans. */
  std::size_t source = 0, target = 0;
  /** \brief The most probable first: rivals of a wrong one may be right. Empty where none was
   * found. */
  std::vector<RelativePose> poses;
  /** \brief Evidence::overruled_viewpoints of the first. */
  bool overruled_viewpoints = false;
};

/** \brief What became of what two scans say. */
enum class EdgeFate {
  /** \brief It agrees with the map, and is part of it. */
  Used,
  /** \brief The map says otherwise, or that the scans don't overlap. */
  Disagrees,
  /** \brief A scan of them is not placed, or both are in different groups. */
  Apart
};

/** \brief Two scans and how they lie to each other. */
struct MapEdge {
  std::size_t source = 0, target = 0;
  EdgeFate fate = EdgeFate::Apart;
  /** \brief By these two scans alone: on the surfaces, if the edge is used; the most probable
   * pose, if it is not. */
  RigidTransform T_target_source;
  /** \brief That this pose is right, by these two scans alone. */
  double pair_confidence = 0;
  /** \brief The same, given the map; 0 unless the edge is used. */
  double confidence = 0;
  /** \brief Of a used edge: the two clouds under the map's poses. */
  CloudAgreement agreement;
  /** \brief Between this pose and the map's: an angle in radians, and a length at the middle
   * of what the scans share; 0 unless they are in one group. */
  double rotation_residual = 0, translation_residual = 0;
  /** \brief As Result::information, from the surfaces that touch; zero unless the edge is
   * used. */
  InformationMatrix information = InformationMatrix::Zero();
};

/** \brief Where a scan is. */
struct ScanPlace {
  /** \brief Scans of one group are in one frame, that of its first scan. A scan that nothing
   * ties to another is a group of its own. */
  std::size_t group = 0;
  /** \brief T_group_scan: group = rotation * scan + translation. */
  RigidTransform T_group_scan;
  /** \brief That it is right within its group; 0 where that has no other scan. */
  double confidence = 0;
  /** \brief Used edges that end here. */
  std::size_t edges = 0;
};

struct MultiviewTimings {
  /** \brief Milliseconds. */
  double relations = 0, grouping = 0, refinement = 0, total = 0;
};

struct MultiviewResult {
  /** \brief One a scan, in their order. */
  std::vector<ScanPlace> scans;
  /** \brief Numbers of the scans of each group, ascending; the largest group first, of
   * equally large ones the one with the smallest number. */
  std::vector<std::vector<std::size_t>> groups;
  /** \brief One for every pair that was found to have a pose, by target and source; the target has
   * the smaller number. */
  std::vector<MapEdge> edges;
  MultiviewTimings timings;

  /** \brief Scans that are in a group with others. */
  std::size_t
  placed() const;
};

/** \brief How many scans are registered with each other. */
struct MultiviewOptions {
  /** \brief Of each pair. */
  PairOptions pair;
  /** \brief Groups are joined if it is at least as certain as this how they lie to each other;
   * (0, 1). A scan of the finished map remains in it if it is in no more than twice that
   * doubt. */
  double min_confidence = 0.9;
  /** \brief Each scan is tried with so many others at first, those that are most like it by their
   * descriptors; >= 1. */
  std::size_t alike = 12;
  /** \brief Up to so many scans, all pairs of scans that the map does not tie to each other are
   * tried after that; of more, as many again, and of those that are alone four times as
   * many. */
  std::size_t all_pairs_up_to = 150;
  /** \brief Whether the scans are in the order in which they were made: each is tried with the
   * next few in any case. */
  bool sequence = false;
  /** \brief Called after each pair, by one thread at a time, in any order, with how many of
   * all are done; what it throws ends the registration. */
  std::function<void(const ScanRelation&, std::size_t done, std::size_t all)>
      on_relation;
};

/** \brief Registers any number of scans with each other, in any order, without odometry or
 * guess: multiway registration.
 *
 * Pairs are registered, those first that look alike, and each keeps its rivals. Groups of
 * scans then grow together where pairs vouch for each other and the clouds of both groups,
 * all of them, agree; poses come from a graph of all pairs that agree with the map. What is
 * not tied then is tried with all others (docs/method.md).
 *
 * The same result to the last bit on any number of threads; the order of the scans is that of
 * their numbers.
 */
class PCL_FLASHREG_EXPORT MultiviewRegistration {
public:
  /** \brief Hands out a scan by its number; called by several threads at a time. Scans need
   * not be in memory, but each call for one has to return the same. */
  using ScanSource = std::function<Scan(std::size_t)>;
  /** \brief Numbers of a target and a source. */
  using ScanPair = std::pair<std::size_t, std::size_t>;
  /** \brief Registers pairs of scans, as relate() does, or knows from elsewhere what they say
   * of each other: a file, other processes. What it throws ends the registration. */
  using Relate = std::function<std::vector<ScanRelation>(const std::vector<ScanPair>&)>;

  /** \param[in] num_threads 0 takes as many as there are processors
   * \throws BackendError, std::invalid_argument as PairRegistration */
  explicit MultiviewRegistration(BackendKind backend = BackendKind::Auto,
                                 unsigned num_threads = 0);
  ~MultiviewRegistration();
  MultiviewRegistration(MultiviewRegistration&&) noexcept;
  MultiviewRegistration&
  operator=(MultiviewRegistration&&) noexcept;

  /** \brief All pairs of so many scans: targets and sources. */
  static std::vector<ScanPair>
  allPairs(std::size_t scans);

  /** \brief Registers pairs, one a thread.
   * \return in the order of the pairs
   * \throws std::invalid_argument if an option is out of range */
  std::vector<ScanRelation>
  relate(const ScanSource& scans,
         const std::vector<ScanPair>& pairs,
         const MultiviewOptions& options = {});

  /** \brief From relations to the map. Scans have keypoints and normals; descriptors are not
   * needed any more.
   * \param[in] count number of scans
   * \throws std::invalid_argument if an option is out of range, if a relation names a scan
   * that is none, or if two are of the same source and target */
  MultiviewResult
  place(std::size_t count,
        const ScanSource& scans,
        const std::vector<ScanRelation>& relations,
        const MultiviewOptions& options = {});

  /** \brief All of it: in rounds, each of pairs that the map so far does not tie to each
   * other.
   * \param[in] count number of scans
   * \param[in] relate called once a round, by the thread that calls this
   * \throws std::invalid_argument if an option is out of range, or as place() for what relate
   * returns */
  MultiviewResult
  align(std::size_t count,
        const ScanSource& scans,
        const Relate& relate,
        const MultiviewOptions& options = {});

  /** \brief All of it, with relate(). */
  MultiviewResult
  align(const std::vector<Scan>& scans, const MultiviewOptions& options = {});

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace pcl_flashreg
