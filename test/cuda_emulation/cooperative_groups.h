// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Stands in for CUDA's header of this name: the barrier of a whole grid.

#include "grid.h"

namespace cooperative_groups {

class grid_group {
public:
  void
  sync() const
  {
    cuda_emulation::gridBarrier();
  }
};

inline grid_group
this_grid()
{
  return {};
}

} // namespace cooperative_groups
