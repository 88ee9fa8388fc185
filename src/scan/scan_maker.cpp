// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan/scan_maker.h"

#include "scan/left_out.h"
#include "scan/many_viewpoints.h"
#include "scan/points.h"
#include "scan/scan_data.h"
#include "scan/viewpoint.h"
#include "support/require.h"

#include <Eigen/Geometry>

#include <limits>
#include <type_traits>
#include <utility>

namespace pcl_flashreg {
namespace {

template <typename Scalar>
void
checkRows(const ScanInput<Scalar>& input)
{
  check(input.points);
  require(!input.normals || input.normal_stride >= 3,
          "normal_stride",
          input.normal_stride,
          "it must be >= 3");
  const FeatureView& features = input.features;
  if (features.dimension == 0)
    return;
  require(features.size == input.points.size,
          "features.size",
          features.size,
          "there must be one descriptor a point, of which there are " +
              std::to_string(input.points.size));
  require(features.size == 0 ||
              (features.data && features.stride >= features.dimension),
          "features.stride",
          features.stride,
          "descriptors need data and a stride >= their dimension");
}

template <typename Scalar>
Eigen::Vector3d
toEigen(const Scalar* point)
{
  return Eigen::Map<const Eigen::Matrix<Scalar, 3, 1>>(point).template cast<double>();
}

/** \brief What keypoints that are the caller's points take over from these. */
void
keepRows(const PreparedInput& input, Scan::Data& data)
{
  const FeatureView& features = input.features;
  data.dimension = features.dimension;
  std::vector<std::int32_t> origins;
  for (std::size_t i = 0; i < countOf(input.points); ++i)
    if (isFinite(pointOf(input.points, i)))
      origins.push_back(static_cast<std::int32_t>(indexOf(input.points, i)));
  std::vector<float> descriptors;
  descriptors.reserve(origins.size() * data.dimension);
  for (const std::int32_t origin : origins) {
    const float* row =
        features.data + static_cast<std::size_t>(origin) * features.stride;
    descriptors.insert(descriptors.end(), row, row + data.dimension);
  }
  data.origins = std::move(origins);
  data.descriptors = std::move(descriptors);
}

/** \brief Keypoints and what was computed of them; descriptors of the caller's stay. */
void
takeKeypoints(DescribedCloud keypoints, ScanContent content, Scan::Data& data)
{
  data.points = std::move(keypoints.points);
  data.normals = std::move(keypoints.normals);
  data.curvatures = std::move(keypoints.curvatures);
  if (content != ScanContent::Descriptors)
    return;
  data.descriptors = std::move(keypoints.descriptors);
  data.dimension = keypoints.features().dimension;
}

} // namespace

template <typename Scalar>
Eigen::Vector3d
singlePrecisionShift(const BasicPointView<Scalar>& points)
{
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  constexpr Scalar ENDLESS = std::numeric_limits<Scalar>::infinity();
  Vector low = Vector::Constant(ENDLESS), high = -low;
  for (std::size_t i = 0; i < countOf(points); ++i) {
    const Eigen::Map<const Vector> point(pointOf(points, i));
    // Zero, unless a coordinate is not finite: cheaper than to ask each of them.
    if ((0 * point).sum() == 0) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  if (!(low.x() <= high.x()))
    return Eigen::Vector3d::Zero();
  // A hundred-thousandth of the extent: finer than any sensor resolves.
  constexpr double FLOAT_STEP = std::numeric_limits<float>::epsilon();
  constexpr double TOLERABLE = 1e-5;
  const Eigen::AlignedBox3d box(low.template cast<double>(),
                                high.template cast<double>());
  const double farthest =
      box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  const bool far = farthest * FLOAT_STEP > TOLERABLE * box.sizes().maxCoeff();
  return far ? box.center() : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

template Eigen::Vector3d
singlePrecisionShift(const BasicPointView<float>&);
template Eigen::Vector3d
singlePrecisionShift(const BasicPointView<double>&);

template <typename Scalar>
PreparedInput::PreparedInput(const ScanInput<Scalar>& input)
    : viewpoint(input.viewpoint),
      viewpoint_known(input.viewpoint_known),
      many_viewpoints(input.many_viewpoints),
      features(input.features),
      made(input.made)
{
  checkRows(input);
  for (const double coordinate : {viewpoint.x(), viewpoint.y(), viewpoint.z()})
    require(std::isfinite(coordinate), "viewpoint", coordinate, "it must be finite");
  BasicPointView<Scalar> given = input.points;
  left_out = findLeftOut(given, kept);
  if (left_out.repeated + left_out.stray > 0) {
    given.indices = kept.data();
    given.index_count = kept.size();
  }
  shift = singlePrecisionShift(given);
  if (!shift.isZero(0) && viewpoint.isZero(0)) {
    viewpoint = shift;
    viewpoint_possible = false;
  }
  normals = {input.normals, input.normal_stride};
  if constexpr (std::is_same_v<Scalar, float>)
    if (shift.isZero(0)) {
      points = given;
      return;
    }
  copy.resize(3 * given.size);
  float* row = copy.data();
  for (std::size_t i = 0; i < given.size; ++i, row += 3)
    Eigen::Map<Eigen::Vector3f>(row, 3) =
        (toEigen(given.data + i * given.stride) - shift).template cast<float>();
  points = {copy.data(), given.size, 3, given.indices, given.index_count};
}

template PreparedInput::PreparedInput(const ScanInput<float>&);
template PreparedInput::PreparedInput(const ScanInput<double>&);

Scan
ScanMaker::make(const PreparedInput& input,
                double resolution,
                ScanContent content,
                FeatureTimings& timings)
{
  FeatureParameters parameters = FeatureParameters::fromResolution(resolution);
  const bool wants_features = content == ScanContent::Descriptors;
  if (input.made && input.made->spacing() == resolution &&
      wants_features == (input.made->features().dimension > 0))
    return *input.made;
  const auto data = std::make_shared<Scan::Data>();
  data->spacing = resolution;
  data->shift = input.shift;
  const bool are_keypoints = wants_features && input.features.dimension > 0;
  if (are_keypoints) {
    parameters.voxel_size = 0;
    content = ScanContent::Surface;
    keepRows(input, *data);
  }
  findSurface(stages_, input.points, input.normals, parameters, content, timings);
  Seen seen;
  double turning = 0;
  timeStep(turning, [&] { seen = turnToViewpoint(input, resolution); });
  timings.normals += turning;
  if (content == ScanContent::Descriptors)
    describeSurface(stages_, parameters, timings);
  takeKeypoints(stages_.takeResult(content, are_keypoints), content, *data);
  data->normals_oriented = seen.normals_oriented;
  return {data, seen.from, seen.source};
}

Scan
ScanMaker::coarser(const Scan& scan, double factor)
{
  const double resolution = factor * scan.spacing();
  const FeatureParameters parameters = FeatureParameters::fromResolution(resolution);
  const PointView points{scan.points(), scan.size(), 3, nullptr, 0};
  FeatureTimings timings;
  findSurface(stages_,
              points,
              {scan.normals(), 3},
              parameters,
              ScanContent::Descriptors,
              timings);
  describeSurface(stages_, parameters, timings);
  const auto data = std::make_shared<Scan::Data>();
  data->spacing = resolution;
  data->shift = scan.shift();
  takeKeypoints(stages_.takeResult(ScanContent::Descriptors, false),
                ScanContent::Descriptors,
                *data);
  return {data, Eigen::Vector3d::Zero(), ViewpointSource::Unknown};
}

void
ScanMaker::turnToManyViewpoints(double resolution)
{
  const std::vector<std::uint32_t> computed = stages_.computedNormals();
  std::vector<Eigen::Vector3f> points, normals;
  for (const std::uint32_t keypoint : computed) {
    points.push_back(stages_.pointAt(keypoint));
    normals.push_back(stages_.normalAt(keypoint));
  }
  const std::vector<bool> away =
      facingAway(points, normals, static_cast<float>(resolution), pool_);
  for (std::size_t i = 0; i < computed.size(); ++i)
    if (away[i])
      stages_.turnNormal(computed[i]);
}

ScanMaker::Seen
ScanMaker::turnToViewpoint(const PreparedInput& input, double resolution)
{
  if (input.many_viewpoints) {
    turnToManyViewpoints(resolution);
    return {input.viewpoint, ViewpointSource::Unknown};
  }
  const Eigen::Vector3f stated = (input.viewpoint - input.shift).cast<float>();
  // Nobody needs a place, as given normals stay as they are; or somebody wants normals to
  // be turned to one that is not the sensor's.
  const bool is_wish = input.viewpoint_possible && !input.viewpoint.isZero(0);
  if (!input.viewpoint_known && (is_wish || !stages_.hasComputedNormals())) {
    stages_.turnNormals(stated, false);
    return {input.viewpoint, ViewpointSource::Unknown};
  }
  const cpu::Visibility visibility = stages_.visibility(VIEWPOINT_ELEMENTS, resolution);
  const FoundViewpoint found =
      findViewpoint(visibility, stated, input.viewpoint_possible, pool_);
  stages_.turnNormals(found.place, input.viewpoint_known && found.is_stated);
  Seen seen{found.is_stated ? input.viewpoint
                            : input.shift + found.place.cast<double>()};
  seen.normals_oriented = found.sees_all || !stages_.hasComputedNormals();
  if (input.viewpoint_known && found.sees_all)
    seen.source = found.is_stated ? ViewpointSource::Stated : ViewpointSource::Points;
  return seen;
}

} // namespace pcl_flashreg
