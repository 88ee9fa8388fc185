// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/cloud_view.h>
#include <pcl_flashreg/fpfh_features.h>

#include <vector>

namespace pcl_flashreg {
namespace detail {

/** \brief Keypoints and their normals in the packed form that the core takes. */
template <typename Scalar>
class CloudBuffer {
public:
  /** \param[in] shift what to add to the keypoints
   * \param[in] viewpoint after the shift; nothing if it is not known */
  void
  gather(const FpfhCloud& cloud,
         const Eigen::Matrix<Scalar, 3, 1>& shift,
         const std::optional<Eigen::Vector3d>& viewpoint)
  {
    xyz_.clear();
    normals_.clear();
    viewpoint_ = viewpoint;
    for (std::size_t i = 0; i < cloud.points->size(); ++i) {
      const Eigen::Matrix<Scalar, 3, 1> point =
          (*cloud.points)[i].getVector3fMap().template cast<Scalar>() + shift;
      xyz_.insert(xyz_.end(), point.data(), point.data() + 3);
      const float* normal = (*cloud.normals)[i].normal;
      normals_.insert(normals_.end(), normal, normal + 3);
    }
  }

  CloudView<Scalar>
  view() const
  {
    return {xyz_.data(), normals_.data(), normals_.size() / 3, viewpoint_};
  }

private:
  std::vector<Scalar> xyz_;
  std::vector<float> normals_;
  std::optional<Eigen::Vector3d> viewpoint_;
};

} // namespace detail
} // namespace pcl_flashreg
