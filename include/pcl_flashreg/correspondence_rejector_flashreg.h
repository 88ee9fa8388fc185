// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/estimator_settings.h>
#include <pcl_flashreg/impl/correspondence_buffer.hpp>

#include <pcl/memory.h>
#include <pcl/registration/correspondence_rejection.h>

#include <optional>

namespace pcl_flashreg {

/** \brief Keeps the correspondences that agree with the rigid transform that Estimator
 * finds from all of them: the interface of
 * pcl::registration::CorrespondenceRejectorSampleConsensus, without its random choices.
 *
 * A correspondence is kept if its source point, moved by getBestTransformation(), is
 * closer to its target point than the inlier threshold. The transform is the best one
 * even if it is not trusted: see Result::converged of getResult().
 *
 * Where no transform is found (fewer than three correspondences, no clique, a parameter
 * out of range, an index that is not one of its cloud) all correspondences are kept and
 * getBestTransformation() is the identity, as in PCL's class; the errors among these
 * are printed with PCL_ERROR. Without a source or a target the output is left as it is.
 *
 * Lengths come from setParameters(), or else from the resolution of setResolution(), or
 * else from half the inlier threshold as resolution.
 */
template <typename PointT>
class CorrespondenceRejectorFlashReg : public pcl::registration::CorrespondenceRejector,
                                       public EstimatorSettings {
  using PointCloud = pcl::PointCloud<PointT>;
  using PointCloudConstPtr = typename PointCloud::ConstPtr;

public:
  using Ptr = pcl::shared_ptr<CorrespondenceRejectorFlashReg<PointT>>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceRejectorFlashReg<PointT>>;

  CorrespondenceRejectorFlashReg()
  {
    rejection_name_ = "CorrespondenceRejectorFlashReg";
  }

  /** \brief The cloud that index_query counts in. */
  virtual void
  setInputSource(const PointCloudConstPtr& cloud)
  {
    input_ = cloud;
  }

  PointCloudConstPtr
  getInputSource() const
  {
    return input_;
  }

  /** \brief The cloud that index_match counts in. */
  virtual void
  setInputTarget(const PointCloudConstPtr& cloud)
  {
    target_ = cloud;
  }

  PointCloudConstPtr
  getInputTarget() const
  {
    return target_;
  }

  /** \brief Distance below which a correspondence agrees with the transform, in the
   * unit of the clouds, > 0; 0.05 by default, as in PCL's class. Once set it wins over
   * Parameters::inlier_distance and the resolution. */
  void
  setInlierThreshold(double threshold)
  {
    inlier_threshold_ = threshold;
  }

  /** \brief The threshold in use, wherever it comes from. */
  double
  getInlierThreshold() const
  {
    return getParameters().inlier_distance;
  }

  /** \brief The parameters in use.
   * \throws std::invalid_argument if the resolution or the threshold is not > 0 */
  Parameters
  getParameters() const;

  void
  getRemainingCorrespondences(const pcl::Correspondences& original_correspondences,
                              pcl::Correspondences& remaining_correspondences) override;

  /** \brief The transform from source to target of the last call; the identity if none
   * was found. */
  Eigen::Matrix4f
  getBestTransformation() const
  {
    return result_.T_target_source.toMatrix<float>();
  }

  /** \brief What the estimator said in the last call. */
  const Result&
  getResult() const
  {
    return result_;
  }

  /** \brief Whether getInliersIndices() has anything to say; false by default. */
  void
  setSaveInliers(bool save)
  {
    save_inliers_ = save;
  }

  bool
  getSaveInliers() const
  {
    return save_inliers_;
  }

  /** \brief Positions of the kept correspondences among the original ones; empty unless
   * setSaveInliers(true) was called before, and where no transform was found. */
  void
  getInliersIndices(pcl::Indices& inlier_indices) const
  {
    inlier_indices = inlier_indices_;
  }

  bool
  requiresSourcePoints() const override
  {
    return true;
  }

  void
  setSourcePoints(pcl::PCLPointCloud2::ConstPtr cloud) override;

  bool
  requiresTargetPoints() const override
  {
    return true;
  }

  void
  setTargetPoints(pcl::PCLPointCloud2::ConstPtr cloud) override;

protected:
  void
  applyRejection(pcl::Correspondences& correspondences) override
  {
    getRemainingCorrespondences(*input_correspondences_, correspondences);
  }

private:
  /** \brief Positions of all correspondences within the threshold under the pose. */
  pcl::Indices
  findInliers(const pcl::Correspondences& correspondences) const;

  PointCloudConstPtr input_;
  PointCloudConstPtr target_;
  std::optional<double> inlier_threshold_;
  bool save_inliers_ = false;

  detail::CorrespondenceBuffer buffer_;
  Result result_;
  pcl::Indices inlier_indices_;

public:
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

} // namespace pcl_flashreg

#include <pcl_flashreg/impl/correspondence_rejector_flashreg.hpp>
