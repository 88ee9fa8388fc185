// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace pcl_flashreg {

/** \brief Bytes are not what ArchiveWriter put together. */
struct ArchiveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/** \brief Arrays one after the other, as bytes: a header, a table of where each array begins
 * and how wide its values are, the arrays, each from a multiple of 64 bytes on. Numbers are
 * little-endian. */
class ArchiveWriter {
public:
  /** \param[in] magic 8 bytes */
  ArchiveWriter(std::string_view magic, std::uint32_t version)
      : magic_(magic), version_(version)
  {
  }

  /** \param[in] width of one number, that of which a value is made */
  void
  add(const void* data, std::size_t size, std::size_t width);

  template <typename Value>
  void
  add(const Value* values, std::size_t count, std::size_t width = sizeof(Value))
  {
    add(static_cast<const void*>(values), count * sizeof(Value), width);
  }

  template <typename Value>
  void
  add(const std::vector<Value>& values)
  {
    add(values.data(), values.size());
  }

  /** \brief Whatever was added. */
  std::string
  take();

private:
  struct Section {
    std::uint64_t begin, size, width;
  };

  std::string magic_;
  std::uint32_t version_;
  std::vector<Section> sections_;
  std::string arrays_;
};

/** \brief Reads arrays in the order in which they were written, where they are. */
class ArchiveReader {
public:
  /** \param[in] bytes from a multiple of 64 bytes on
   * \param[in] keeper has them as long as it lives
   * \param[in] verify whether to look at all of them: their checksum
   * \throws ArchiveError that says whether they are no such archive, of another version,
   * incomplete or damaged */
  ArchiveReader(std::string_view bytes,
                std::shared_ptr<const void> keeper,
                std::string_view magic,
                std::uint32_t version,
                bool verify);

  const std::shared_ptr<const void>&
  keeper() const
  {
    return keeper_;
  }

  /** \brief The next array, in this machine's order of bytes.
   * \throws ArchiveError if there is none, or of other values */
  template <typename Value>
  const Value*
  next(std::size_t& count, std::size_t width = sizeof(Value))
  {
    const std::string_view bytes = nextBytes(width);
    if (bytes.size() % sizeof(Value) != 0)
      throw ArchiveError("is damaged: an array does not end with a value");
    count = bytes.size() / sizeof(Value);
    return reinterpret_cast<const Value*>(bytes.data());
  }

  /** \brief A copy of it. */
  template <typename Value>
  std::vector<Value>
  nextCopy(std::size_t width = sizeof(Value))
  {
    std::size_t count = 0;
    const Value* const values = next<Value>(count, width);
    return {values, values + count};
  }

private:
  std::string_view
  nextBytes(std::size_t width);

  std::string_view bytes_;
  std::shared_ptr<const void> keeper_;
  std::size_t sections_ = 0, next_ = 0;
};

} // namespace pcl_flashreg
