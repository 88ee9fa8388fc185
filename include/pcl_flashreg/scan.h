// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/export.h>
#include <pcl_flashreg/feature_matching.h>
#include <pcl_flashreg/point_view.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pcl_flashreg {

/** \brief The middle of the bounding box of the finite points, if they lie so far from the
 * origin that the steps of single precision there are more than a hundred-thousandth of
 * their extent; zero if not. A Scan of them has this shift. */
template <typename Scalar>
PCL_FLASHREG_EXPORT Eigen::Vector3d
singlePrecisionShift(const BasicPointView<Scalar>& points);

/** \brief What a Scan holds beside keypoints and normals. */
enum class ScanContent {
  /** \brief Descriptors to match: the caller's, or FPFH. */
  Descriptors,
  /** \brief Nothing: for correspondences that the caller has. */
  Surface
};

/** \brief How it is known where the sensor stood. */
enum class ViewpointSource {
  /** \brief It is not: nobody said so, or the points were seen from many places. */
  Unknown,
  /** \brief It was stated, and the points agree. */
  Stated,
  /** \brief It was stated, but the points were not seen from there: they say from where. */
  Points
};

/** \brief A file is not what Scan::save() wrote, or can't be read or written. */
class PCL_FLASHREG_EXPORT ScanFileError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief All that a registration needs to know of one cloud, made once by
 * PairRegistration::makeScan() and used in any number of registrations.
 *
 * Never changes once it is made: copies share their memory, and any number of threads may
 * use it at a time.
 */
class PCL_FLASHREG_EXPORT Scan {
public:
  /** \brief Without any keypoint: nothing is known of the cloud. */
  Scan();
  // No moves: a copy costs no more, and leaves nobody without data.
  Scan(const Scan&) = default;
  Scan&
  operator=(const Scan&) = default;

  /** \brief Number of keypoints. */
  std::size_t
  size() const;

  bool
  empty() const
  {
    return size() == 0;
  }

  /** \brief size() x 3, row-major: keypoints, in single precision, relative to shift(). */
  const float*
  points() const;

  /** \brief size() x 3, row-major: unit normals; not finite where there is none. Towards
   * the viewpoint, where one was given. */
  const float*
  normals() const;

  /** \brief Whether normals point to the side from which the surfaces were seen: they were
   * given, or one place sees nearly all of the points. Of a map of several rooms, none does. */
  bool
  normalsOriented() const;

  /** \brief Of each keypoint the smallest eigenvalue of the covariance of its neighbours
   * over their sum; 0 where the normal was given. */
  const float*
  curvatures() const;

  /** \brief Descriptors of the keypoints; of dimension 0 if the scan holds none. */
  FeatureView
  features() const;

  /** \brief Which point of the caller's cloud each keypoint is; null where keypoints are
   * centroids of voxels. */
  const std::int32_t*
  origins() const;

  /** \brief Distance of neighbouring keypoints (the voxel size), in the unit of the cloud;
   * 0 of an empty scan. */
  double
  spacing() const;

  /** \brief What to add to points() to get coordinates of the caller's frame: zero unless
   * these are too large for single precision (geo-referenced clouds). */
  const Eigen::Vector3d&
  shift() const;

  /** \brief Where the sensor stood, in the caller's frame; nothing if that is not known. */
  const std::optional<Eigen::Vector3d>&
  viewpoint() const
  {
    return viewpoint_;
  }

  ViewpointSource
  viewpointSource() const
  {
    return viewpoint_source_;
  }

  /** \brief A keypoint in the caller's frame. */
  Eigen::Vector3d
  point(std::size_t i) const
  {
    return Eigen::Map<const Eigen::Vector3f>(points() + 3 * i).cast<double>() + shift();
  }

  /** \brief The same scan, of whose sensor nothing is known: it did not stand where it was
   * said to have. Costs nothing. */
  Scan
  withoutViewpoint() const;

  /** \brief The part of the scan whose keypoints lie within a ball; in the same frame, with the
   * same shift, seen from the same place.
   * \param[in] centre in the caller's frame
   * \param[in] radius in the unit of the cloud, >= 0 */
  Scan
  within(const Eigen::Vector3d& centre, double radius) const;

  /** \brief The scan as bytes, the same for the same scan on every machine: a header with
   * the version of the format, the arrays, a checksum. */
  std::string
  serialize() const;

  /** \brief The reverse, to the last bit.
   * \throws ScanFileError that says whether the bytes are no scan, of another version,
   * incomplete or damaged
   */
  static Scan
  deserialize(std::string_view bytes);

  /** \brief Writes serialize() to a file, under another name first, so that a crash leaves
   * none that is half written.
   * \throws ScanFileError with the path and the system's reason
   */
  void
  save(const std::string& path) const;

  /** \throws ScanFileError as deserialize(), with the path; if the file can't be read */
  static Scan
  load(const std::string& path);

  /** \brief The arrays; known to the library alone. */
  struct Data;
  Scan(std::shared_ptr<const Data> data,
       const Eigen::Vector3d& viewpoint,
       ViewpointSource source);

private:
  std::shared_ptr<const Data> data_;
  std::optional<Eigen::Vector3d> viewpoint_;
  ViewpointSource viewpoint_source_ = ViewpointSource::Unknown;
};

/** \brief What somebody has of one cloud, for a Scan to be made from; nothing is copied or
 * owned.
 * \tparam Scalar float or double
 */
template <typename Scalar>
struct ScanInput {
  /** \brief The points; those with a coordinate that is not finite are skipped. */
  BasicPointView<Scalar> points;

  /** \brief Normals of any length, one a point of the whole cloud, whatever the indices;
   * null (the default) where there are none. Those that are missing, not finite or zero are
   * computed; of those in one voxel the mean is taken. Turned if the viewpoint is known. */
  const float* normals = nullptr;
  /** \brief Floats from one normal to the next, >= 3. */
  std::size_t normal_stride = 3;

  /** \brief Descriptors of the caller's, one a point of the whole cloud, whatever the
   * indices: the points are then the keypoints. Of dimension 0 (the default) where there
   * are none. */
  FeatureView features;

  /** \brief Where the sensor is said to have stood, in the frame of the points (a PCL cloud's
   * sensor_origin_). Computed normals are turned there; unless the points can't have been
   * seen from there: then to where they say that they were. A place other than the origin
   * that is not known to be the sensor's is where normals are turned, whatever the points
   * say. */
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  /** \brief Whether anybody says so: then what lies between the sensor and the points is
   * empty. The points have the last word (docs/method.md, ViewpointSource). The origin of a
   * cloud with a singlePrecisionShift() is never believed: nobody sees that far. */
  bool viewpoint_known = false;

  /** \brief Whether the points were seen from many places that nobody knows, as those of a map:
   * computed normals are then turned to where somebody can have stood who saw them, whatever
   * the viewpoint, and the scan knows no viewpoint. Takes a few times as long as all else. */
  bool many_viewpoints = false;

  /** \brief A scan that was made from the same input: it is taken in place of a new one
   * where its spacing and its content suit. Null (the default) where there is none. */
  const Scan* made = nullptr;
};

} // namespace pcl_flashreg
