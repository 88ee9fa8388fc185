// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/backend.h"
#include "estimation/preparation.h"
#include "judgement/cloud_check.h"
#include "judgement/cpu/surface.h"

#include <pcl_flashreg/estimator.h>
#include <pcl_flashreg/pair_registration.h>

#include <deque>
#include <functional>
#include <optional>
#include <variant>

namespace pcl_flashreg {

/** \brief A cloud that is to judge poses. */
struct JudgingCloud {
  template <typename Scalar>
  explicit JudgingCloud(const CloudView<Scalar>& cloud, const Vec3& offset = {0, 0, 0})
      : view(cloud), shift(offset)
  {
  }

  std::variant<CloudView<float>, CloudView<double>> view;
  /** \brief What to add to the view's coordinates to get those of the correspondences. */
  Vec3 shift;
  /** \brief Made of it already, if not null: in order, about its middle, for points at this
   * distance. */
  const Surface* surface = nullptr;
  double spacing = 0;
  std::optional<Vec3> known_middle;

  std::size_t
  size() const
  {
    return std::visit([](const auto& v) { return v.size; }, view);
  }

  /** \brief The middle of the box around its points, in the frame of the correspondences. */
  Vec3
  middle() const;
};

struct JudgingClouds {
  JudgingCloud source, target;

  /** \brief Whether the target is a map for the source. */
  bool
  areScanAndMap() const
  {
    return Vicinity::isMuchLarger(target.size(), source.size());
  }

  /** \brief Distance of neighbouring points. */
  double spacing = 0;
  /** \brief See PairOptions. */
  bool give_up_early = false;
};

/** \brief Other correspondences of the clouds that were registered. */
struct OtherCorrespondences {
  Correspondences correspondences;
  /** \brief Whether they count as those of the first look do: of the same keypoints, and so
   * about as many that agree with the right pose. */
  bool are_witnesses = false;
  /** \brief Whether they are of one of many parts of a map: few of its hypotheses count. */
  bool of_place = false;
};

/** \brief Hands them out one after the other, as they are wanted; nothing at the end. */
using SecondLook = std::function<std::optional<OtherCorrespondences>(std::size_t)>;

/** \brief From correspondences to the pose and the verdict: preparation, the backend's
 * stages, the clouds, the confidence. Keeps its memory from call to call. */
class PoseSearch {
public:
  /** \param[in] num_threads of a pool of its own */
  PoseSearch(BackendKind backend, unsigned num_threads);
  /** \brief One more, on the same device. */
  PoseSearch(const PoseSearch& like, unsigned num_threads);

  /** \brief As Estimator::estimate(); clouds are null where there are none.
   * \param[in] second_look what to go on with where the clouds leave the pose in doubt; empty
   * for none */
  template <typename Scalar>
  Result
  run(const CorrespondenceView<Scalar>& correspondences,
      const Parameters& parameters,
      const std::optional<RigidTransform>& guess,
      const JudgingClouds* clouds,
      const SecondLook& second_look = {});

  /** \brief For other steps of the same call. */
  ThreadPool&
  pool()
  {
    return pool_;
  }

  /** \brief See Backend. */
  bool
  isOnDevice() const
  {
    return backend_->isOnDevice();
  }
  CorrespondenceView<float>
  readBack(const DeviceCorrespondences& correspondences)
  {
    return backend_->readBack(correspondences);
  }
  void
  leavePose(const float T_target_source[16], const DeviceCorrespondences& asked)
  {
    backend_->leavePose(T_target_source, asked);
  }

  std::string
  backendName() const
  {
    return backend_->name();
  }

  void
  setTrace(Trace* trace)
  {
    trace_ = trace;
  }

private:
  SurfacePair
  prepareClouds(const JudgingClouds& clouds);
  void
  addSecondBest(const Parameters& parameters,
                PoseEstimate& estimate,
                StageClock& clock);
  CloudFindings
  askClouds(const JudgingClouds& clouds,
            const Parameters& parameters,
            const SecondLook& second_look,
            PoseEstimate& estimate,
            StageClock& clock);
  bool
  lookAgain(const SecondLook& second_look,
            std::size_t first,
            const Parameters& parameters,
            CloudCheck& check);
  void
  lookAt(const OtherCorrespondences& other,
         const Parameters& parameters,
         Problem& problem,
         CloudCheck& check);
  CloudFindings
  judged(const Parameters& parameters, CloudCheck& check) const;
  void
  takeOver(const CloudFindings& findings,
           const Parameters& parameters,
           PoseEstimate& estimate) const;

  Pose
  toCentred(const RigidTransform& T) const;
  RigidTransform
  toOriginal(const Pose& T) const;
  void
  fill(Result& result,
       const PoseEstimate& estimate,
       const CloudFindings& findings,
       const Parameters& parameters);

  ThreadPool pool_;
  std::unique_ptr<Backend> backend_;
  Trace* trace_ = nullptr;
  Preparation preparation_;
  Problem problem_, leftover_;
  /** \brief Of a second look; they stay where they are when there are more. */
  std::deque<Problem> others_;
  Surface source_surface_, target_surface_;
  Vicinity vicinity_;
};

extern template Result
PoseSearch::run(const CorrespondenceView<float>&,
                const Parameters&,
                const std::optional<RigidTransform>&,
                const JudgingClouds*,
                const SecondLook&);
extern template Result
PoseSearch::run(const CorrespondenceView<double>&,
                const Parameters&,
                const std::optional<RigidTransform>&,
                const JudgingClouds*,
                const SecondLook&);

} // namespace pcl_flashreg
