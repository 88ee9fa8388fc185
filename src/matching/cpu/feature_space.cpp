// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "matching/cpu/feature_space.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/** \brief Descriptors that the components are computed from. */
constexpr std::size_t SAMPLES = 256;
/** \brief Rounds of subspace iteration. The components need not be accurate, only
 * orthonormal, which they are after each. */
constexpr int ROUNDS = 5;

} // namespace

FeatureSpace::FeatureSpace(const DistinctFeatures& queries,
                           const DistinctFeatures& targets)
{
  const auto dimension = static_cast<Eigen::Index>(targets.view.dimension);
  const float largest = std::max(queries.largest, targets.largest);
  if (largest > 0)
    scale_ = std::ldexp(1.0, -std::ilogb(largest));

  const std::size_t count = std::min(SAMPLES, targets.size());
  Rows sample(static_cast<Eigen::Index>(count), dimension);
  for (std::size_t i = 0; i < count; ++i) {
    const float* values = targets[i * targets.size() / count];
    for (Eigen::Index d = 0; d < dimension; ++d)
      sample(static_cast<Eigen::Index>(i), d) = values[d] * scale_;
  }
  mean_ = sample.colwise().mean();
  sample.rowwise() -= mean_;

  const Eigen::MatrixXd axes =
      Eigen::MatrixXd::Identity(dimension, std::min(dimension, SHADOW_COMPONENTS));
  components_ = axes;
  for (int round = 0; round < ROUNDS; ++round) {
    const Eigen::MatrixXd turned = sample.transpose() * (sample * components_);
    components_ = Eigen::HouseholderQR<Eigen::MatrixXd>(turned).householderQ() * axes;
  }
}

void
FeatureSpace::centre(const float* descriptor, float* centred) const
{
  for (Eigen::Index d = 0; d < mean_.size(); ++d)
    centred[d] = static_cast<float>(descriptor[d] * scale_ - mean_[d]);
}

void
FeatureSpace::cast(const DistinctFeatures& features,
                   std::size_t begin,
                   std::size_t end,
                   Shadow* shadows) const
{
  Rows centred(static_cast<Eigen::Index>(end - begin), mean_.size());
  for (Eigen::Index i = 0; i < centred.rows(); ++i) {
    const float* values = features[begin + static_cast<std::size_t>(i)];
    for (Eigen::Index d = 0; d < mean_.size(); ++d)
      centred(i, d) = values[d] * scale_ - mean_[d];
  }
  const Rows leading = centred * components_;
  for (Eigen::Index i = 0; i < centred.rows(); ++i) {
    Shadow shadow = Shadow::Zero();
    shadow.head(leading.cols()) = leading.row(i).transpose().cast<float>();
    const double rest = centred.row(i).squaredNorm() - leading.row(i).squaredNorm();
    shadow[SHADOW_COMPONENTS] = static_cast<float>(std::sqrt(std::max(0.0, rest)));
    shadows[begin + static_cast<std::size_t>(i)] = shadow;
  }
}

double
FeatureSpace::slack() const
{
  // A shadow is rounded to single precision. Before, its last value is the root of a
  // difference: the difference errs by a few units in the last place of double precision
  // for each dimension, and that by the root.
  const double difference = std::ldexp(static_cast<double>(dimension()) + 16, -50);
  return std::ldexp(1.0, -23) + std::sqrt(difference);
}

} // namespace pcl_flashreg
