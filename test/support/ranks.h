// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>

namespace pcl_flashreg {

/** \brief What is typed before a program to run it on several ranks: as root and on more
 * than there are processors, in Open MPI's words; what it leaks is not ours. Empty where
 * there is no MPI. */
inline std::string
onRanks(int ranks)
{
#ifdef PCL_FLASHREG_MPIEXEC
  return "env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
         "OMPI_MCA_rmaps_base_oversubscribe=1 ASAN_OPTIONS=detect_leaks=0 "
         "'" PCL_FLASHREG_MPIEXEC "' -n " +
         std::to_string(ranks);
#else
  static_cast<void>(ranks);
  return "";
#endif
}

} // namespace pcl_flashreg
