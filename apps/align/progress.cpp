// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "progress.h"

#include <unistd.h>

#include <iostream>

namespace pcl_flashreg::align {

Progress::Progress(bool quiet)
    : notes_(!quiet), stages_(!quiet && ::isatty(STDERR_FILENO) == 1)
{
}

void
Progress::say(const std::string& what) const
{
  if (stages_)
    std::cerr << "... " << what << std::endl;
}

void
Progress::note(const std::string& what) const
{
  if (notes_)
    std::cerr << "pcl_flashreg_align: note: " << what << std::endl;
}

} // namespace pcl_flashreg::align
