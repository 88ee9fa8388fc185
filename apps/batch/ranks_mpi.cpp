// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "ranks.h"

#include <mpi.h>

#include <cstdlib>

namespace pcl_flashreg::batch {
namespace {

/** \brief What the launchers of Open MPI, MPICH, Intel MPI, MVAPICH and Slurm leave in the
 * environment of a rank. */
bool
isRank()
{
  for (const char* variable :
       {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK", "MV2_COMM_WORLD_RANK"})
    if (std::getenv(variable) != nullptr)
      return true;
  return false;
}

} // namespace

Ranks::Ranks()
{
  if (!isRank())
    return;
  MPI_Init(nullptr, nullptr);
  started_ = true;
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  rank_ = static_cast<std::size_t>(rank);
  size_ = static_cast<std::size_t>(size);
}

Ranks::~Ranks()
{
  if (started_)
    MPI_Finalize();
}

void
Ranks::wait() const
{
  if (started_)
    MPI_Barrier(MPI_COMM_WORLD);
}

int
Ranks::abort(int status) const
{
  if (started_ && size_ > 1)
    MPI_Abort(MPI_COMM_WORLD, status);
  return status;
}

} // namespace pcl_flashreg::batch
