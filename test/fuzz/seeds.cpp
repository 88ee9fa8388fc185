// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "targets.h"

#include "cloud_io_support.h"
#include "io/pcd.h"
#include "io/ply.h"
#include "support/made_correspondences.h"

#include <pcl_flashreg/pair_registration.h>

namespace pcl_flashreg::fuzz {
namespace {

std::vector<std::string>
pcdSeeds()
{
  const std::string fields = "VERSION 0.7\nFIELDS x y z _ label\nSIZE 4 4 8 1 2\n"
                             "TYPE F F F U I\nCOUNT 1 1 1 3 2\nWIDTH 3\nHEIGHT 1\n"
                             "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA ";
  std::string binary = fields + "binary\n";
  binary.append(3 * 23, '\x3f');
  std::string ascii = fields + "ascii\n";
  for (int i = 0; i < 3; ++i)
    ascii += "1.5 -2e-3 nan 0 0 0 7 -8\n";
  return {ascii, binary, io::formatPcd(io::richCloud(40))};
}

std::vector<std::string>
plySeeds()
{
  const std::string elements =
      " 1.0\ncomment made\nelement camera 1\nproperty list uchar short k\n"
      "element vertex 2\nproperty float x\nproperty double y\nproperty uchar z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property list uchar int w\nproperty float nx\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::string row(12, '\x40');
  const std::string colors_list_and_normal(
      "\x01\x02\x03\x04\x01\x00\x00\x00\x07\x00\x00\x80\x3f", 13);
  const std::string body = std::string("\x01\x05\x06", 3) + row +
                           colors_list_and_normal + row + colors_list_and_normal;
  const std::string text =
      "2 5 6\n1 2.5 3 4 5 6 1 7 0.5\n1 2.5 3 4 5 6 0 0.5\n3 0 1 0\n";
  return {"ply\nformat ascii" + elements + text,
          "ply\nformat binary_little_endian" + elements + body,
          "ply\nformat binary_big_endian" + elements + body,
          io::formatPly(io::richCloud(20))};
}

std::string
bytesOf(const std::vector<float>& values)
{
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

/** \brief Rows of four and of five, and values that tell nothing. */
std::vector<std::string>
rawBinSeeds()
{
  made::Random random(2);
  std::vector<float> kitti, nuscenes, noise;
  for (int i = 0; i < 400; ++i) {
    const auto x = static_cast<float>(random.uniform(-80, 80));
    const auto y = static_cast<float>(random.uniform(-20, 20));
    const auto z = static_cast<float>(random.uniform(-2, 3));
    const auto gray = static_cast<float>(i * 7 % 256);
    kitti.insert(kitti.end(), {x, y, z, gray / 255});
    nuscenes.insert(nuscenes.end(), {x, y, z, gray, static_cast<float>(i % 32)});
    noise.push_back(x);
  }
  return {bytesOf(kitti), bytesOf(nuscenes), bytesOf(noise)};
}

/** \brief Without their checksum, which the target puts under what is left of them. */
std::vector<std::string>
scanSeeds()
{
  made::Random random(4);
  std::vector<float> xyz, descriptors;
  for (int i = 0; i < 60; ++i) {
    const auto x = static_cast<float>(random.uniform(0, 1));
    const auto y = static_cast<float>(random.uniform(0, 1));
    xyz.insert(xyz.end(), {x, y, i % 3 ? 0.0f : x});
    descriptors.insert(descriptors.end(), {x, y, x * y, 1 - x});
  }
  ScanInput<float> input;
  input.points.data = xyz.data();
  input.points.size = xyz.size() / 3;
  input.viewpoint_known = true;
  input.viewpoint = {0.5, 0.5, 3};
  PairRegistration maker(BackendKind::Cpu, 1);
  std::vector<std::string> seeds;
  const auto add = [&](const Scan& scan) {
    const std::string bytes = scan.serialize();
    seeds.push_back(bytes.substr(0, bytes.size() - 8));
  };
  add(maker.makeScan(input, 0.2));
  add(maker.makeScan(input, 0.2, ScanContent::Surface).withoutViewpoint());
  input.features = {descriptors.data(), 60, 4, 4};
  add(maker.makeScan(input, 0.2));
  return seeds;
}

/** \brief Correspondences under a shift, all right ones, or all in one place. */
std::vector<std::string>
estimatorSeeds()
{
  made::Random random(3);
  std::vector<float> shifted(6 * 60), same(6 * 60, 1.0f), random_pairs(6 * 60);
  for (std::size_t i = 0; i < 180; ++i) {
    shifted[i] = static_cast<float>(random.uniform(0, 3));
    shifted[180 + i] = shifted[i] + 1;
  }
  for (float& value : random_pairs)
    value = static_cast<float>(random.uniform(-2, 2));
  return {bytesOf(shifted), bytesOf(same), bytesOf(random_pairs), ""};
}

} // namespace

std::vector<NamedTarget>
allTargets()
{
  return {
      {"pcd", readPcd, pcdSeeds()},
      {"ply", readPly, plySeeds()},
      {"raw_bin", readRawBin, rawBinSeeds()},
      {"correspondences",
       readCorrespondences,
       {"# c\n1 2 3 4 5 6\n1e3 -2 +3 nan 5 6\n", "0 1\n99 5\n", "1,2,3\n4 5 6 # x\n"}},
      {"transform",
       readTransform,
       {"1 0 0 0.5\n0 1 0 -2\n0 0 1 3e2\n0 0 0 1\n", "0 -1 0 1 1 0 0 2 0 0 1 3"}},
      {"scan", readScan, scanSeeds()},
      {"estimate", estimate, estimatorSeeds()}};
}

} // namespace pcl_flashreg::fuzz
