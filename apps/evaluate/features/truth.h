// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../datasets/pair.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>

namespace pcl_flashreg::evaluate {

/** \brief A true pose that is known to within decimetres, brought onto the points: PCL's
 * point-to-point ICP on both clouds, thinned to 5 cm, with correspondences of up to 0.2 m.
 *
 * The literature does so with KITTI's poses (FCGF's loader and those after it).
 * \param[in] source points, metres, one a column
 * \param[in] target likewise
 * \return the given pose if ICP does not converge
 */
RigidTransform
refineTruth(const Eigen::Matrix3Xd& source,
            const Eigen::Matrix3Xd& target,
            const RigidTransform& T_target_source);

/** \brief The true poses of pairs, refined where the data set asks for it. */
class TruthStore {
public:
  /** \param[in] cache_folder keeps refined poses on disk; empty for not at all
   * \param[in] bin_fields see DataSet */
  TruthStore(std::string root, std::string cache_folder, std::size_t bin_fields = 0)
      : root_(std::move(root)),
        cache_folder_(std::move(cache_folder)),
        bin_fields_(bin_fields)
  {
  }

  /** \throws io::InputError if a cloud cannot be read */
  RigidTransform
  get(const Pair& pair) const;

private:
  std::string root_;
  std::string cache_folder_;
  std::size_t bin_fields_;
};

} // namespace pcl_flashreg::evaluate
