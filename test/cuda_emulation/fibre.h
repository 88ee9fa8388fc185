// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <memory>

namespace cuda_emulation {

/** \brief A stack of its own that a function runs on, and can leave and come back to. */
class Fibre {
public:
  Fibre();
  ~Fibre();
  Fibre(const Fibre&) = delete;
  Fibre&
  operator=(const Fibre&) = delete;

  /** \brief Takes up entry(argument) from its start at the next resume(); whatever ran on
   * this stack is forgotten. entry must not return nor throw: it ends with leave(). */
  void
  start(void (*entry)(void*), void* argument);

  /** \brief Runs the fibre until it calls leave(). */
  void
  resume();

  /** \brief From within: goes back to whoever called resume(). */
  void
  leave();

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace cuda_emulation
