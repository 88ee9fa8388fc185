// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pybind11/pybind11.h>

namespace pcl_flashreg::python {

// One a file of its name. What is named in signatures has to be there before.

void
bindResult(pybind11::module_& module);
void
bindCloud(pybind11::module_& module);
void
bindScan(pybind11::module_& module);
void
bindScanIndex(pybind11::module_& module);
void
bindPairRegistration(pybind11::module_& module);
void
bindMultiviewRegistration(pybind11::module_& module);
void
bindFeatures(pybind11::module_& module);

} // namespace pcl_flashreg::python
