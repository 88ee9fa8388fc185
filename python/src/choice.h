// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Enumerations are words in Python: those of the programs' options and files.

#include <pcl_flashreg/parameters.h>
#include <pcl_flashreg/result.h>
#include <pcl_flashreg/scan.h>

#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace pcl_flashreg::python {

template <typename Enum, std::size_t N>
using Words = std::array<std::pair<const char*, Enum>, N>;

inline constexpr Words<BackendKind, 3> BACKENDS = {{{"auto", BackendKind::Auto},
                                                    {"cpu", BackendKind::Cpu},
                                                    {"cuda", BackendKind::Cuda}}};

inline constexpr Words<MotionModel, 2> MOTIONS = {
    {{"rigid", MotionModel::Rigid}, {"upright", MotionModel::Upright}}};

inline constexpr Words<SecondOrder, 3> SECOND_ORDERS = {
    {{"auto", SecondOrder::Auto},
     {"exact", SecondOrder::Exact},
     {"bounded", SecondOrder::Bounded}}};

inline constexpr Words<ScoreMetric, 3> SCORE_METRICS = {
    {{"inliers", ScoreMetric::Inliers},
     {"mae", ScoreMetric::Mae},
     {"mse", ScoreMetric::Mse}}};

inline constexpr Words<Status, 4> STATUSES = {
    {{"ok", Status::Ok},
     {"too_few_correspondences", Status::TooFewCorrespondences},
     {"no_clique", Status::NoClique},
     {"degenerate", Status::Degenerate}}};

inline constexpr Words<FreeMotion::Kind, 2> FREE_MOTIONS = {
    {{"slide", FreeMotion::Kind::Slide}, {"turn", FreeMotion::Kind::Turn}}};

inline constexpr Words<ViewpointSource, 3> VIEWPOINT_SOURCES = {
    {{"unknown", ViewpointSource::Unknown},
     {"stated", ViewpointSource::Stated},
     {"points", ViewpointSource::Points}}};

/** \throws ValueError that lists the words */
template <typename Enum, std::size_t N>
Enum
choose(const Words<Enum, N>& words, const std::string& word, const char* name)
{
  std::string known;
  for (const auto& [text, value] : words) {
    if (word == text)
      return value;
    known += (known.empty() ? "'" : ", '") + std::string(text) + "'";
  }
  throw pybind11::value_error(std::string(name) + " is '" + word +
                              "', but must be one of " + known);
}

template <typename Enum, std::size_t N>
const char*
wordOf(const Words<Enum, N>& words, Enum value)
{
  for (const auto& [text, each] : words)
    if (each == value)
      return text;
  return "unknown";
}

} // namespace pcl_flashreg::python
