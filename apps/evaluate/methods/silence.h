// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <iostream>

namespace pcl_flashreg::evaluate {

/** \brief Keeps libraries that talk on standard output from it, while it lives: our
 * results go there. */
class Silence {
public:
  Silence() : before_(std::cout.rdbuf(nullptr)) {}
  ~Silence()
  {
    std::cout.rdbuf(before_);
  }
  Silence(const Silence&) = delete;
  Silence&
  operator=(const Silence&) = delete;

private:
  std::streambuf* before_;
};

} // namespace pcl_flashreg::evaluate
