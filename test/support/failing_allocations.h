// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>

namespace pcl_flashreg {
namespace failing_allocations {

/** \brief Which allocations of the program fail, by operator new or by malloc(). The
 * program has to be linked with test/support/failing_allocations.cpp. */
enum class Mode {
  None,
  /** \brief One. */
  Once,
  /** \brief One, and all that follow: there is no memory left. */
  FromThenOn,
  /** \brief One of those of other threads than the one that calls begin(). */
  OfWorkersOnce
};

/** \brief From now on, allocation number `skip` (the first is 0) fails. */
void
begin(Mode mode, std::size_t skip);

/** \brief From now on none fails.
 * \return how many have failed since begin() */
std::size_t
end();

/** \brief Blocks that were allocated and not given back. */
long
liveBlocks();

/** \brief Blocks that were allocated so far. */
std::size_t
allBlocks();

} // namespace failing_allocations
} // namespace pcl_flashreg
