// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "estimation/backend.h"

namespace pcl_flashreg {
namespace {

[[noreturn]] void
failWithoutDevice(const std::string& name)
{
  throw BackendError("backend " + name +
                     ": correspondences in device memory take the backend cuda");
}

} // namespace

CorrespondenceView<float>
Backend::readBack(const DeviceCorrespondences&)
{
  failWithoutDevice(name());
}

void
Backend::leavePose(const float[16], const DeviceCorrespondences&)
{
  failWithoutDevice(name());
}

} // namespace pcl_flashreg
