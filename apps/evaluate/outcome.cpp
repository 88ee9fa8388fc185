// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "outcome.h"

#include <algorithm>
#include <cstdio>
#include <ostream>

namespace pcl_flashreg::evaluate {
namespace {

constexpr double DEGREES = 180 / 3.14159265358979323846;

double
inlierRatio(const Input& input, const RigidTransform& T, double inlier_distance)
{
  std::size_t inliers = 0;
  for (std::size_t i = 0; i < input.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> s(&input.source[3 * i]);
    const Eigen::Map<const Eigen::Vector3d> t(&input.target[3 * i]);
    inliers += (T.rotation * s + T.translation - t).norm() < inlier_distance;
  }
  return input.size() == 0
             ? 0
             : static_cast<double>(inliers) / static_cast<double>(input.size());
}

double
median(std::vector<double> values)
{
  if (values.empty())
    return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double
percent(std::size_t part, std::size_t whole)
{
  return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

} // namespace

Outcome
judge(const Answer& answer,
      const Pair& pair,
      const Input& input,
      double inlier_distance,
      const Criterion& criterion)
{
  const RigidTransform& found = answer.T_target_source;
  const RigidTransform& truth = pair.T_target_source;
  Outcome outcome;
  outcome.answer = answer;
  outcome.correspondences = input.size();
  outcome.inlier_ratio = inlierRatio(input, truth, inlier_distance);
  outcome.rotation_error =
      DEGREES * Eigen::AngleAxisd(found.rotation.transpose() * truth.rotation).angle();
  outcome.translation_error = (found.translation - truth.translation).norm();
  outcome.success = answer.found && outcome.rotation_error < criterion.max_rotation &&
                    outcome.translation_error < criterion.max_translation;
  return outcome;
}

void
printSummary(const std::string& dataset, const std::vector<Outcome>& outcomes)
{
  std::size_t successes = 0, trusted = 0, rightly = 0;
  double rotation = 0, translation = 0;
  std::vector<double> times;
  for (const Outcome& outcome : outcomes) {
    successes += outcome.success;
    trusted += outcome.answer.trusted;
    rightly += outcome.answer.trusted && outcome.success;
    rotation += outcome.success ? outcome.rotation_error : 0;
    translation += outcome.success ? outcome.translation_error : 0;
    times.push_back(outcome.answer.estimation_ms);
  }
  const double n = static_cast<double>(std::max<std::size_t>(1, successes));
  std::printf("%-16s %5zu pairs  recall %6.2f %%  RE %.2f deg  TE %.3f  "
              "verdict: precision %6.2f %% recall %6.2f %%  estimation %.2f ms\n",
              dataset.c_str(),
              outcomes.size(),
              percent(successes, outcomes.size()),
              rotation / n,
              translation / n,
              percent(rightly, trusted),
              percent(rightly, successes),
              median(times));
}

void
writeCsvHeader(std::ostream& csv)
{
  csv << "dataset,source,target,success,trusted,rotation_error_deg,translation_error,"
         "correspondences,inlier_ratio,inliers,distinctness,matching_ms,estimation_"
         "ms\n";
}

void
writeCsvRow(std::ostream& csv, const Pair& pair, const Outcome& o)
{
  csv << pair.dataset << ',' << pair.source << ',' << pair.target << ',' << o.success
      << ',' << o.answer.trusted << ',' << o.rotation_error << ','
      << o.translation_error << ',' << o.correspondences << ',' << o.inlier_ratio << ','
      << o.answer.inliers << ',' << o.answer.distinctness << ',' << o.matching_ms << ','
      << o.answer.estimation_ms << std::endl;
}

} // namespace pcl_flashreg::evaluate
