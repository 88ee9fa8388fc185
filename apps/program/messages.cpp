// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "messages.h"

#include <unistd.h>

#include <iostream>

namespace pcl_flashreg::program {

Messages::Messages(std::string name, bool quiet)
    : name_(std::move(name)),
      notes_(!quiet),
      stages_(!quiet && ::isatty(STDERR_FILENO) == 1)
{
}

void
Messages::say(const std::string& what) const
{
  if (stages_)
    std::cerr << "... " << what << std::endl;
}

void
Messages::note(const std::string& what) const
{
  if (notes_)
    std::cerr << name_ << ": note: " << what << std::endl;
}

void
Messages::tell(const std::string& what) const
{
  if (notes_)
    std::cerr << what << std::endl;
}

} // namespace pcl_flashreg::program
