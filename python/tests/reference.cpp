// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// What C++ makes of two arrays: reference float32|float64 SOURCE TARGET RESOLUTION. Prints the
// bytes of doubles: pose, confidence, resolution, score, information, inliers.

#include <pcl_flashreg/pair_registration.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

using namespace pcl_flashreg;

namespace {

template <typename Scalar>
std::vector<Scalar>
read(const char* path)
{
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<Scalar> values(static_cast<std::size_t>(file.tellg()) / sizeof(Scalar));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(Scalar)));
  return values;
}

template <typename Scalar>
ScanInput<Scalar>
inputOf(const std::vector<Scalar>& values)
{
  ScanInput<Scalar> input;
  input.points = {values.data(), values.size() / 3, 3, nullptr, 0};
  input.viewpoint_known = true;
  return input;
}

template <typename Scalar>
PairResult
align(char** arguments)
{
  const std::vector<Scalar> source = read<Scalar>(arguments[0]);
  const std::vector<Scalar> target = read<Scalar>(arguments[1]);
  PairOptions options;
  if (const double resolution = std::strtod(arguments[2], nullptr))
    options.resolution = resolution;
  return PairRegistration().align(inputOf(source), inputOf(target), options);
}

void
print(const Eigen::MatrixXd& matrix)
{
  const Eigen::MatrixXd by_rows = matrix.transpose();
  std::fwrite(
      by_rows.data(), sizeof(double), static_cast<std::size_t>(by_rows.size()), stdout);
}

} // namespace

int
main(int count, char** arguments)
{
  if (count != 5)
    return 2;
  const PairResult result = arguments[1] == std::string("float32")
                                ? align<float>(arguments + 2)
                                : align<double>(arguments + 2);
  print(result.pose.T_target_source.toMatrix<double>());
  print(Eigen::Vector3d(result.pose.confidence, result.resolution, result.pose.score));
  print(result.pose.information);
  for (const int inlier : result.pose.inliers)
    print(Eigen::Matrix<double, 1, 1>(inlier));
  return 0;
}
