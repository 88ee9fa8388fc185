// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"
#include "pcd_fields.h"

#include <string_view>

namespace pcl_flashreg::io {

enum class PcdEncoding { Ascii, Binary, Compressed, Unknown };

/** \brief What a PCD header says, checked. */
struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t width = 0;
  std::size_t height = 1;
  std::array<double, 7> viewpoint = {0, 0, 0, 1, 0, 0, 0};
  PcdEncoding encoding = PcdEncoding::Unknown;
  std::vector<std::string> notes;
  std::string_view body;
  /** \brief Lines before the body. */
  std::size_t lines = 0;
};

/** \brief Reads the header by the rules of parsePcd().
 * \param[in] bytes the whole file, which the body is a part of
 * \throws InputError
 */
PcdHeader
parsePcdHeader(std::string_view bytes);

/** \brief The cloud that the header declares, with values 0.
 * \param[in] row_size bytes of the body that a point takes at least
 * \param[in] capacity bytes of the body
 * \throws InputError if the points cannot be in there
 */
Cloud
makePcdCloud(const PcdHeader& header, std::size_t row_size, std::size_t capacity);

/** \brief Reads the body of a file in ascii.
 * \throws InputError
 */
Cloud
readPcdAscii(PcdHeader header);

} // namespace pcl_flashreg::io
