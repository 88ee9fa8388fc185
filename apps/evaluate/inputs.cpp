// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "inputs.h"

#include "../io/cloud_io.h"
#include "../io/correspondence_io.h"
#include "../io/file.h"
#include "../io/number_table.h"
#include "../io/pcl_cloud.h"

#include <pcl_flashreg/feature_matching.h>

namespace pcl_flashreg::evaluate {
namespace {

void
append(std::vector<double>& xyz, const Eigen::Vector3d& point)
{
  xyz.insert(xyz.end(), point.data(), point.data() + 3);
}

FeatureView
viewOf(const FpfhCloud& cloud)
{
  const auto& features = *cloud.features;
  return {features.empty() ? nullptr : features[0].histogram,
          features.size(),
          33,
          sizeof(pcl::FPFHSignature33) / sizeof(float)};
}

} // namespace

const FeatureStore::Entry&
FeatureStore::get(const std::string& path)
{
  const auto found = entries_.find(path);
  if (found != entries_.end())
    return found->second;
  const io::ShiftedCloud cloud =
      io::toPclCloud(io::coordinates(io::readCloud(root_ + "/" + path)));
  return entries_
      .emplace(path,
               Entry{computeFpfh(*cloud.points, {}, leaf_, threads_), cloud.shift})
      .first->second;
}

Input
matchClouds(const FeatureStore::Entry& source,
            const FeatureStore::Entry& target,
            std::size_t neighbors,
            unsigned threads)
{
  Input input;
  for (const FeatureMatch& match : matchFeatures(
           viewOf(source.keypoints), viewOf(target.keypoints), neighbors, threads)) {
    append(input.source,
           (*source.keypoints.points)[match.query].getVector3fMap().cast<double>() +
               source.shift);
    append(input.target,
           (*target.keypoints.points)[match.match].getVector3fMap().cast<double>() +
               target.shift);
    input.ranks.push_back(match.squared_distance);
  }
  return input;
}

Input
readCorrespondences(const std::string& path)
{
  const std::string mark = "{src,dst}";
  const std::size_t at = path.find(mark);
  const auto table = [](const std::string& file) {
    return io::parseNumberTable(io::readFile(file));
  };
  io::Correspondences points;
  if (at == std::string::npos)
    points = io::fromCoordinates(table(path));
  else {
    const std::string before = path.substr(0, at),
                      after = path.substr(at + mark.size());
    points = io::fromPointTables(table(before + "src" + after),
                                 table(before + "dst" + after));
  }
  Input input;
  input.source.assign(points.source.data(),
                      points.source.data() + points.source.size());
  input.target.assign(points.target.data(),
                      points.target.data() + points.target.size());
  return input;
}

} // namespace pcl_flashreg::evaluate
