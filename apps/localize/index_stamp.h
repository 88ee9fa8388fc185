// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace pcl_flashreg::localize {

/** \brief What an index was made of; kept in a file beside it. */
struct IndexStamp {
  /** \brief Absolute path of the map. */
  std::string map;
  std::uintmax_t size = 0;
  /** \brief In the ticks of the file system's clock. */
  std::int64_t modified = 0;
  /** \brief Of the contents of the map. */
  std::string checksum;
  double leaf = 0;
  std::size_t bin_fields = 0;
  /** \brief batch::frontEndFingerprint(): changes with what is made of a cloud. */
  std::string front_end;
  /** \brief Of the beginning of the index, which has its checksums: tells that this is
   * the stamp of that index. */
  std::string index;
};

/** \brief "FILE.json" of the index "FILE". */
std::string
stampPathOf(const std::string& index);

/** \brief The stamp of an index that was made right now.
 * \throws io::InputError if a file can't be read */
IndexStamp
stampOf(const std::string& map,
        const std::string& index,
        double leaf,
        std::size_t bin_fields);

void
writeStamp(const IndexStamp& stamp, const std::string& index);

/** \brief Nothing if there is none, or none of this index. */
std::optional<IndexStamp>
readStamp(const std::string& index);

/** \brief Whether the index was made of what the map holds now. Reads the map only
 * where its name, or its time alone, is another.
 * \throws io::InputError if the map can't be read */
bool
isOf(const IndexStamp& stamp, const std::string& map, std::size_t bin_fields);

} // namespace pcl_flashreg::localize
