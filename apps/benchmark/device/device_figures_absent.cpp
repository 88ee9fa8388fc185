// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Where the library has no CUDA backend: nothing gets here, since no estimator of that
// kind can be made.

#include "device_figures.h"

namespace pcl_flashreg::benchmark {
namespace {

[[noreturn]] void
fail()
{
  throw BackendError("this benchmark was built without CUDA");
}

} // namespace

DeviceFigures
measureOnDevice(const CorrespondenceView<double>&,
                const Parameters&,
                const DeviceEffort&)
{
  fail();
}

std::string
deviceName()
{
  fail();
}

Ceilings
measureCeilings()
{
  fail();
}

} // namespace pcl_flashreg::benchmark
