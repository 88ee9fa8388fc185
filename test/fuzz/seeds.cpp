// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "targets.h"

#include "cloud_io_support.h"
#include "io/pcd.h"
#include "io/ply.h"
#include "pcd_forms.h"
#include "support/made_correspondences.h"

#include <pcl_flashreg/pair_registration.h>

#include <cmath>
#include <iterator>

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
  // What is guessed, kept as something else, or left out.
  io::forms::Form form;
  form.setColumns({{"X"},
                   {"y", 'F', 2},
                   {"z", 'F', 8},
                   {"gone", 'I', 4, 0},
                   {"i", 'U', 1},
                   {"i", 'B', 1},
                   {"q", 'Q', 3, 2},
                   {"n", 'I', 2}});
  form.set("WIDTH", "0");
  form.set("VIEWPOINT", "1, 2, 3");
  form.data = "* # body";
  form.odd_column = 4;
  form.odd_words = {"\x18", " ", "\n", "7", ",", "300"};
  return {ascii,
          binary,
          io::formatPcd(io::richCloud(40)),
          form.bytes(io::forms::Encoding::Ascii),
          form.bytes(io::forms::Encoding::Binary),
          form.bytes(io::forms::Encoding::Compressed)};
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

/** \brief Numbers of every size, some not even that. */
std::string
oddNumbers()
{
  constexpr float ODD[] = {0.0f,
                           -0.0f,
                           1e-45f,
                           -1e-40f,
                           1.2e-38f,
                           1e-20f,
                           1e18f,
                           -3e19f,
                           3.4e38f,
                           INFINITY,
                           -INFINITY,
                           NAN,
                           1.0f,
                           1.0000001f};
  made::Random random(5);
  std::vector<float> values;
  for (int i = 0; i < 1200; ++i) {
    const std::uint64_t which = random.next() % 40;
    values.push_back(which < std::size(ODD)
                         ? ODD[which]
                         : static_cast<float>(random.uniform(-1, 1)));
  }
  return bytesOf(values);
}

/** \brief Points of a corner, whose normals are parallel in threes, then others. */
std::string
cornerAndScatter()
{
  made::Random random(6);
  std::vector<float> values;
  for (int i = 0; i < 300; ++i)
    for (int axis = 0; axis < 3; ++axis)
      values.push_back(
          i < 240 && i % 3 == axis ? 0.0f : static_cast<float>(random.uniform(0, 2)));
  return bytesOf(values);
}

/** \brief Points of a lattice: distances tie. */
std::string
lattice()
{
  std::vector<float> values;
  for (int i = 0; i < 300; ++i)
    for (const int step : {i % 7, i / 7 % 6, i / 42})
      values.push_back(0.25f * static_cast<float>(step));
  return bytesOf(values);
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
      {"estimate", estimate, estimatorSeeds()},
      {"kernels_on_every_variant",
       kernelsOnEveryVariant,
       {oddNumbers(), cornerAndScatter(), lattice()},
       4000,
       20},
      {"estimate_on_every_variant", estimateOnEveryVariant, estimatorSeeds(), 1000, 20},
      {"register_on_every_variant",
       registerOnEveryVariant,
       {oddNumbers(), cornerAndScatter(), lattice()},
       500,
       36}};
}

} // namespace pcl_flashreg::fuzz
