// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/likeness.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_flashreg {
namespace {

constexpr int CENTRES = 16, ROUNDS = 10;
/** \brief Descriptors that the centres are taken from: of a scan, and of all. */
constexpr std::size_t SAMPLES_OF_SCAN = 128, SAMPLES = 16384;

/** \brief A column a descriptor: roots of its values, its sum being 1, so that distances are
 * those of Hellinger. */
Eigen::MatrixXf
rootsOf(const FeatureView& features, std::size_t every)
{
  const auto dimension = static_cast<Eigen::Index>(features.dimension);
  const std::size_t count = (features.size + every - 1) / every;
  Eigen::MatrixXf roots(dimension, static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Map<const Eigen::VectorXf> row(
        features.data + i * every * features.stride, dimension);
    const float sum = row.cwiseAbs().sum();
    auto column = roots.col(static_cast<Eigen::Index>(i));
    column = (row.cwiseAbs() / (sum > 0 ? sum : 1)).cwiseSqrt();
    column = (row.array() < 0).select(-column, column);
    if (!column.allFinite())
      column.setZero();
  }
  return roots;
}

Eigen::Index
nearestOf(const Eigen::MatrixXf& centres, const Eigen::VectorXf& value)
{
  Eigen::Index nearest = 0;
  (centres.colwise() - value).colwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

/** \brief k-means from evenly spread samples. */
Eigen::MatrixXf
centresOf(const Eigen::MatrixXf& samples)
{
  const Eigen::Index count = std::min<Eigen::Index>(CENTRES, samples.cols());
  Eigen::MatrixXf centres(samples.rows(), count);
  for (Eigen::Index c = 0; c < count; ++c)
    centres.col(c) = samples.col(c * samples.cols() / count);
  for (int round = 0; round < ROUNDS; ++round) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(samples.rows(), count);
    Eigen::VectorXd members = Eigen::VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < samples.cols(); ++i) {
      const Eigen::Index c = nearestOf(centres, samples.col(i));
      sums.col(c) += samples.col(i).cast<double>();
      members[c] += 1;
    }
    for (Eigen::Index c = 0; c < count; ++c)
      if (members[c] > 0)
        centres.col(c) = (sums.col(c) / members[c]).cast<float>();
  }
  return centres;
}

Eigen::VectorXf
signatureOf(const Eigen::MatrixXf& descriptors, const Eigen::MatrixXf& centres)
{
  Eigen::MatrixXf offsets = Eigen::MatrixXf::Zero(centres.rows(), centres.cols());
  for (Eigen::Index i = 0; i < descriptors.cols(); ++i) {
    const Eigen::Index c = nearestOf(centres, descriptors.col(i));
    offsets.col(c) += descriptors.col(i) - centres.col(c);
  }
  for (Eigen::Index c = 0; c < offsets.cols(); ++c) {
    const float length = offsets.col(c).norm();
    if (length > 0)
      offsets.col(c) /= length;
  }
  const float length = offsets.norm();
  return Eigen::Map<const Eigen::VectorXf>(offsets.data(), offsets.size()) /
         (length > 0 ? length : 1);
}

} // namespace

Likeness::Likeness(std::size_t count,
                   const MultiviewRegistration::ScanSource& scans,
                   ThreadPool& pool)
{
  std::vector<Eigen::MatrixXf> samples(count);
  const std::size_t most = std::max<std::size_t>(
      1, std::min(SAMPLES_OF_SCAN, SAMPLES / std::max<std::size_t>(1, count)));
  pool.forEach(count, [&](std::size_t i, std::size_t) {
    const Scan scan = scans(i);
    const FeatureView features = scan.features();
    if (features.dimension > 0 && features.size > 0)
      samples[i] = rootsOf(features, (features.size + most - 1) / most);
  });
  Eigen::Index rows = 0, columns = 0;
  for (const Eigen::MatrixXf& sample : samples) {
    rows = std::max(rows, sample.rows());
    columns += sample.cols();
  }
  Eigen::MatrixXf all(rows, columns);
  columns = 0;
  for (const Eigen::MatrixXf& sample : samples)
    if (sample.cols() > 0) {
      all.middleCols(columns, sample.cols()) = sample;
      columns += sample.cols();
    }
  const Eigen::MatrixXf centres = centresOf(all);
  signatures_.setZero(centres.size(), static_cast<Eigen::Index>(count));
  if (centres.size() == 0)
    return;
  pool.forEach(count, [&](std::size_t i, std::size_t) {
    if (samples[i].cols() > 0)
      signatures_.col(static_cast<Eigen::Index>(i)) =
          signatureOf(rootsOf(scans(i).features(), 1), centres);
  });
}

std::vector<std::size_t>
Likeness::ranked(std::size_t scan) const
{
  std::vector<std::size_t> others(static_cast<std::size_t>(signatures_.cols()));
  std::iota(others.begin(), others.end(), std::size_t{0});
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(scan));
  std::stable_sort(others.begin(), others.end(), [&](std::size_t a, std::size_t b) {
    return (*this)(scan, a) > (*this)(scan, b);
  });
  return others;
}

} // namespace pcl_flashreg
