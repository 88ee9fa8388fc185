// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// This project's registration.

#include "../../io/hash.h"
#include "families.h"

#include <cmath>
#include <memory>
#include <optional>

namespace pcl_flashreg::evaluate {
namespace {

/** \brief What is known of the clouds is told to the estimator. */
enum class Clouds { Ignored, WithoutViewpoints, WithSourceViewpoint, WithViewpoints };

constexpr double RADIANS = 3.14159265358979323846 / 180;

/** \brief How well is known which way is up, in degrees. */
struct Gravity {
  /** \brief Of the direction in the target, towards a side that the pair's name draws. */
  double error;
  float max_tilt;
};

/** \brief The directions as two sensors tell them: in the target the y axis, which is
 * downwards for a camera that is held level. */
void
tellGravity(const Gravity& gravity, const Problem& problem, Parameters& parameters)
{
  const double side =
      RADIANS * static_cast<double>(io::hashOf(problem.name) % 3600) / 10;
  const double error = RADIANS * gravity.error;
  const Eigen::Vector3f target(Eigen::Vector3d(std::sin(error) * std::cos(side),
                                               std::cos(error),
                                               std::sin(error) * std::sin(side))
                                   .cast<float>());
  const Eigen::Vector3f source =
      (problem.truth.rotation.transpose() * Eigen::Vector3d::UnitY()).cast<float>();
  parameters.motion = MotionModel::Upright;
  parameters.max_tilt = gravity.max_tilt;
  parameters.target_gravity = {target.x(), target.y(), target.z()};
  parameters.source_gravity = {source.x(), source.y(), source.z()};
}

/** \brief A method's registration, and how it is told to go about. */
class Flashreg {
public:
  Flashreg(BackendKind backend,
           Clouds clouds,
           SecondOrder second_order,
           const std::optional<Gravity>& gravity,
           const MethodSettings& settings)
      : registration_(backend, settings.threads), clouds_(clouds), gravity_(gravity)
  {
    options_.resolution = settings.leaf;
    options_.parameters = settings.parameters;
    options_.parameters.second_order = second_order;
    options_.cloud_check = clouds != Clouds::Ignored;
  }

  Answer
  run(const Problem& problem)
  {
    const Scan source = told(problem.source, clouds_ >= Clouds::WithSourceViewpoint);
    const Scan target = told(problem.target, clouds_ == Clouds::WithViewpoints);
    if (gravity_)
      tellGravity(*gravity_, problem, options_.parameters);
    const Result result =
        problem.matches.empty()
            ? registration_
                  .align(source, target, problem.correspondences.view(), options_)
                  .pose
            : registration_.align(source, target, problem.matches, options_).pose;
    Answer answer;
    answer.found = result.status == Status::Ok;
    answer.T_target_source = result.T_target_source;
    answer.trusted = result.converged;
    answer.confidence = result.confidence;
    answer.inliers = result.inliers.size();
    answer.evidence = result.evidence;
    answer.estimation_ms = result.timings_ms.total;
    answer.stages_ms = result.timings_ms;
    return answer;
  }

private:
  static Scan
  told(const Scan& scan, bool with_viewpoint)
  {
    return with_viewpoint ? scan : scan.withoutViewpoint();
  }

  PairRegistration registration_;
  Clouds clouds_;
  std::optional<Gravity> gravity_;
  PairOptions options_;
};

MethodEntry
entry(const std::string& name,
      const std::string& description,
      BackendKind backend,
      Clouds clouds,
      SecondOrder second_order = SecondOrder::Auto,
      const std::optional<Gravity>& gravity = std::nullopt)
{
  const auto make = [=](const MethodSettings& settings) {
    const auto method =
        std::make_shared<Flashreg>(backend, clouds, second_order, gravity, settings);
    return [=](const Problem& problem) { return method->run(problem); };
  };
  return {name, description, false, make};
}

/** \brief The largest tilt leaves two degrees to what the scans are bent; gravity that is off
 * by 20 is wrong, and nobody knows. */
MethodEntry
upright(int error)
{
  const Gravity gravity{static_cast<double>(error),
                        error < 20 ? static_cast<float>(error + 2) : 3};
  return entry("flashreg_upright_" + std::to_string(error),
               "the same, and gravity is known, " + std::to_string(error) +
                   " degrees off the true direction",
               BackendKind::Auto,
               Clouds::WithViewpoints,
               SecondOrder::Auto,
               gravity);
}

} // namespace

std::vector<MethodEntry>
flashregMethods()
{
  return {
      entry(
          "flashreg",
          "this project, the best backend that runs here; clouds are asked where known",
          BackendKind::Auto,
          Clouds::WithViewpoints),
      {"flashreg_map",
       "the same, all clouds of a scene at a time, which make a map",
       true,
       {},
       true},
      upright(0),
      upright(1),
      upright(3),
      upright(20),
      entry("flashreg_source_viewpoint",
            "the same, but nobody knows where the sensor of the target stood",
            BackendKind::Auto,
            Clouds::WithSourceViewpoint),
      entry("flashreg_no_viewpoint",
            "the same, but nobody knows where the sensors stood",
            BackendKind::Auto,
            Clouds::WithoutViewpoints),
      entry("flashreg_fast",
            "the same from the correspondences alone",
            BackendKind::Auto,
            Clouds::Ignored),
      entry("flashreg_exact",
            "flashreg_fast on the CPU, exact second-order graph",
            BackendKind::Cpu,
            Clouds::Ignored,
            SecondOrder::Exact),
      entry("flashreg_bounded",
            "flashreg_fast on the CPU, bounded second-order graph",
            BackendKind::Cpu,
            Clouds::Ignored,
            SecondOrder::Bounded),
      entry("flashreg_cuda",
            "flashreg_fast on CUDA, where it is built in and a device is there",
            BackendKind::Cuda,
            Clouds::Ignored)};
}

} // namespace pcl_flashreg::evaluate
