// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/estimator_settings.h>
#include <pcl_flashreg/impl/cloud_side.hpp>
#include <pcl_flashreg/multiview_registration.h>

#include <pcl/memory.h>
#include <pcl/pcl_macros.h>
#include <pcl/point_cloud.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_flashreg {

/** \brief Registers any number of clouds with each other, in any order and with no guess:
 * MultiviewRegistration with the interface of pcl::registration::LUM, which needs
 * correspondences and poses that are nearly right.
 *
 * - Clouds of one group are in one frame, that of the group's first cloud, where
 *   getTransformation() takes them. A cloud that nothing ties to another is a group of its
 *   own.
 * - The resolution is setResolution(), or else the middle one of those that are estimated
 *   for the clouds (estimateResolution()).
 * - What lies between a cloud's sensor_origin_ and its points is taken to be empty. Set it,
 *   if the sensor stood elsewhere, or call setViewpointsKnown(false).
 * - compute() never throws. What kept it from an answer is printed with PCL_ERROR and kept in
 *   getErrorMessage(); the object stays usable.
 * - A vertex that there is none of is a std::out_of_range.
 * - Settings of EstimatorSettings::setParameters() are those of the pairs.
 */
template <typename PointT>
class FlashMultiviewRegistration : public EstimatorSettings {
public:
  using Ptr = pcl::shared_ptr<FlashMultiviewRegistration<PointT>>;
  using ConstPtr = pcl::shared_ptr<const FlashMultiviewRegistration<PointT>>;

  using PointCloud = pcl::PointCloud<PointT>;
  using PointCloudPtr = typename PointCloud::Ptr;
  using PointCloudConstPtr = typename PointCloud::ConstPtr;
  /** \brief Number of a cloud, from 0 in the order in which they were added. */
  using Vertex = std::size_t;

  /** \brief Adds a cloud, which is not copied. Clears the result. */
  Vertex
  addPointCloud(const PointCloudConstPtr& cloud);

  /** \brief Puts another cloud, or the same with other points, in the place of one. Clears
   * the result. */
  void
  setPointCloud(Vertex vertex, const PointCloudConstPtr& cloud);

  PointCloudConstPtr
  getPointCloud(Vertex vertex) const
  {
    return nodes_.at(vertex).cloud;
  }

  std::size_t
  getNumVertices() const
  {
    return nodes_.size();
  }

  /** \brief Whether sensors stood at the sensor_origin_ of their clouds (the default). */
  void
  setViewpointsKnown(bool known);

  bool
  getViewpointsKnown() const
  {
    return viewpoints_known_;
  }

  /** \brief MultiviewOptions::min_confidence, 0.9 by default. */
  void
  setMinConfidence(double min_confidence)
  {
    options_.min_confidence = min_confidence;
  }

  double
  getMinConfidence() const
  {
    return options_.min_confidence;
  }

  /** \brief MultiviewOptions::sequence, false by default. */
  void
  setSequence(bool sequence)
  {
    options_.sequence = sequence;
  }

  bool
  getSequence() const
  {
    return options_.sequence;
  }

  /** \brief Registers all clouds. Descriptors are kept for the next time, as long as the
   * resolution stays. */
  void
  compute();

  /** \brief The resolution that was set, or else the one that the last compute() estimated,
   * or else 0. */
  double
  getResolution() const
  {
    return resolution_ != 0 ? resolution_ : estimated_resolution_;
  }

  /** \name What the last compute() found */
  /**@{*/

  /** \brief Whether all clouds are in one group. */
  bool
  hasConverged() const
  {
    return converged_;
  }

  /** \brief What kept compute() from an answer, as printed; empty if there is one. */
  const std::string&
  getErrorMessage() const
  {
    return error_message_;
  }

  /** \brief Everything: poses in double precision, groups, what became of each pair. */
  const MultiviewResult&
  getResult() const
  {
    return result_;
  }

  /** \brief From the cloud to its group's frame. */
  Eigen::Affine3f
  getTransformation(Vertex vertex) const
  {
    return Eigen::Affine3f(placeOf(vertex).T_group_scan.template toMatrix<float>());
  }

  /** \brief Number of the group, from 0; the largest first. */
  std::size_t
  getGroup(Vertex vertex) const
  {
    return placeOf(vertex).group;
  }

  /** \brief Whether it is in a group with others. */
  bool
  isPlaced(Vertex vertex) const
  {
    return result_.groups[getGroup(vertex)].size() > 1;
  }

  /** \brief ScanPlace::confidence */
  double
  getConfidence(Vertex vertex) const
  {
    return placeOf(vertex).confidence;
  }

  /** \brief The cloud in its group's frame: points, normals, the sensor's pose. */
  PointCloudPtr
  getTransformedCloud(Vertex vertex) const;

  /** \brief All clouds of a group in its frame; empty if there is none. */
  PointCloudPtr
  getConcatenatedCloud(std::size_t group = 0) const;
  /**@}*/

private:
  struct Node {
    PointCloudConstPtr cloud;
    detail::CloudSide side;
  };

  const ScanPlace&
  placeOf(Vertex vertex) const
  {
    return result_.scans.at(vertex);
  }

  /** \brief Every cloud by itself. */
  void
  resetResult();

  /** \brief The middle one of the clouds'.
   * \throws std::invalid_argument if no cloud has one */
  double
  estimateResolutions();

  /** \throws std::invalid_argument that names the cloud */
  std::vector<Scan>
  makeScans(double resolution);

  std::vector<Node> nodes_;
  bool viewpoints_known_ = true;
  MultiviewOptions options_;

  double estimated_resolution_ = 0;
  bool converged_ = false;
  MultiviewResult result_;
  std::string error_message_;
};

} // namespace pcl_flashreg

#include <pcl_flashreg/impl/flash_multiview_registration.hpp>
