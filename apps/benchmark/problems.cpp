// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "problems.h"

#include "../io/file.h"
#include "support/made_correspondences.h"

#include <cstdio>

namespace pcl_flashreg::benchmark {
namespace {

io::Correspondences
readCoordinates(const std::string& path)
{
  return io::parseFile(path, [](const std::string& bytes) {
    const io::NumberTable table = io::parseNumberTable(bytes);
    if (io::formOf(table) != io::CorrespondenceForm::Coordinates)
      throw io::InputError("indices without points; sx sy sz tx ty tz are needed");
    return io::fromCoordinates(table);
  });
}

NamedProblem
readProblem(const std::string& paths)
{
  const std::size_t comma = paths.find(',');
  const std::string first = paths.substr(0, comma);
  const std::string name = first.substr(first.rfind('/') + 1);
  if (comma == std::string::npos)
    return {name, readCoordinates(first)};
  const auto table = [](const std::string& path) {
    return io::parseFile(path, io::parseNumberTable);
  };
  return {name, io::fromPointTables(table(first), table(paths.substr(comma + 1)))};
}

NamedProblem
makeProblem(const made::Recipe& recipe)
{
  char name[64];
  std::snprintf(name,
                sizeof name,
                "cube %g, inliers %g %%",
                recipe.side,
                100 * recipe.inlier_ratio);
  const made::Correspondences made = made::make(recipe);
  const auto matrix = [&](const double* xyz) {
    return Eigen::Map<const Eigen::Matrix3Xd>(
        xyz, 3, static_cast<Eigen::Index>(recipe.size));
  };
  const CorrespondenceView<double> view = made.view();
  return {name, {matrix(view.source_xyz), matrix(view.target_xyz)}};
}

std::string
toText(const io::Correspondences& c)
{
  std::string text;
  char row[6 * 32];
  for (Eigen::Index i = 0; i < c.source.cols(); ++i) {
    const auto s = c.source.col(i), t = c.target.col(i);
    std::snprintf(row,
                  sizeof row,
                  "%.17g %.17g %.17g %.17g %.17g %.17g\n",
                  s.x(),
                  s.y(),
                  s.z(),
                  t.x(),
                  t.y(),
                  t.z());
    text += row;
  }
  return text;
}

} // namespace

std::vector<NamedProblem>
problemsOf(const Options& options)
{
  std::vector<NamedProblem> problems;
  for (const std::string& file : options.files)
    problems.push_back(readProblem(file));
  if (!options.files.empty())
    return problems;
  for (const std::size_t size : options.sizes)
    for (const double ratio : options.inlier_ratios) {
      made::Recipe recipe;
      recipe.size = size;
      recipe.inlier_ratio = ratio;
      recipe.side = options.side;
      problems.push_back(makeProblem(recipe));
    }
  return problems;
}

std::vector<std::string>
exportProblems(const std::vector<NamedProblem>& problems, const std::string& folder)
{
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const io::Correspondences& c = problems[i].correspondences;
    paths.push_back(folder + "/" + std::to_string(i) + "_" + std::to_string(c.size()) +
                    ".txt");
    io::writeFile(paths.back(), toText(c));
  }
  return paths;
}

} // namespace pcl_flashreg::benchmark
