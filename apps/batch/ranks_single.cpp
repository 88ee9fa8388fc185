// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Where MPI was not found.

#include "ranks.h"

namespace pcl_flashreg::batch {

Ranks::Ranks() = default;
Ranks::~Ranks() = default;

void
Ranks::wait() const
{
}

int
Ranks::abort(int status) const
{
  return status;
}

} // namespace pcl_flashreg::batch
