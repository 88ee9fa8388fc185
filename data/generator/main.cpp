// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "program/command_line.h"
#include "scan_pair.h"

#include <pcl/io/pcd_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <stdexcept>
#include <string>

namespace generator = pcl_flashreg::generator;
namespace program = pcl_flashreg::program;

namespace {

void
writeCloud(const std::filesystem::path& file, const generator::Points& points)
{
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (const auto& point : points)
    cloud.emplace_back(point.x(), point.y(), point.z());
  if (pcl::io::savePCDFileBinaryCompressed(file.string(), cloud) != 0)
    throw std::runtime_error("cannot write " + file.string());
}

void
writePose(const std::filesystem::path& file, const Eigen::Isometry3d& pose)
{
  std::ofstream stream(file);
  stream << std::fixed << std::setprecision(12) << pose.matrix() << '\n';
  if (!stream.flush())
    throw std::runtime_error("cannot write " + file.string());
}

} // namespace

int
main(int argc, char** argv)
{
  CLI::App app{
      "Makes a pair of scans of a made scene, with the true pose between them"};
  std::string scene;
  std::string directory;
  std::uint64_t seed = generator::bundled_seed;
  app.add_option("scene", scene, "indoor (depth camera) or street (spinning lidar)")
      ->required()
      ->check(CLI::IsMember({"indoor", "street"}));
  app.add_option(
         "directory", directory, "gets source.pcd, target.pcd, T_target_source.txt")
      ->required();
  app.add_option("--seed", seed, "varies the scene, the viewpoints and the noise")
      ->capture_default_str();
  return program::run("pcl_flashreg_generate", [&] {
    if (!program::parse(app, argc, argv))
      return 0;
    const auto pair = generator::makeScanPair(scene, seed);
    const std::filesystem::path out(directory);
    std::filesystem::create_directories(out);
    writeCloud(out / "source.pcd", pair.source);
    writeCloud(out / "target.pcd", pair.target);
    writePose(out / "T_target_source.txt", pair.T_target_source);
    return 0;
  });
}
