// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <algorithm>
#include <cstddef>

namespace pcl_flashreg {

/** \brief Numbers as this machine has them become little-endian, or the reverse: nothing
 * has to be done on nearly all of them.
 * \param[in] bytes of numbers one after the other
 * \param[in] width bytes of one number */
inline void
swapToLittleEndian([[maybe_unused]] char* bytes,
                   [[maybe_unused]] std::size_t size,
                   [[maybe_unused]] std::size_t width)
{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  for (char* number = bytes; number + width <= bytes + size; number += width)
    std::reverse(number, number + width);
#endif
}

} // namespace pcl_flashreg
