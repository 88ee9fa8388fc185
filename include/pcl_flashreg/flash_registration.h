// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/estimator_settings.h>
#include <pcl_flashreg/fpfh_features.h>
#include <pcl_flashreg/impl/cloud_side.hpp>
#include <pcl_flashreg/impl/correspondence_buffer.hpp>
#include <pcl_flashreg/lazy_kdtree.h>

#include <pcl/point_representation.h>
#include <pcl/registration/ia_ransac.h>
#include <pcl/registration/registration.h>

#include <optional>
#include <string>

namespace pcl_flashreg {

/** \brief Wall-clock time of the parts of FlashRegistration::align() in milliseconds; 0
 * for what was not done, or kept from the call before. */
struct FlashRegistrationTimings {
  FpfhTimings source_features;
  FpfhTimings target_features;
  /** \brief Descriptors to correspondences. */
  double matching = 0;
  /** \brief Correspondences to pose. */
  StageTimings estimation;
  /** \brief The whole of computeTransformation(). */
  double total = 0;
};

/** \brief Global registration, with no initial guess, as a pcl::Registration: the
 * method of Estimator behind the interface of pcl::SampleConsensusPrerejective.
 *
 * Correspondences come from one of three places: setCorrespondences(); or the matches
 * of the descriptors given to setSourceFeatures() and setTargetFeatures(); or else, of
 * FPFH descriptors that the class computes itself. Lengths come from setParameters(),
 * or else from the resolution, which is setResolution(), or else estimated: see
 * PairOptions::resolution. setMaxCorrespondenceDistance() sets the inlier distance over
 * all of these.
 *
 * - hasConverged() is Result::converged: getConfidence() reaches
 *   Parameters::min_confidence; and the inlier fraction, where one is set.
 *   getFinalTransformation() is the best pose even if it is not trusted; it is the
 *   identity, and the output a copy of the source, if getStatus() is not Status::Ok;
 *   where there is nothing to copy, align() leaves the output alone.
 * - align() never throws. What kept it from finding a pose is printed with PCL_ERROR
 *   and kept in getErrorMessage(); the object stays usable.
 * - setInputSource() and setInputTarget() clear the result of the last align() and
 *   drop the descriptors of the cloud before: call them again after a cloud was edited
 *   in place. Descriptors of a target that stays are computed once as long as the
 *   resolution stays: set it, where many sources meet one target.
 * - Both clouds decide with the correspondences which pose is right: setCloudCheck().
 *   What lies between a cloud's sensor_origin_ and its points is taken to be empty. Set
 *   it, if the sensor stood elsewhere, or call setViewpointsKnown(false). Normals are
 *   computed; where descriptors are given and the points have normals, those are taken.
 * - A guess that is not the identity is scored as one more hypothesis. The final
 *   transformation is always from the source as given.
 * - setIndices() selects source points; features are still given for the full cloud.
 *   Points and descriptors that are not finite are skipped, whatever is_dense says.
 * - The output may be the source cloud itself, if no indices are set. The source's
 *   normals, sensor_origin_ and sensor_orientation_ are moved with its points.
 * - As with all of PCL: a program with a point type of its own must include
 *   pcl/kdtree/impl/kdtree_flann.hpp or define PCL_NO_PRECOMPILE, and one compiled
 *   with other SIMD flags than PCL's libraries (-mavx2) must define the latter before it
 *   uses FrontEnd::Pcl: Eigen's memory is laid out otherwise there.
 * - setMaximumIterations(), setRANSACIterations() and other settings of
 *   pcl::Registration that are not named here have no effect.
 */
template <typename PointSource,
          typename PointTarget,
          typename FeatureT = pcl::FPFHSignature33>
class FlashRegistration : public pcl::Registration<PointSource, PointTarget, float>,
                          public EstimatorSettings {
  using Base = pcl::Registration<PointSource, PointTarget, float>;

public:
  using Ptr = pcl::shared_ptr<FlashRegistration<PointSource, PointTarget, FeatureT>>;
  using ConstPtr =
      pcl::shared_ptr<const FlashRegistration<PointSource, PointTarget, FeatureT>>;
  using Matrix4 = typename Base::Matrix4;

  using PointCloudSource = typename Base::PointCloudSource;
  using PointCloudSourcePtr = typename PointCloudSource::Ptr;
  using PointCloudSourceConstPtr = typename PointCloudSource::ConstPtr;
  using PointCloudTarget = typename Base::PointCloudTarget;
  using PointCloudTargetConstPtr = typename PointCloudTarget::ConstPtr;

  using FeatureCloud = pcl::PointCloud<FeatureT>;
  using FeatureCloudPtr = typename FeatureCloud::Ptr;
  using FeatureCloudConstPtr = typename FeatureCloud::ConstPtr;
  using FeatureRepresentationConstPtr =
      typename pcl::PointRepresentation<FeatureT>::ConstPtr;

  /** \name Of pcl::SampleConsensusInitialAlignment, for programs that name them */
  /**@{*/
  using SacIa =
      pcl::SampleConsensusInitialAlignment<PointSource, PointTarget, FeatureT>;
  using ErrorFunctor = typename SacIa::ErrorFunctor;
  using HuberPenalty = typename SacIa::HuberPenalty;
  using TruncatedError = typename SacIa::TruncatedError;
  using ErrorFunctorPtr = typename ErrorFunctor::Ptr;
  /**@}*/

  FlashRegistration();

  void
  setInputSource(const PointCloudSourceConstPtr& cloud) override;

  void
  setInputTarget(const PointCloudTargetConstPtr& cloud) override;

  /** \brief pcl::Registration::align() with a guess. It is here for source and target
   * of different types, for which that of PCL 1.13 and earlier does not compile. */
  void
  align(PointCloudSource& output, const Matrix4& guess);

  void
  align(PointCloudSource& output)
  {
    align(output, Matrix4::Identity());
  }

  /** \name Where correspondences come from */
  /**@{*/

  /** \brief Descriptors of all the source points, one a point. */
  void
  setSourceFeatures(const FeatureCloudConstPtr& features);

  FeatureCloudConstPtr
  getSourceFeatures() const
  {
    return source_features_;
  }

  /** \brief Descriptors of all the target points, one a point. */
  void
  setTargetFeatures(const FeatureCloudConstPtr& features);

  FeatureCloudConstPtr
  getTargetFeatures() const
  {
    return target_features_;
  }

  /** \brief Forgets the given descriptors; the class computes its own again. */
  void
  clearFeatures();

  /** \brief How a descriptor becomes a row of floats. By default
   * pcl::DefaultPointRepresentation, and all floats of a type that PCL has none for. */
  void
  setFeatureRepresentation(const FeatureRepresentationConstPtr& representation)
  {
    feature_representation_ = representation;
  }

  /** \brief Who computes the descriptors, where none are given; FrontEnd::Native by
   * default. */
  void
  setFrontEnd(FrontEnd front_end)
  {
    if (front_end != front_end_) {
      source_side_.reset();
      target_side_.reset();
    }
    front_end_ = front_end;
  }

  FrontEnd
  getFrontEnd() const
  {
    return front_end_;
  }

  /** \brief Correspondences between input source and input target to use instead of
   * descriptors; null to use descriptors again. Those with a smaller `distance` are
   * kept where there are more than Parameters::max_correspondences. Those without a
   * match (-1) or outside setIndices() are ignored. */
  void
  setCorrespondences(const pcl::CorrespondencesConstPtr& correspondences)
  {
    given_correspondences_ = correspondences;
  }

  /** \brief How many of the nearest target descriptors a source descriptor is matched
   * with; > 0, 1 by default. */
  void
  setCorrespondenceRandomness(int k)
  {
    k_correspondences_ = k;
  }

  int
  getCorrespondenceRandomness() const
  {
    return k_correspondences_;
  }
  /**@}*/

  /** \name How the pose is estimated: these, and those of EstimatorSettings */
  /**@{*/

  /** \brief The resolution that was set, or else the one that the last align()
   * estimated, or else 0. */
  double
  getResolution() const
  {
    return resolution_ != 0 ? resolution_ : estimated_resolution_;
  }

  /** \brief The parameters that align() uses, as far as they are known before it. */
  Parameters
  getParameters() const;

  /** \brief Whether the clouds judge the hypotheses, too (the default), wherever the
   * correspondences come from; it costs a few milliseconds. */
  void
  setCloudCheck(bool check)
  {
    cloud_check_ = check;
  }

  bool
  getCloudCheck() const
  {
    return cloud_check_;
  }

  /** \brief Whether to look a second time where the clouds leave the pose in doubt (the
   * default), see PairOptions::second_look. Who wants an answer within the time of one look
   * turns it off. */
  void
  setSecondLook(bool look)
  {
    second_look_ = look;
  }

  bool
  getSecondLook() const
  {
    return second_look_;
  }

  /** \brief Whether the sensors stood at the sensor_origin_ of their clouds (the
   * default). Say no for clouds in a frame of another kind (merged scans, models):
   * fewer poses are told from wrong ones, but none for a wrong reason. */
  void
  setViewpointsKnown(bool known)
  {
    setSourceViewpointKnown(known);
    setTargetViewpointKnown(known);
  }

  /** \brief Whether that is so of both. */
  bool
  getViewpointsKnown() const
  {
    return getSourceViewpointKnown() && getTargetViewpointKnown();
  }

  /** \brief Of the source alone: a scan that is searched for in a map, which has no
   * viewpoint, brings its own. */
  void
  setSourceViewpointKnown(bool known)
  {
    source_side_.setViewpointKnown(known);
  }

  bool
  getSourceViewpointKnown() const
  {
    return source_side_.viewpointKnown();
  }

  /** \brief Of the target alone. */
  void
  setTargetViewpointKnown(bool known)
  {
    target_side_.setViewpointKnown(known);
  }

  bool
  getTargetViewpointKnown() const
  {
    return target_side_.viewpointKnown();
  }

  /** \brief Fraction of the source points, in [0, 1], that must have a target point
   * within the inlier distance under the final pose for hasConverged(); 0 (the default)
   * for no such condition. */
  void
  setInlierFraction(float inlier_fraction)
  {
    inlier_fraction_ = inlier_fraction;
  }

  float
  getInlierFraction() const
  {
    return inlier_fraction_;
  }

  /** \brief No effect: the method samples nothing. */
  void
  setNumberOfSamples(int nr_samples)
  {
    nr_samples_ = nr_samples;
  }

  int
  getNumberOfSamples() const
  {
    return nr_samples_;
  }

  /** \brief No effect: how far apart points must be is Parameters::min_length_sum. */
  void
  setMinSampleDistance(float min_sample_distance)
  {
    min_sample_distance_ = min_sample_distance;
  }

  float
  getMinSampleDistance() const
  {
    return min_sample_distance_;
  }

  /** \brief No effect: no pose is judged by the distances of random samples. Takes and
   * keeps the functors of pcl::SampleConsensusInitialAlignment. */
  void
  setErrorFunction(const ErrorFunctorPtr& error_functor)
  {
    error_functor_ = error_functor;
  }

  ErrorFunctorPtr
  getErrorFunction() const
  {
    return error_functor_;
  }

  /** \brief No effect: edge lengths are compared absolutely, by
   * Parameters::length_tolerance. */
  void
  setSimilarityThreshold(float similarity_threshold)
  {
    similarity_threshold_ = similarity_threshold;
  }

  float
  getSimilarityThreshold() const
  {
    return similarity_threshold_;
  }
  /**@}*/

  /** \name What the last align() found */
  /**@{*/

  /** \brief Everything that the estimator says: the pose in double precision, the
   * verdict, hypotheses, information matrix. Its rows are those of
   * getCorrespondences(). */
  const Result&
  getResult() const
  {
    return result_;
  }

  Status
  getStatus() const
  {
    return result_.status;
  }

  /** \brief Probability that the pose is right, in [0, 1]: see Result::confidence. */
  double
  getConfidence() const
  {
    return result_.confidence;
  }

  const std::vector<Hypothesis>&
  getHypotheses() const
  {
    return result_.hypotheses;
  }

  const InformationMatrix&
  getInformationMatrix() const
  {
    return result_.information;
  }

  /** \brief What kept align() from finding a pose, as printed; empty if it found one.
   * Before it, which cloud is missing. */
  const std::string&
  getErrorMessage() const
  {
    return error_message_;
  }

  const FlashRegistrationTimings&
  getTimings() const
  {
    return timings_;
  }

  /** \brief The putative correspondences, between the input clouds, or, where the class
   * computed descriptors, between the points of getSourceFpfh() and getTargetFpfh(). */
  const pcl::Correspondences&
  getCorrespondences() const
  {
    return *correspondences_;
  }

  /** \brief Those of getCorrespondences() that agree with the pose. */
  pcl::Correspondences
  getInlierCorrespondences() const;

  /** \brief Keypoints and descriptors of the source that the class computed. */
  const FpfhCloud&
  getSourceFpfh() const
  {
    return source_side_.fpfh();
  }

  /** \brief Keypoints and descriptors of the target that the class computed. */
  const FpfhCloud&
  getTargetFpfh() const
  {
    return target_side_.fpfh();
  }

  /** \brief Indices of the source points (of those in setIndices(), where set) that
   * have a target point within the inlier distance under the final pose. Searched for
   * at the first call; not to be called from two threads at once. */
  const pcl::Indices&
  getInliers() const;
  /**@}*/

protected:
  using Base::converged_;
  using Base::corr_dist_threshold_;
  using Base::correspondences_;
  using Base::final_transformation_;
  using Base::force_no_recompute_;
  using Base::getClassName;
  using Base::indices_;
  using Base::input_;
  using Base::reg_name_;
  using Base::target_;
  using Base::target_cloud_updated_;
  using Base::transformation_;
  using Base::tree_;
  using pcl::PCLBase<PointSource>::fake_indices_;

  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

private:
  /** \brief Which cloud there is none of; empty if there are both. */
  std::string
  missingInput() const;

  /** \brief Why the selected source points can't be copied into the output; empty if
   * they can. */
  std::string
  whyNotCopied(const PointCloudSource& output) const;

  /** \brief What pcl::Registration::align() does before computeTransformation().
   * \return whether there is anything to compute */
  bool
  prepare(PointCloudSource& output);

  /** \brief Gives the output, which holds the selected points, what is not points of the
   * source. */
  void
  describeOutput(PointCloudSource& output) const;

  void
  resetResult();

  /** \brief Refuses what a computation can't be made from.
   * \throws std::invalid_argument */
  void
  checkInput(const PointCloudSource& output) const;

  /** \brief What the settings say, but for the guess. */
  PairOptions
  pairOptions() const;

  /** \brief Registers the clouds, from one of the three places; fills correspondences_. */
  PairResult
  alignInputs(const PairOptions& options);
  PairResult
  alignCorrespondences(const ScanInput<float>& source,
                       const ScanInput<float>& target,
                       const PairOptions& options);
  PairResult
  alignGivenFeatures(ScanInput<float>& source,
                     ScanInput<float>& target,
                     const PairOptions& options);
  PairResult
  alignComputedFeatures(ScanInput<float>& source,
                        ScanInput<float>& target,
                        PairOptions options);

  /** \brief Empty if all source points are used. */
  pcl::Indices
  sourceIndices() const;

  /** \brief The guess as a hypothesis, none if it is the identity.
   * \throws std::invalid_argument if it is not rigid */
  static std::optional<RigidTransform>
  hypothesisFrom(const Matrix4& guess);

  /** \brief Takes over the pose, decides on converged_, transforms the output and its
   * sensor's pose. */
  void
  applyResult(PointCloudSource& output);

  void
  fail(const std::string& message);

  /** \brief For the message of a failure: how many keypoints the resolution left. Empty
   * where the class computed none. */
  std::string
  keypointsLeft() const;

  bool
  hasInlierDistance() const;

  FeatureCloudConstPtr source_features_;
  FeatureCloudConstPtr target_features_;
  FeatureRepresentationConstPtr feature_representation_;
  pcl::CorrespondencesConstPtr given_correspondences_;
  int k_correspondences_ = 1;
  FrontEnd front_end_ = FrontEnd::Native;

  double estimated_resolution_ = 0;
  /** \brief For descriptors that the class computes, as long as the clouds stay. */
  std::optional<double> known_estimate_;
  /** \brief Of the last align(). */
  double inlier_distance_ = 0;
  float inlier_fraction_ = 0;
  int nr_samples_ = 3;
  float similarity_threshold_ = 0.6f;
  float min_sample_distance_ = 0;
  ErrorFunctorPtr error_functor_;

  detail::CloudSide source_side_;
  detail::CloudSide target_side_;
  bool cloud_check_ = true;
  bool second_look_ = true;

  detail::CorrespondenceBuffer buffer_;

  Result result_;
  FlashRegistrationTimings timings_;
  std::string error_message_;
  /** \brief Empty optional: not searched for yet. */
  mutable std::optional<pcl::Indices> inliers_ = pcl::Indices();

public:
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

} // namespace pcl_flashreg

#include <pcl_flashreg/impl/flash_registration.hpp>
