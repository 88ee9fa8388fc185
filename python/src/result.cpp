// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "result.h"

#include "bindings.h"
#include "choice.h"

#include <pybind11/stl.h>

#include <cmath>
#include <cstdio>

namespace pcl_flashreg::python {
namespace {

constexpr double DEGREES = 180 / 3.14159265358979323846;

std::string
resultText(const PairResult& result)
{
  const Result& pose = result.pose;
  if (pose.status != Status::Ok)
    return std::string("Result(no pose: ") + toString(pose.status) + ")";
  return std::string("Result(") + (pose.converged ? "converged" : "not converged") +
         ", confidence " + rounded(pose.confidence, 2) + ", " +
         std::to_string(pose.inliers.size()) + " of " +
         std::to_string(result.correspondences) + " correspondences agree, " +
         poseText(pose.T_target_source) + ")";
}

py::dict
timingsOf(const PairTimings& timings)
{
  py::dict ms;
  const auto of_scan = [](const FeatureTimings& t) {
    return t.voxel_grid + t.neighbor_grid + t.normals + t.point_histograms +
           t.feature_histograms;
  };
  ms["resolution"] = timings.resolution;
  ms["source_scan"] = of_scan(timings.source);
  ms["target_scan"] = of_scan(timings.target);
  ms["matching"] = timings.matching;
  for (const Stage& stage : STAGES)
    ms[stage.name] = timings.estimation.*stage.milliseconds;
  ms["total"] = timings.total;
  return ms;
}

/** \brief A property that is read from Result, the part of PairResult that estimates. */
template <typename Member>
auto
ofPose(Member Result::*member)
{
  return [member](const PairResult& result) { return result.pose.*member; };
}

void
bindEvidence(py::module_& module)
{
  py::class_<CloudAgreement>(
      module, "CloudAgreement", "How two clouds get on with each other under a pose.")
      .def_readonly("matched",
                    &CloudAgreement::matched,
                    "Share of the points that lie on the other surface, in [0, 1].")
      .def_readonly("contradicted",
                    &CloudAgreement::contradicted,
                    "Share of the points that lie where the other sensor saw nothing.")
      .def_readonly(
          "residual",
          &CloudAgreement::residual,
          "Distance from the other surface, root mean square, in resolutions.")
      .def("__repr__", [](const CloudAgreement& a) {
        return "CloudAgreement(matched " + rounded(a.matched, 3) + ", contradicted " +
               rounded(a.contradicted, 3) + ", residual " + rounded(a.residual, 3) +
               ")";
      });

  using E = Evidence;
  py::class_<E>(
      module,
      "Evidence",
      "What the confidence is computed from; docs/method.md has the meanings.")
      .def_readonly("inliers", &E::inliers)
      .def_readonly("inlier_ratio", &E::inlier_ratio)
      .def_readonly("rival_inliers", &E::rival_inliers)
      .def_readonly("thickness", &E::thickness)
      .def_readonly("breadth", &E::breadth)
      .def_readonly("log_chance", &E::log_chance)
      .def_readonly("mirrored", &E::mirrored)
      .def_readonly("tilted", &E::tilted)
      .def_readonly("has_clouds", &E::has_clouds)
      .def_readonly("has_viewpoints", &E::has_viewpoints)
      .def_readonly("one_viewpoint", &E::one_viewpoint)
      .def_readonly("overruled_viewpoints", &E::overruled_viewpoints)
      .def_readonly("has_sides", &E::has_sides)
      .def_readonly("overruled_sides", &E::overruled_sides)
      .def_readonly("in_map", &E::in_map)
      .def_readonly("second_look", &E::second_look)
      .def_readonly("agreement", &E::agreement)
      .def_readonly("lead", &E::lead)
      .def_readonly("rivals", &E::rivals)
      .def_readonly("hold", &E::hold)
      .def_readonly("stiffness", &E::stiffness)
      .def("__repr__", [](const E& e) {
        return "Evidence(inliers " + rounded(e.inliers, 0) + ", rival_inliers " +
               rounded(e.rival_inliers, 0) + ", matched " +
               rounded(e.agreement.matched, 3) + ", contradicted " +
               rounded(e.agreement.contradicted, 3) + ", rivals " +
               rounded(e.rivals, 3) + ", hold " + rounded(e.hold, 3) + ")";
      });
}

void
bindHypothesis(py::module_& module)
{
  py::class_<Hypothesis>(module, "Hypothesis", "A pose, and what speaks for it.")
      .def_property_readonly(
          "T_target_source",
          [](const Hypothesis& h) { return matrixOf(h.T_target_source); },
          "4 x 4 float64: target = T @ source.")
      .def_readonly(
          "inlier_count", &Hypothesis::inlier_count, "Correspondences that agree.")
      .def_readonly("score", &Hypothesis::score, "By Parameters.score_metric.")
      .def_property_readonly(
          "agreement",
          [](const Hypothesis& h) { return h.agreement; },
          "What the clouds say; None if they were not asked.")
      .def("__repr__", [](const Hypothesis& h) {
        return "Hypothesis(" + std::to_string(h.inlier_count) +
               " correspondences agree, " + poseText(h.T_target_source) + ")";
      });
}

void
bindFreeMotion(py::module_& module)
{
  using F = FreeMotion;
  py::class_<F>(
      module, "FreeMotion", "A way to move the source that neither cloud opposes.")
      .def_property_readonly(
          "kind",
          [](const F& f) { return wordOf(FREE_MOTIONS, f.kind); },
          "'slide' or 'turn'.")
      .def_property_readonly(
          "direction",
          [](const F& f) { return arrayOf(f.direction); },
          "Of the slide or of the axis, of length 1, in the target's frame.")
      .def_property_readonly(
          "point",
          [](const F& f) { return arrayOf(f.point); },
          "On the axis; of a slide the middle of the points that match.")
      .def_readonly("backward",
                    &F::backward,
                    "How far it goes against the direction; a length or radians.")
      .def_readonly("forward", &F::forward, "How far it goes along the direction.")
      .def("__repr__", [](const F& f) {
        return std::string("FreeMotion(") + wordOf(FREE_MOTIONS, f.kind) + " along [" +
               rounded(f.direction.x(), 2) + ", " + rounded(f.direction.y(), 2) + ", " +
               rounded(f.direction.z(), 2) + "], from " + rounded(-f.backward, 3) +
               " to " + rounded(f.forward, 3) + ")";
      });
}

} // namespace

py::array
pairsOf(const std::vector<FeatureMatch>& matches, py::handle owner)
{
  static_assert(offsetof(FeatureMatch, match) == sizeof(std::int32_t));
  return viewOf(matches.empty() ? nullptr : &matches[0].query,
                {static_cast<py::ssize_t>(matches.size()), 2},
                owner,
                {sizeof(FeatureMatch), sizeof(std::int32_t)});
}

py::array
squaredDistancesOf(const std::vector<FeatureMatch>& matches, py::handle owner)
{
  return viewOf(matches.empty() ? nullptr : &matches[0].squared_distance,
                {static_cast<py::ssize_t>(matches.size())},
                owner,
                {sizeof(FeatureMatch)});
}

py::tuple
tupleOf(std::vector<FeatureMatch>&& matches)
{
  using Matches = std::vector<FeatureMatch>;
  auto* kept = new Matches(std::move(matches));
  const py::capsule owner(kept, [](void* p) { delete static_cast<Matches*>(p); });
  return py::make_tuple(pairsOf(*kept, owner), squaredDistancesOf(*kept, owner));
}

py::array
arrayOf(const InformationMatrix& information)
{
  py::array_t<double> array({6, 6});
  using Matrix = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  Eigen::Map<Matrix>(array.mutable_data()) = information;
  return std::move(array);
}

std::string
rounded(double value, int digits)
{
  // Not by printf, which asks the user's language for the decimal point.
  PyObject* text = nullptr;
  char* digits_of = PyOS_double_to_string(value, 'f', digits, 0, nullptr);
  text = PyUnicode_FromString(digits_of);
  PyMem_Free(digits_of);
  return py::reinterpret_steal<py::str>(text);
}

std::string
poseText(const RigidTransform& pose)
{
  const Eigen::Vector3d& t = pose.translation;
  const double angle = Eigen::AngleAxisd(pose.rotation).angle();
  return rounded(angle * DEGREES, 1) + " deg, [" + rounded(t.x(), 3) + ", " +
         rounded(t.y(), 3) + ", " + rounded(t.z(), 3) + "]";
}

void
bindResult(py::module_& module)
{
  bindEvidence(module);
  bindHypothesis(module);
  bindFreeMotion(module);
  py::class_<PairResult>(
      module,
      "Result",
      "The pose of the source in the target's frame, the verdict, and why.")
      .def_property_readonly(
          "T_target_source",
          [](const PairResult& r) { return matrixOf(r.pose.T_target_source); },
          "4 x 4 float64: target = T @ source; identity unless status is 'ok'.")
      .def_property_readonly("converged",
                             ofPose(&Result::converged),
                             "The verdict: whether to trust the pose.")
      .def_property_readonly("confidence",
                             ofPose(&Result::confidence),
                             "Probability that the pose is right, in [0, 1].")
      .def_property_readonly(
          "status",
          [](const PairResult& r) { return wordOf(STATUSES, r.pose.status); },
          "'ok' if there is a pose; or why there is none.")
      .def_property_readonly(
          "inliers",
          [](py::object self) {
            const auto& inliers = self.cast<const PairResult&>().pose.inliers;
            return viewOf(
                inliers.data(), {static_cast<py::ssize_t>(inliers.size())}, self);
          },
          "Rows of the correspondences (of matches, if there are) that agree with the\n"
          "pose, int32, ascending.")
      .def_property_readonly(
          "matches",
          [](py::object self) {
            return pairsOf(self.cast<const PairResult&>().matches, self);
          },
          "M x 2 int32: rows of source and target keypoints that were matched; empty\n"
          "where the caller brought correspondences.")
      .def_readonly(
          "correspondences", &PairResult::correspondences, "Number of correspondences.")
      .def_property_readonly(
          "information",
          [](const PairResult& r) { return arrayOf(r.pose.information); },
          "6 x 6 float64, inverse covariance of the pose: of rotation and "
          "translation,\n"
          "applied on the left, about the target frame's origin.")
      .def_property_readonly(
          "score", ofPose(&Result::score), "Of the pose, by Parameters.score_metric.")
      .def_property_readonly("distinctness",
                             ofPose(&Result::distinctness),
                             "Inliers over those of the best pose that disagrees.")
      .def_property_readonly("hypotheses",
                             ofPose(&Result::hypotheses),
                             "The best distinct poses, the best first.")
      .def_property_readonly("free_motions",
                             ofPose(&Result::free_motions),
                             "Motions that the clouds leave free, the freest first.")
      .def_property_readonly("evidence",
                             ofPose(&Result::evidence),
                             "What the confidence is computed from.")
      .def_property_readonly(
          "backend", ofPose(&Result::backend), "Which backend ran, e.g. 'cpu-avx512'.")
      .def_readonly("source", &PairResult::source, "The source as it was registered.")
      .def_readonly("target", &PairResult::target, "The target as it was registered.")
      .def_readonly("resolution",
                    &PairResult::resolution,
                    "Voxel size, in the unit of the clouds; 0 if it is not known.")
      .def_property_readonly(
          "timings_ms",
          [](const PairResult& r) { return timingsOf(r.timings); },
          "Milliseconds of each part by its name; 'total' for the whole call.")
      .def("__repr__", &resultText);
}

} // namespace pcl_flashreg::python
