// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "registration/choose_backend.h"

#include "simd/kernels.h"

#include <pcl_flashreg/estimator.h>

namespace pcl_flashreg {
namespace {

/** \brief Null where CUDA can't be used. */
std::unique_ptr<Backend>
tryCudaBackend()
{
  try {
    return makeCudaBackend();
  }
  catch (const BackendError&) {
    return nullptr;
  }
}

} // namespace

std::unique_ptr<Backend>
chooseBackend(BackendKind kind, ThreadPool& pool)
{
  if (kind == BackendKind::Cuda)
    return makeCudaBackend();
  if (kind == BackendKind::Auto)
    if (std::unique_ptr<Backend> cuda = tryCudaBackend())
      return cuda;
  return makeCpuBackend(pool);
}

std::vector<std::string>
availableBackends()
{
  std::size_t count = 0;
  const cpu::Kernels* const* kernels = cpu::availableKernels(count);
  std::vector<std::string> names;
  if (const std::unique_ptr<Backend> cuda = tryCudaBackend())
    names.push_back(cuda->name());
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(std::string("cpu-") + kernels[i]->name);
  return names;
}

} // namespace pcl_flashreg
