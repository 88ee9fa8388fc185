// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace pcl_flashreg::io {

/** \brief Compresses bytes into the LZF format, which PCD's binary_compressed bodies
 * have. The result can be longer than the input, by one byte in 32. */
std::vector<std::uint8_t>
compressLzf(const std::vector<std::uint8_t>& bytes);

/** \brief The reverse.
 * \param[in] bytes the compressed bytes
 * \param[in] size number of bytes that they stand for
 * \throws InputError if they are not LZF, or stand for another number of bytes
 */
std::vector<std::uint8_t>
decompressLzf(std::string_view bytes, std::size_t size);

} // namespace pcl_flashreg::io
