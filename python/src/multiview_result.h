// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pybind11/pybind11.h>

namespace pcl_flashreg::python {

namespace py = pybind11;

void
bindMultiviewResult(py::module_& module);

} // namespace pcl_flashreg::python
