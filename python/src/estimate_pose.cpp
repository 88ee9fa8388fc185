// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "array.h"
#include "options.h"
#include "pair_argument.h"
#include "pair_object.h"

#include <pybind11/stl.h>

namespace pcl_flashreg::python {
namespace {

using namespace py::literals;

/** \brief Correspondences of the caller's, and the arrays that they are in. */
template <typename Scalar>
struct Pairs {
  Pairs(const py::array& source_points,
        const py::array& target_points,
        const std::optional<Rows<float>>& given_ranks)
      : source(rowsOf<Scalar>(source_points, RowLayout::Packed)),
        target(rowsOf<Scalar>(target_points, RowLayout::Packed)),
        ranks(given_ranks)
  {
  }

  CorrespondenceView<Scalar>
  view() const
  {
    return {source.data, target.data, source.size, ranks ? ranks->data : nullptr};
  }

  Rows<Scalar> source, target;
  std::optional<Rows<float>> ranks;
};

/** \brief The clouds that correspondences lie in, or none of both. */
struct PairClouds {
  PairClouds(py::handle from, py::handle to)
  {
    if (from.is_none() != to.is_none())
      throw py::value_error(std::string(from.is_none() ? "source" : "target") +
                            ": is None, and the other cloud is not; give both or none");
    if (from.is_none())
      return;
    source.emplace(from, "source");
    target.emplace(to, "target");
  }

  bool
  hasScan() const
  {
    return source && !(source->cloud() && target->cloud());
  }

  std::optional<PairArgument> source, target;
};

template <typename Scalar>
PairResult
estimate(PairRegistration& registration,
         const Pairs<Scalar>& pairs,
         const PairClouds& clouds,
         const PairOptions& options)
{
  std::optional<CloudInput<Scalar>> from, to;
  if (clouds.source) {
    from.emplace(*clouds.source->cloud());
    to.emplace(*clouds.target->cloud());
  }
  const ScanInput<Scalar> none;
  return run(options, [&](const PairOptions& each) {
    return registration.align(
        from ? from->input : none, to ? to->input : none, pairs.view(), each);
  });
}

PairResult
estimateWithScans(PairRegistration& registration,
                  const Pairs<double>& pairs,
                  const PairClouds& clouds,
                  const PairOptions& options)
{
  const double resolution = resolutionBeside(*clouds.source, *clouds.target, options);
  const auto from = clouds.source->scanMaker(ScanContent::Surface);
  const auto to = clouds.target->scanMaker(ScanContent::Surface);
  return run(options, [&](const PairOptions& each) {
    return registration.align(from(registration, resolution),
                              to(registration, resolution),
                              pairs.view(),
                              each);
  });
}

PairResult
estimatePose(PairObject& self,
             py::handle source_points,
             py::handle target_points,
             const std::optional<double>& resolution,
             py::handle ranks,
             py::handle source,
             py::handle target,
             py::handle parameters,
             py::handle guess,
             bool cloud_check)
{
  const Turn turn = self.turn();
  const PairOptions options = optionsOf(resolution, parameters, guess, cloud_check);
  const py::array from = floatTable(source_points, "source_points", 3);
  const py::array to = floatTable(target_points, "target_points", 3);
  if (from.shape(0) != to.shape(0))
    throw py::value_error("target_points: are " + std::to_string(to.shape(0)) +
                          ", but source_points are " + std::to_string(from.shape(0)));
  std::optional<Rows<float>> given_ranks;
  if (!ranks.is_none())
    given_ranks = columnOf(ranks, "ranks");
  if (given_ranks && given_ranks->size != static_cast<std::size_t>(from.shape(0)))
    throw py::value_error("ranks: are " + std::to_string(given_ranks->size) +
                          ", but correspondences are " + std::to_string(from.shape(0)));
  const PairClouds clouds(source, target);
  if (clouds.hasScan())
    return estimateWithScans(
        self.registration, Pairs<double>(from, to, given_ranks), clouds, options);
  if (isDouble(from) || isDouble(to) ||
      (clouds.source && (clouds.source->isDouble() || clouds.target->isDouble())))
    return estimate(
        self.registration, Pairs<double>(from, to, given_ranks), clouds, options);
  return estimate(
      self.registration, Pairs<float>(from, to, given_ranks), clouds, options);
}

const char* const ESTIMATE_POSE =
    R"(Finds the pose from correspondences, of which most may be wrong.

Args:
    source_points, target_points: N x 3 each, float32 or float64; row i of one belongs to row
        i of the other. Rows with a coordinate that is not finite are ignored.
    resolution: voxel size of the clouds that they come from; None to tell it by the spacing
        of the points.
    ranks: N, smaller is better (a distance in feature space); None: the order of the rows.
        They decide which rows are left out beyond Parameters.max_correspondences.
    source, target: the clouds, as align() takes them, which judge the pose; both or none.
    parameters, guess, cloud_check: as for align().

Returns:
    A Result, whose inliers are rows of the arrays.

Raises:
    As align().
)";

} // namespace

void
bindEstimatePose(py::class_<PairObject>& registration)
{
  registration.def("estimate_pose",
                   &estimatePose,
                   "source_points"_a,
                   "target_points"_a,
                   "resolution"_a = py::none(),
                   py::kw_only(),
                   "ranks"_a = py::none(),
                   "source"_a = py::none(),
                   "target"_a = py::none(),
                   "parameters"_a = py::none(),
                   "guess"_a = py::none(),
                   "cloud_check"_a = true,
                   ESTIMATE_POSE);
}

} // namespace pcl_flashreg::python
