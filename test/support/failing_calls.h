// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>

namespace pcl_flashreg {
namespace failing_calls {

/** \brief Calls of the system that this program, and the libraries that it has loaded, go
 * through test/support/failing_calls.cpp with. */
enum class Call { Open, Read, Write, Sync, Rename };

/** \brief What a call does in place of what it was asked for: it fails with this errno, or
 * with SHORT reads or writes one byte alone. */
constexpr int SHORT = -1;

/** \brief From now on, of this kind, the call number `skip` (the first is 0) fails. */
void
begin(Call call, int failure, std::size_t skip);

/** \brief From now on none fails.
 * \return whether one has, since begin() */
bool
end();

} // namespace failing_calls
} // namespace pcl_flashreg
