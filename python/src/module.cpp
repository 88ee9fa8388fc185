// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "bindings.h"
#include "call.h"

#include <pcl_flashreg/estimator.h>

#include <pybind11/stl.h>

namespace py = pybind11;

PYBIND11_MODULE(_core, module)
{
  using namespace pcl_flashreg;
  module.doc() = "The compiled part of pcl_flashreg.";
  module.attr("__version__") = version();
  py::register_exception<BackendError>(module, "BackendError", PyExc_RuntimeError);
  module.def("available_backends",
             &availableBackends,
             "Names of the backends that this machine can run, best first.");
  python::endBeforePython();
  python::bindResult(module);
  python::bindCloud(module);
  python::bindScan(module);
  python::bindScanIndex(module);
  python::bindPairRegistration(module);
  python::bindMultiviewRegistration(module);
  python::bindFeatures(module);
}
