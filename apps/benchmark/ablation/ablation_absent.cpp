// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Where there is no CUDA backend, or no cuBLAS for the dense product.

#include "ablation.h"

#include <pcl_flashreg/estimator.h>

namespace pcl_flashreg::benchmark {

std::vector<AblationMeasurement>
measureAblation(const Problem&, const Parameters&, const Repetition&)
{
  throw BackendError("--ablation: this benchmark was built without CUDA and cuBLAS");
}

void
printAblation(const std::vector<AblationMeasurement>&)
{
}

} // namespace pcl_flashreg::benchmark
