// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/pair_registration.h>

#include <pybind11/pybind11.h>

#include <optional>

namespace pcl_flashreg::python {

/** \brief Writes what a Parameters of Python's says, None for nothing, into the options.
 * \throws TypeError, ValueError that name the field */
void
applyParameters(pybind11::handle parameters, PairOptions& options);

/** \brief PairOptions as far as all calls have them in common. */
PairOptions
optionsOf(const std::optional<double>& resolution,
          pybind11::handle parameters,
          pybind11::handle guess,
          bool cloud_check);

/** \brief How matches are made.
 * \throws ValueError if there are to be none */
void
applyMatching(std::size_t neighbors, bool mutual, PairOptions& options);

/** \brief Every field of the core's by its name. */
pybind11::dict
fieldsOf(const Parameters& parameters);

} // namespace pcl_flashreg::python
