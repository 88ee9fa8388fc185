// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What a test sets and reads of the emulated device. The device itself is cuda_runtime.h
// and cooperative_groups.h beside this file, which stand in for CUDA's own.
//
// Kernels are compiled by the host's compiler and run on one thread of the host, a fibre
// for every thread of a block: whoever forgets a barrier reads what another thread has not
// written yet, in this order of threads or in that one. Streams carry their work out when
// they are waited for, and no sooner. Shared memory is dynamic only.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace cuda_emulation {

/** \brief The order in which threads run between two barriers, and blocks of a launch.
 * Forward and reversed, a block runs after the other, and a warp goes as far as it gets
 * before the next; in random order threads take turns, those of some blocks at a time. */
enum class Order { Forward, Reversed, Random };

/** \brief What the emulated machine has, and what goes wrong with it. */
struct Device {
  /** \brief 0: a machine without a device. */
  int count = 1;
  int major = 9, minor = 0;
  bool cooperative_launch = true;
  /** \brief False: the program was built for other architectures. */
  bool has_kernel_image = true;
  /** \brief Their product is the number of blocks of a persistent grid. */
  int multiprocessors = 2, blocks_a_multiprocessor = 2;
  std::size_t memory = std::numeric_limits<std::size_t>::max();
  /** \brief So many allocations succeed from now on. */
  std::size_t allocations_left = std::numeric_limits<std::size_t>::max();
  /** \brief So many launches succeed from now on. */
  std::size_t launches_left = std::numeric_limits<std::size_t>::max();
  Order order = Order::Forward;
  /** \brief Of Order::Random. */
  std::uint64_t seed = 1;
};

/** \brief What the program under test did since reset(). */
struct Counters {
  std::size_t allocations = 0;
  std::size_t launches = 0;
  std::size_t cooperative_launches = 0;
  std::size_t synchronisations = 0;
  std::size_t copies = 0;
  /** \brief Bytes of device memory, now and at most. */
  std::size_t bytes = 0, peak_bytes = 0;
};

Device&
device();

Counters&
counters();

/** \brief A new device without errors, and counters at zero; what is allocated stays. */
void
reset();

/** \brief What was wrong in the last launch that failed: a barrier that not every thread
 * reaches, a store outside of an allocation. */
std::string
lastFailure();

} // namespace cuda_emulation
