// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "record_rows.h"

#include "../../batch/rows.h"

namespace pcl_flashreg::evaluate {

using batch::CellReader;

std::vector<std::string>
resultColumns()
{
  return {"pair",
          "dataset",
          "scene",
          "source",
          "target",
          "method",
          "correspondences",
          "inlier_ratio",
          "found",
          "success",
          "trusted",
          "confidence",
          "inliers",
          "rotation_error_deg",
          "translation_error",
          "agreeing_ratio",
          "rival_inliers",
          "thickness",
          "has_clouds",
          "has_viewpoints",
          "has_sides",
          "in_map",
          "support",
          "matched",
          "contradicted",
          "lead",
          "stiffness",
          "breadth",
          "log_chance",
          "mirrored",
          "tilted",
          "rivals",
          "hold",
          "residual"};
}

std::vector<std::string>
timeColumns()
{
  std::vector<std::string> columns = {
      "pair", "method", "features_ms", "matching_ms", "estimation_ms"};
  for (const Stage& stage : STAGES)
    columns.push_back(std::string(stage.name) + "_ms");
  return columns;
}

std::vector<std::string>
resultCells(const Record& r)
{
  const auto flag = [](bool value) { return std::string(value ? "1" : "0"); };
  std::vector<std::string> cells{std::to_string(r.pair),
                                 r.dataset,
                                 r.scene,
                                 r.source,
                                 r.target,
                                 r.method,
                                 std::to_string(r.correspondences),
                                 io::toText(r.inlier_ratio),
                                 flag(r.found),
                                 flag(r.success),
                                 flag(r.trusted),
                                 io::toText(r.confidence),
                                 std::to_string(r.inliers),
                                 io::toText(r.rotation_error),
                                 io::toText(r.translation_error)};
  if (!r.evidence) {
    cells.resize(resultColumns().size());
    return cells;
  }
  const Evidence& e = *r.evidence;
  cells.insert(cells.end(),
               {io::toText(e.inlier_ratio),
                io::toText(e.rival_inliers),
                io::toText(e.thickness),
                flag(e.has_clouds),
                flag(e.has_viewpoints),
                flag(e.has_sides),
                flag(e.in_map),
                io::toText(e.inliers),
                io::toText(e.agreement.matched),
                io::toText(e.agreement.contradicted),
                io::toText(e.lead),
                io::toText(e.stiffness),
                io::toText(e.breadth),
                io::toText(e.log_chance),
                io::toText(e.mirrored),
                io::toText(e.tilted),
                io::toText(e.rivals),
                io::toText(e.hold),
                io::toText(e.agreement.residual)});
  return cells;
}

std::vector<std::string>
timeCells(const Record& r)
{
  std::vector<std::string> cells = {std::to_string(r.pair),
                                    r.method,
                                    io::toText(r.times.features),
                                    io::toText(r.times.matching),
                                    io::toText(r.times.estimation)};
  for (const Stage& stage : STAGES)
    cells.push_back(r.times.stages ? io::toText((*r.times.stages).*stage.milliseconds)
                                   : "");
  return cells;
}

Record
recordFromCells(const std::vector<std::string>& cells)
{
  const std::vector<std::string> columns = resultColumns();
  CellReader reader(cells, columns);
  Record r;
  r.pair = reader.count();
  r.dataset = reader.text();
  r.scene = reader.text();
  r.source = reader.text();
  r.target = reader.text();
  r.method = reader.text();
  r.correspondences = reader.count();
  r.inlier_ratio = reader.number();
  r.found = reader.flag();
  r.success = reader.flag();
  r.trusted = reader.flag();
  r.confidence = reader.number();
  r.inliers = reader.count();
  r.rotation_error = reader.number();
  r.translation_error = reader.number();
  if (cells.back().empty())
    return r;
  Evidence& e = r.evidence.emplace();
  e.inlier_ratio = reader.number();
  e.rival_inliers = reader.number();
  e.thickness = reader.number();
  e.has_clouds = reader.flag();
  e.has_viewpoints = reader.flag();
  e.has_sides = reader.flag();
  e.in_map = reader.flag();
  e.inliers = reader.number();
  e.agreement.matched = reader.number();
  e.agreement.contradicted = reader.number();
  e.lead = reader.number();
  e.stiffness = reader.number();
  e.breadth = reader.number();
  e.log_chance = reader.number();
  e.mirrored = reader.number();
  e.tilted = reader.number();
  e.rivals = reader.number();
  e.hold = reader.number();
  e.agreement.residual = reader.number();
  return r;
}

Times
timesFromCells(const std::vector<std::string>& cells,
               std::size_t& pair,
               std::string& method)
{
  const std::vector<std::string> columns = timeColumns();
  CellReader reader(cells, columns);
  Times times;
  pair = reader.count();
  method = reader.text();
  times.features = reader.number();
  times.matching = reader.number();
  times.estimation = reader.number();
  if (cells.back().empty())
    return times;
  times.stages.emplace();
  for (const Stage& stage : STAGES)
    (*times.stages).*stage.milliseconds = reader.number();
  times.stages->total = times.estimation;
  return times;
}

} // namespace pcl_flashreg::evaluate
