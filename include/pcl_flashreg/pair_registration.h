// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/estimator.h>
#include <pcl_flashreg/feature_extractor.h>
#include <pcl_flashreg/feature_matching.h>
#include <pcl_flashreg/scan.h>
#include <pcl_flashreg/scan_index.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace pcl_flashreg {

/** \brief The steps of a registration, in their order. */
enum class PairStep {
  /** \brief Finding a resolution, where none is given. */
  Resolution,
  SourceScan,
  TargetScan,
  Matching,
  /** \brief From correspondences to the pose and the verdict. */
  Estimation
};

/** \brief What is known when a step begins. */
struct PairProgress {
  PairStep step = PairStep::Resolution;
  /** \brief 0 as long as it is not known. */
  double resolution = 0;
  std::size_t source_keypoints = 0, target_keypoints = 0;
  /** \brief Known before the last step. */
  std::size_t correspondences = 0;
};

/** \brief How two scans are registered. */
struct PairOptions {
  /** \brief The voxel size, in the unit of the clouds, > 0; nothing where nobody knows:
   * scans that are made have their own, the coarser of theirs is taken; for clouds it is
   * estimated (estimateResolution(); estimateVoxelSize() of those that are keypoints with
   * descriptors) and the coarser taken, or that of the smaller cloud, if it is a part of the
   * other: less than half as large, and as coarse; correspondences of the caller's tell it by
   * the spacing of their points, the finer of both sides, since points are repeated there. */
  std::optional<double> resolution;

  /** \brief Of the estimator, all but the lengths, which follow from the resolution (the
   * indoor preset, where that can't be known) ... */
  Parameters parameters;
  /** \brief ... or are given here, in the unit of the clouds. */
  std::optional<float> length_tolerance, min_length_sum, inlier_distance;

  /** \brief Target descriptors that each source descriptor is matched with, >= 1. */
  std::size_t neighbors = 1;
  /** \brief Keep matches that hold both ways only. */
  bool mutual = false;

  /** \brief Whether the clouds judge the hypotheses, too, wherever there are clouds. */
  bool cloud_check = true;

  /** \brief Whether to look a second time where the clouds leave the pose in doubt: at matches
   * from the target's side, and both ways at a coarser resolution. For correspondences of the
   * caller's, and with `mutual`, there is one look. */
  bool second_look = true;

  /** \brief Whether to spend no more time on a pair once none of its poses can become certain:
   * most pairs of a large set don't overlap. What is found is then not looked at any closer,
   * and its confidence is next to 0. */
  bool give_up_early = false;

  /** \brief A pose that is tried like any other hypothesis. */
  std::optional<RigidTransform> guess;

  /** \brief Called before each step; what it throws ends the registration. */
  std::function<void(const PairProgress&)> on_step;

  /** \brief The estimator's parameters at this resolution; 0 where none is known.
   * \throws std::invalid_argument if it is not > 0 and finite, nor 0 */
  PCL_FLASHREG_EXPORT Parameters
  parametersFor(double voxel_size) const;
};

/** \brief Wall-clock time of a registration's parts in milliseconds; 0 for what was not
 * done. */
struct PairTimings {
  double resolution = 0;
  FeatureTimings source, target;
  double matching = 0;
  StageTimings estimation;
  double total = 0;
};

/** \brief Putative correspondences with their coordinates in the callers' frames. */
struct Correspondences {
  /** \brief N x 3 each, row-major. */
  std::vector<double> source, target;
  /** \brief Distance in feature space, smaller is better; empty if there is none. */
  std::vector<float> ranks;

  std::size_t
  size() const
  {
    return source.size() / 3;
  }

  CorrespondenceView<double>
  view() const
  {
    return {
        source.data(), target.data(), size(), ranks.empty() ? nullptr : ranks.data()};
  }
};

/** \brief Points of a cloud that can't be part of a surface, and are not used: many in one
 * place, as beams without a return are stored, and those beyond all others by orders of
 * magnitude. Not those whose coordinates are not finite. */
struct LeftOutPoints {
  /** \brief In at most four places that hold hundreds each: (0, 0, 0), usually. */
  std::size_t repeated = 0;
  /** \brief Where most of these lie, in the caller's frame. */
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  /** \brief A thousand times as far from the middle as nine in ten of the others. */
  std::size_t stray = 0;
};

/** \brief What PairRegistration::align() returns. */
struct PairResult {
  /** \brief The pose, the verdict and what they are made from; its rows are those of
   * `matches`, or of the caller's correspondences. */
  Result pose;
  /** \brief Which keypoint of the source each row has, and which of the target; empty
   * where the caller brought correspondences. */
  std::vector<FeatureMatch> matches;
  /** \brief Number of correspondences. */
  std::size_t correspondences = 0;
  /** \brief Those that were registered. Empty where there were no clouds, or nobody needed
   * them. */
  Scan source, target;
  /** \brief Voxel size; 0 if it is not known. */
  double resolution = 0;
  /** \brief What each cloud by itself would have been seen at, where that was estimated:
   * far apart if they are not in the same unit. */
  std::optional<double> source_estimate, target_estimate;
  /** \brief What was not used of clouds. */
  LeftOutPoints source_left_out, target_left_out;
  Parameters parameters;
  PairTimings timings;
};

