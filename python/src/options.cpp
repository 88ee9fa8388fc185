// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "options.h"

#include "array.h"
#include "choice.h"

#include <string>

namespace pcl_flashreg::python {
namespace {

/** \brief Reads the attributes of an object by name. */
class Fields {
public:
  explicit Fields(py::handle object) : object_(object) {}

  template <typename T>
  T
  get(const char* name) const
  {
    const py::object value = object_.attr(name);
    try {
      return value.cast<T>();
    }
    catch (const py::cast_error&) {
      throw py::type_error(std::string(name) + " is " + std::string(py::repr(value)) +
                           ", but has to be " + nameOf(T()));
    }
  }

  std::optional<float>
  length(const char* name) const
  {
    if (object_.attr(name).is_none())
      return std::nullopt;
    return get<float>(name);
  }

  template <typename Enum, std::size_t N>
  Enum
  word(const Words<Enum, N>& words, const char* name) const
  {
    return choose(words, get<std::string>(name), name);
  }

  std::array<float, 3>
  vector(const char* name) const
  {
    const Eigen::Vector3f v = vectorOf(object_.attr(name), name).cast<float>();
    return {v.x(), v.y(), v.z()};
  }

private:
  static const char*
  nameOf(float)
  {
    return "a number";
  }
  static const char*
  nameOf(int)
  {
    return "an integer of 32 bits";
  }
  static const char*
  nameOf(const std::string&)
  {
    return "a word";
  }

  py::handle object_;
};

} // namespace

void
applyParameters(py::handle parameters, PairOptions& options)
{
  if (parameters.is_none())
    return;
  const py::object type = py::module_::import("pcl_flashreg").attr("Parameters");
  if (!py::isinstance(parameters, type))
    throw py::type_error("parameters: is " + std::string(py::repr(parameters)) +
                         ", but has to be a Parameters");
  const Fields fields(parameters);
  options.length_tolerance = fields.length("length_tolerance");
  options.min_length_sum = fields.length("min_length_sum");
  options.inlier_distance = fields.length("inlier_distance");
  Parameters& values = options.parameters;
  values.max_correspondences = fields.get<int>("max_correspondences");
  values.pivots = fields.get<int>("pivots");
  values.cliques_per_pivot = fields.get<int>("cliques_per_pivot");
  values.row_capacity = fields.get<int>("row_capacity");
  values.pool_capacity = fields.get<int>("pool_capacity");
  values.second_order = fields.word(SECOND_ORDERS, "second_order");
  values.score_metric = fields.word(SCORE_METRICS, "score_metric");
  values.refinement_iterations = fields.get<int>("refinement_iterations");
  values.max_hypotheses = fields.get<int>("max_hypotheses");
  values.motion = fields.word(MOTIONS, "motion");
  values.max_tilt = fields.get<float>("max_tilt");
  values.source_gravity = fields.vector("source_gravity");
  values.target_gravity = fields.vector("target_gravity");
  values.min_confidence = fields.get<float>("min_confidence");
}

PairOptions
optionsOf(const std::optional<double>& resolution,
          py::handle parameters,
          py::handle guess,
          bool cloud_check)
{
  PairOptions options;
  options.resolution = resolution;
  applyParameters(parameters, options);
  if (!guess.is_none())
    options.guess = transformOf(guess, "guess");
  options.cloud_check = cloud_check;
  return options;
}

void
applyMatching(std::size_t neighbors, bool mutual, PairOptions& options)
{
  if (neighbors == 0)
    throw py::value_error("neighbors is 0, but must be >= 1");
  options.neighbors = neighbors;
  options.mutual = mutual;
}

py::dict
fieldsOf(const Parameters& parameters)
{
  using namespace py::literals;
  const auto vector = [](const std::array<float, 3>& v) {
    return py::make_tuple(v[0], v[1], v[2]);
  };
  return py::dict("length_tolerance"_a = parameters.length_tolerance,
                  "min_length_sum"_a = parameters.min_length_sum,
                  "inlier_distance"_a = parameters.inlier_distance,
                  "max_correspondences"_a = parameters.max_correspondences,
                  "pivots"_a = parameters.pivots,
                  "cliques_per_pivot"_a = parameters.cliques_per_pivot,
                  "row_capacity"_a = parameters.row_capacity,
                  "pool_capacity"_a = parameters.pool_capacity,
                  "second_order"_a = wordOf(SECOND_ORDERS, parameters.second_order),
                  "score_metric"_a = wordOf(SCORE_METRICS, parameters.score_metric),
                  "refinement_iterations"_a = parameters.refinement_iterations,
                  "max_hypotheses"_a = parameters.max_hypotheses,
                  "motion"_a = wordOf(MOTIONS, parameters.motion),
                  "max_tilt"_a = parameters.max_tilt,
                  "source_gravity"_a = vector(parameters.source_gravity),
                  "target_gravity"_a = vector(parameters.target_gravity),
                  "min_confidence"_a = parameters.min_confidence);
}

} // namespace pcl_flashreg::python
