// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Runs the threads of a grid as fibres, with barriers and the exchanges within a warp.

#include <cstddef>
#include <cstdint>
#include <functional>

/** \brief CUDA's, as threadIdx and launches use it. */
struct dim3 {
  unsigned x = 1, y = 1, z = 1;
  constexpr dim3(unsigned x_ = 1, unsigned y_ = 1, unsigned z_ = 1)
      : x(x_), y(y_), z(z_)
  {
  }
};

namespace cuda_emulation {

/** \brief Where the thread that is running stands. */
struct Place {
  dim3 thread, block, block_size, grid_size;
  unsigned char* shared = nullptr;
};

const Place&
place();

/** \brief What the lanes of a warp give each other. */
enum class Exchange { Barrier, Ballot, Shuffle, Add, Max };

/** \brief Waits for the lanes in `mask`. \param[in] operand lane to read, for Shuffle */
std::uint64_t
exchange(unsigned mask, Exchange what, std::uint64_t value, unsigned operand = 0);

/** \brief Waits for the threads of the block.
 * \return how many of them gave `true` */
int
blockBarrier(bool predicate = false);

void
gridBarrier();

/** \brief Runs body() once a thread.
 * \param[in] at_once blocks may wait for each other
 * \return what went wrong, or null
 */
const char*
runGrid(const dim3& grid,
        const dim3& block,
        std::size_t shared_bytes,
        bool at_once,
        const std::function<void()>& body);

} // namespace cuda_emulation
