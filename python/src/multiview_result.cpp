// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview_result.h"

#include "choice.h"
#include "result.h"

#include <pcl_flashreg/multiview_registration.h>

#include <pybind11/stl.h>

namespace pcl_flashreg::python {
namespace {

constexpr Words<EdgeFate, 3> EDGE_FATES = {{{"used", EdgeFate::Used},
                                            {"disagrees", EdgeFate::Disagrees},
                                            {"apart", EdgeFate::Apart}}};

void
bindScanPlace(py::module_& module)
{
  using P = ScanPlace;
  py::class_<P>(module, "ScanPlace", "Where a scan is.")
      .def_readonly("group", &P::group, "Number of its group.")
      .def_property_readonly(
          "T_group_scan",
          [](const P& p) { return matrixOf(p.T_group_scan); },
          "4 x 4 float64: group = T @ scan; the frame is that of the group's first "
          "scan.")
      .def_readonly(
          "confidence",
          &P::confidence,
          "That it is right within its group; 0 where that has no other scan.")
      .def_readonly("edges", &P::edges, "Used edges that end here.")
      .def("__repr__", [](const P& p) {
        return "ScanPlace(group " + std::to_string(p.group) + ", confidence " +
               rounded(p.confidence, 2) + ", " + poseText(p.T_group_scan) + ")";
      });
}

std::string
edgeText(const MapEdge& e)
{
  return "MapEdge(" + std::to_string(e.source) + " to " + std::to_string(e.target) +
         ", " + wordOf(EDGE_FATES, e.fate) + ", confidence " +
         rounded(e.pair_confidence, 2) + " by itself and " + rounded(e.confidence, 2) +
         " in the map)";
}

void
bindMapEdge(py::module_& module)
{
  using E = MapEdge;
  py::class_<E>(module, "MapEdge", "Two scans and how they lie to each other.")
      .def_readonly("source", &E::source, "Number of the scan.")
      .def_readonly("target", &E::target, "Number of the scan.")
      .def_property_readonly(
          "fate",
          [](const E& e) { return wordOf(EDGE_FATES, e.fate); },
          "'used' by the map, 'disagrees' with it, or 'apart': in different groups.")
      .def_property_readonly(
          "T_target_source",
          [](const E& e) { return matrixOf(e.T_target_source); },
          "4 x 4 float64, by these two scans alone.")
      .def_readonly("pair_confidence",
                    &E::pair_confidence,
                    "That this pose is right, by these two scans alone.")
      .def_readonly("confidence",
                    &E::confidence,
                    "The same, given the map; 0 unless the edge is used.")
      .def_readonly("agreement", &E::agreement, "Of the clouds under the map's poses.")
      .def_readonly("rotation_residual",
                    &E::rotation_residual,
                    "Between this pose and the map's, in radians.")
      .def_readonly("translation_residual",
                    &E::translation_residual,
                    "Between this pose and the map's, a length.")
      .def_property_readonly(
          "information",
          [](const E& e) { return arrayOf(e.information); },
          "6 x 6 float64, as Result.information; zero unless the edge is used.")
      .def("__repr__", &edgeText);
}

py::dict
timingsOf(const MultiviewTimings& t)
{
  using namespace py::literals;
  return py::dict("relations"_a = t.relations,
                  "grouping"_a = t.grouping,
                  "refinement"_a = t.refinement,
                  "total"_a = t.total);
}

} // namespace

void
bindMultiviewResult(py::module_& module)
{
  bindScanPlace(module);
  bindMapEdge(module);
  using R = MultiviewResult;
  py::class_<R>(module, "MultiviewResult", "Where scans are, in one map or several.")
      .def_readonly("scans", &R::scans, "A ScanPlace a scan, in their order.")
      .def_readonly("groups",
                    &R::groups,
                    "Numbers of the scans of each group, the largest group first.")
      .def_readonly(
          "edges", &R::edges, "A MapEdge for every pair that was found to have a pose.")
      .def_property_readonly(
          "placed", &R::placed, "How many scans are in a group with others.")
      .def_property_readonly(
          "timings_ms",
          [](const R& r) { return timingsOf(r.timings); },
          "Milliseconds of each part by its name.")
      .def("__repr__", [](const R& r) {
        return "MultiviewResult(" + std::to_string(r.placed()) + " of " +
               std::to_string(r.scans.size()) + " scans placed, " +
               std::to_string(r.groups.size()) + " groups)";
      });
}

} // namespace pcl_flashreg::python