/** \brief Two scans to be registered; a scan that is in many pairs is kept once. */
struct PairOfScans {
  Scan source, target;
};

/** \brief Registers two clouds, with no initial guess: the one way from points to a pose.
 *
 * Clouds become scans (keypoints, normals, descriptors), scans are matched, matches become
 * hypotheses, and hypotheses are judged by the correspondences and by both clouds. Who has
 * descriptors, correspondences or scans already enters where these are; clouds judge
 * wherever there are clouds.
 *
 * Its templates are there for float and double.
 *
 * Deterministic, as Estimator is, and after a fork() usable as that is. An object owns its
 * threads and its memory, so that later calls allocate little; use one object a thread.
 */
class PCL_FLASHREG_EXPORT PairRegistration {
public:
  /** \param[in] backend where hypotheses are made
   * \param[in] num_threads CPU threads of all steps; 0 takes as many as there are
   * processors
   * \throws BackendError, std::invalid_argument as Estimator's constructor
   */
  explicit PairRegistration(BackendKind backend = BackendKind::Auto,
                            unsigned num_threads = 0);
  ~PairRegistration();
  PairRegistration(PairRegistration&&) noexcept;
  PairRegistration&
  operator=(PairRegistration&&) noexcept;

  /** \brief Makes a scan: a voxel grid and normals, and with ScanContent::Descriptors,
   * where the input has none, FPFH. The same on any number of threads.
   * \param[in] input what is known of the cloud
   * \param[in] resolution voxel size, in the unit of the cloud; of an input with
   * descriptors, the spacing of its points
   * \param[in] content see there
   * \param[out] timings of the steps, if not null
   * \throws std::invalid_argument if the resolution is not > 0 and finite, or too small for
   * the extent of the cloud; if a size, a stride or an index is out of range
   */
  template <typename Scalar>
  Scan
  makeScan(const ScanInput<Scalar>& input,
           double resolution,
           ScanContent content = ScanContent::Descriptors,
           FeatureTimings* timings = nullptr);

  /** \brief Makes what a scan is found in: for maps that are asked more than once. The same
   * on any number of threads. Takes about as long as making the scan, and four times its
   * memory.
   * \throws std::invalid_argument if the scan has no descriptors */
  ScanIndex
  makeIndex(const Scan& scan);

  /** \brief The resolution that align() takes for two clouds where no options say.
   * \throws std::invalid_argument as align() */
  template <typename Scalar>
  double
  chooseResolution(const ScanInput<Scalar>& source,
                   const ScanInput<Scalar>& target) const;

  /** \brief Each source descriptor with its nearest ones of the target, as
   * FeatureMatcher::match(), or with PairOptions::mutual those that hold both ways.
   * \throws std::invalid_argument if the descriptors' dimensions differ
   */
  std::vector<FeatureMatch>
  match(const Scan& source, const Scan& target, const PairOptions& options = {});

  /** \brief From clouds to the pose: finds the resolution, makes both scans, registers
   * them. Both clouds have descriptors, or none has.
   * \throws std::invalid_argument as makeScan(); if an option is out of range; if a cloud
   * whose resolution has to be estimated has fewer than two distinct finite points
   * \throws BackendError, std::bad_alloc if the machine fails; the object stays usable
   */
  template <typename Scalar>
  PairResult
  align(const ScanInput<Scalar>& source,
        const ScanInput<Scalar>& target,
        const PairOptions& options = {});

  /** \brief From scans with descriptors to the pose. One that has more than three times as many
   * keypoints as the other is taken for a map: the other is looked for in it, whichever is
   * the source (docs/method.md). */
  PairResult
  align(const Scan& source, const Scan& target, const PairOptions& options = {});

  /** \brief The same result, sooner, where the target's index is there already. */
  PairResult
  align(const Scan& source, const ScanIndex& target, const PairOptions& options = {});

  /** \brief Many pairs side by side, a thread each: neither their number nor their order tells in
   * a result, each is that of align(), to the last bit, but for the times.
   * \param[in] options of every pair; on_step is called by one thread at a time
   * \return a result a pair
   * \throws what align() throws, of one of the pairs that it happens to */
  std::vector<PairResult>
  alignBatch(const std::vector<PairOfScans>& pairs, const PairOptions& options = {});

  /** \brief From what match() returned to the pose. */
  PairResult
  align(const Scan& source,
        const Scan& target,
        const std::vector<FeatureMatch>& matches,
        const PairOptions& options = {});

  /** \brief From correspondences of the caller's to the pose; the clouds that they lie in
   * judge it. Without points in one of both clouds the correspondences decide alone. */
  template <typename Scalar>
  PairResult
  align(const ScanInput<Scalar>& source,
        const ScanInput<Scalar>& target,
        const CorrespondenceView<Scalar>& correspondences,
        const PairOptions& options = {});

  /** \brief The same where the clouds are scans already. */
  PairResult
  align(const Scan& source,
        const Scan& target,
        const CorrespondenceView<double>& correspondences,
        const PairOptions& options = {});

  /** \brief Name of the backend that was chosen, e.g. "cpu-avx512". */
  std::string
  backendName() const;

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/** \brief Correspondences from keypoints that match. */
PCL_FLASHREG_EXPORT Correspondences
toCorrespondences(const Scan& source,
                  const Scan& target,
                  const std::vector<FeatureMatch>& matches);

} // namespace pcl_flashreg
