// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "targets.h"

#include "io/cloud_io.h"
#include "io/correspondence_io.h"
#include "io/error.h"
#include "io/pcd.h"
#include "io/ply.h"
#include "io/raw_bin.h"
#include "io/transform_io.h"
#include "support/checksum.h"

#include <pcl_flashreg/pair_registration.h>

#include <Eigen/LU>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace pcl_flashreg::fuzz {
namespace {

void
require(bool condition, const char* what)
{
  if (!condition)
    throw std::logic_error(what);
}

/** \brief What a reader may give: consistent sizes, and points that can be worked on.
 */
void
checkCloud(const io::Cloud& cloud)
{
  require(cloud.data.size() == cloud.size() * cloud.point_size,
          "data has another size");
  std::size_t offset = 0;
  for (const io::Field& field : cloud.fields) {
    require(field.offset == offset, "fields do not follow each other");
    offset += field.byteSize();
  }
  require(offset == cloud.point_size, "fields do not fill the point");
  const bool has_xyz = cloud.find("x") && cloud.find("y") && cloud.find("z");
  if (!has_xyz)
    return;
  require(static_cast<std::size_t>(io::coordinates(cloud).cols()) == cloud.size(),
          "coordinates are missing");
  io::Cloud moved = cloud;
  io::transformCloud(moved, RigidTransform());
  require(moved.size() == cloud.size(), "points were lost");
}

void
checkRoundTrip(const io::Cloud& cloud)
{
  if (cloud.size() == 0 || cloud.fields.empty())
    return;
  const io::Cloud again = io::parsePcd(io::formatPcd(cloud));
  require(again.data == cloud.data, "writing and reading changes the data");
}

/** \brief PCD's header is made of words: names that a file of another format may have,
 * with blanks or none, can't be written. */
bool
hasPlainNames(const io::Cloud& cloud)
{
  return std::all_of(
      cloud.fields.begin(), cloud.fields.end(), [](const io::Field& field) {
        return field.name != "_" && !field.name.empty() &&
               std::all_of(field.name.begin(), field.name.end(), [](char c) {
                 return c > ' ' && c < 127;
               });
      });
}

template <typename Parse>
void
readCloudWith(Parse parse, std::string_view bytes)
{
  try {
    const io::Cloud cloud = parse(bytes);
    checkCloud(cloud);
    if (hasPlainNames(cloud))
      checkRoundTrip(cloud);
  }
  catch (const io::InputError&) {
  }
}

} // namespace

void
readPcd(std::string_view bytes)
{
  readCloudWith(io::parsePcd, bytes);
}

void
readPly(std::string_view bytes)
{
  readCloudWith(io::parsePly, bytes);
}

void
readRawBin(std::string_view bytes)
{
  readCloudWith([](std::string_view raw) { return io::parseRawBin(raw); }, bytes);
  readCloudWith([](std::string_view raw) { return io::parseRawBin(raw, 5); }, bytes);
}

void
readCorrespondences(std::string_view bytes)
{
  try {
    const io::NumberTable table = io::parseNumberTable(bytes);
    require(table.values.size() == table.rows() * table.columns, "the table has gaps");
    if (table.columns == 3) {
      require(io::fromPointTables(table, table).size() == table.rows(),
              "rows were lost");
      return;
    }
    const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 100);
    const io::Correspondences read =
        io::formOf(table) == io::CorrespondenceForm::Coordinates
            ? io::fromCoordinates(table)
            : io::fromIndices(table, points, points);
    require(read.size() == table.rows(), "rows were lost");
  }
  catch (const io::InputError&) {
  }
}

void
readTransform(std::string_view bytes)
{
  try {
    const RigidTransform transform = io::parseTransform(bytes);
    require((transform.rotation.transpose() * transform.rotation).isIdentity(1e-9),
            "no rotation");
    require(transform.translation.allFinite(), "no translation");
    io::parseTransform(io::formatTransform(transform));
  }
  catch (const io::InputError&) {
  }
}

void
readScan(std::string_view bytes)
{
  static PairRegistration registration(BackendKind::Cpu, 1);
  const auto read = [](std::string_view file) {
    try {
      const Scan scan = Scan::deserialize(file);
      const std::string written = scan.serialize();
      require(Scan::deserialize(written).serialize() == written,
              "writing and reading changes the bytes");
      if (scan.empty() || scan.size() > 200)
        return;
      PairOptions options;
      options.neighbors = 2;
      const PairResult result = registration.align(scan, scan, options);
      require(result.pose.T_target_source.rotation.allFinite(), "no rotation");
    }
    catch (const ScanFileError&) {
    }
    catch (const std::invalid_argument&) {
      // A spacing that nothing can be measured with.
    }
  };
  read(bytes);
  // Mutations would hardly ever get past the checksum by themselves.
  std::string sealed(bytes.substr(0, bytes.size() / 8 * 8));
  const std::uint64_t checksum = checksumOf(sealed.data(), sealed.size());
  sealed.append(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
  read(sealed);
}

void
estimate(std::string_view bytes)
{
  static Estimator estimator(BackendKind::Cpu, 1);
  std::vector<float> values(
      std::min<std::size_t>(bytes.size() / sizeof(float), 6 * 200));
  if (!values.empty())
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  const std::size_t n = values.size() / 6;
  const CorrespondenceView<float> view{
      values.data(), values.data() + 3 * n, n, nullptr};
  for (const SecondOrder second_order : {SecondOrder::Exact, SecondOrder::Bounded}) {
    Parameters parameters;
    parameters.second_order = second_order;
    const Result result = estimator.estimate(view, parameters);
    require(result.T_target_source.rotation.allFinite() &&
                result.T_target_source.translation.allFinite(),
            "the pose is not finite");
    require(
        (result.T_target_source.rotation.transpose() * result.T_target_source.rotation)
            .isIdentity(1e-5),
        "the pose is not rigid");
    require(result.T_target_source.rotation.determinant() > 0, "the pose is a mirror");
    require(!result.converged || result.status == Status::Ok, "trusted without a pose");
    require(result.correspondences_used + result.correspondences_invalid +
                    result.correspondences_dropped ==
                n,
            "correspondences were lost");
  }
}

} // namespace pcl_flashreg::fuzz
