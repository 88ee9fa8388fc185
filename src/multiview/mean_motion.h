// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace pcl_flashreg {

/** \brief The motion that fits best to several: the rotation that is nearest to the mean of
 * theirs, and the mean place onto the mean place. */
class MeanMotion {
public:
  /** \param[in] from, to a place, and where this motion takes it */
  void
  add(double weight,
      const Eigen::Matrix3d& rotation,
      const Eigen::Vector3d& from,
      const Eigen::Vector3d& to)
  {
    turns_ += weight * rotation;
    from_ += weight * from;
    to_ += weight * to;
    sum_ += weight;
  }

  double
  weight() const
  {
    return sum_;
  }

  /** \brief Of weights whose sum is not 0. */
  Eigen::Isometry3d
  get() const
  {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
        turns_, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d flip = Eigen::Matrix3d::Identity();
    flip(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
    Eigen::Isometry3d mean = Eigen::Isometry3d::Identity();
    mean.linear() = svd.matrixU() * flip * svd.matrixV().transpose();
    mean.translation() = (to_ - mean.linear() * from_) / sum_;
    return mean;
  }

private:
  Eigen::Matrix3d turns_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero(), to_ = Eigen::Vector3d::Zero();
  double sum_ = 0;
};

} // namespace pcl_flashreg
