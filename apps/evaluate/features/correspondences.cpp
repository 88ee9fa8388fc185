// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "correspondences.h"

#include "../../io/correspondence_io.h"
#include "../../io/file.h"
#include "../../io/number_table.h"

namespace pcl_flashreg::evaluate {
namespace {

io::Correspondences
readFiles(const std::string& path)
{
  const auto table = [](const std::string& file) {
    return io::parseFile(file, io::parseNumberTable);
  };
  const std::string mark = "{src,dst}";
  const std::size_t at = path.find(mark);
  if (at == std::string::npos)
    return io::parseFile(path, [](const std::string& bytes) {
      const io::NumberTable rows = io::parseNumberTable(bytes);
      if (io::formOf(rows) != io::CorrespondenceForm::Coordinates)
        throw io::InputError("holds index pairs, expected rows of sx sy sz tx ty tz");
      return io::fromCoordinates(rows);
    });
  const std::string before = path.substr(0, at), after = path.substr(at + mark.size());
  const io::NumberTable source = table(before + "src" + after);
  const io::NumberTable target = table(before + "dst" + after);
  try {
    return io::fromPointTables(source, target);
  }
  catch (const io::InputError& error) {
    throw io::InputError(path + ": " + error.what());
  }
}

} // namespace

Correspondences
readCorrespondences(const std::string& path)
{
  const io::Correspondences points = readFiles(path);
  Correspondences result;
  result.source.assign(points.source.data(),
                       points.source.data() + points.source.size());
  result.target.assign(points.target.data(),
                       points.target.data() + points.target.size());
  return result;
}

} // namespace pcl_flashreg::evaluate
