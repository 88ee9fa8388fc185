// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "support/archive.h"

#include "support/aligned_buffer.h"
#include "support/binary_header.h"
#include "support/checksum.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

namespace pcl_flashreg {
namespace {

struct Header {
  FileBeginning beginning;
  std::uint64_t sections;
  std::uint64_t size;
  /** \brief Of the table, and of the arrays. */
  std::uint64_t table_checksum, checksum;
  std::uint64_t reserved[2];
};
static_assert(sizeof(Header) == FILE_ALIGNMENT, "no padding: the bytes are the format");

/** \brief Bytes of a row of the table. */
constexpr std::size_t ROW = 3 * sizeof(std::uint64_t);

/** \brief Row i of the table. */
std::array<std::uint64_t, 3>
rowOf(std::string_view bytes, std::size_t i)
{
  std::array<std::uint64_t, 3> row;
  std::memcpy(row.data(), bytes.data() + sizeof(Header) + i * ROW, ROW);
  swapToLittleEndian(reinterpret_cast<char*>(row.data()), ROW, 8);
  return row;
}

/** \brief Where the arrays begin. */
std::size_t
arraysAt(std::size_t sections)
{
  return alignedInFile(sizeof(Header) + sections * ROW);
}

/** \brief What can be told without the arrays. */
Header
checkedHeader(std::string_view bytes, std::string_view magic, std::uint32_t version)
{
  const auto header = readHeader<Header, ArchiveError>(
      bytes, magic, version, "is not what it should be: it does not begin as one");
  if (header.size != bytes.size())
    throw ArchiveError("is incomplete or damaged: it has " +
                       std::to_string(bytes.size()) + " bytes, its header says " +
                       std::to_string(header.size));
  if (header.reserved[0] != 0 || header.reserved[1] != 0 ||
      header.sections > bytes.size() / ROW ||
      arraysAt(header.sections) > bytes.size() ||
      header.table_checksum != checksumOf(bytes.data() + sizeof(Header),
                                          arraysAt(header.sections) - sizeof(Header)))
    throw ArchiveError("is damaged: its table is not what was written");
  return header;
}

#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
/** \brief A copy whose numbers are in this machine's order. */
std::shared_ptr<AlignedBuffer<char>>
swappedCopy(std::string_view bytes, std::size_t sections)
{
  const auto copy = std::make_shared<AlignedBuffer<char>>();
  copy->resize(bytes.size());
  std::copy(bytes.begin(), bytes.end(), copy->data());
  for (std::size_t i = 0; i < sections; ++i) {
    const auto [begin, size, width] = rowOf(bytes, i);
    swapToLittleEndian(copy->data() + begin, size, width);
  }
  return copy;
}
#endif

} // namespace

void
ArchiveWriter::add(const void* data, std::size_t size, std::size_t width)
{
  sections_.push_back({arrays_.size(), size, width});
  const std::size_t begin = arrays_.size();
  if (size > 0)
    arrays_.append(static_cast<const char*>(data), size);
  swapToLittleEndian(&arrays_[begin], size, width);
  arrays_.resize(alignedInFile(arrays_.size()));
}

std::string
ArchiveWriter::take()
{
  const std::size_t begin = arraysAt(sections_.size());
  std::string table;
  for (const Section& section : sections_) {
    std::uint64_t row[] = {begin + section.begin, section.size, section.width};
    swapToLittleEndian(reinterpret_cast<char*>(row), ROW, 8);
    table.append(reinterpret_cast<const char*>(row), ROW);
  }
  table.resize(begin - sizeof(Header));
  Header header = {};
  header.beginning = FileBeginning::of(magic_, version_);
  header.sections = sections_.size();
  header.size = begin + arrays_.size();
  header.table_checksum = checksumOf(table.data(), table.size());
  header.checksum = checksumOf(arrays_.data(), arrays_.size());
  header = swappedHeader(header);
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof(header));
  bytes.reserve(begin + arrays_.size());
  bytes += table;
  bytes += arrays_;
  arrays_.clear();
  sections_.clear();
  return bytes;
}

ArchiveReader::ArchiveReader(std::string_view bytes,
                             std::shared_ptr<const void> keeper,
                             std::string_view magic,
                             std::uint32_t version,
                             bool verify)
    : bytes_(bytes), keeper_(std::move(keeper))
{
  const Header header = checkedHeader(bytes, magic, version);
  sections_ = static_cast<std::size_t>(header.sections);
  const std::size_t begin = arraysAt(sections_);
  for (std::size_t i = 0; i < sections_; ++i) {
    const auto [at, size, width] = rowOf(bytes, i);
    if (at % FILE_ALIGNMENT != 0 || at < begin || at > bytes.size() ||
        size > bytes.size() - at || width == 0 || size % width != 0)
      throw ArchiveError("is damaged: an array lies outside of it");
  }
  if (verify &&
      header.checksum != checksumOf(bytes.data() + begin, bytes.size() - begin))
    throw ArchiveError("is damaged: its checksum is not that of its contents");
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  const auto copy = swappedCopy(bytes, sections_);
  bytes_ = {copy->data(), copy->size()};
  keeper_ = copy;
#endif
}

std::string_view
ArchiveReader::nextBytes(std::size_t width)
{
  if (next_ == sections_)
    throw ArchiveError("is damaged: an array is missing");
  const auto [begin, size, own_width] = rowOf(bytes_, next_++);
  if (own_width != width)
    throw ArchiveError("is damaged: an array has other values than it should");
  return bytes_.substr(begin, size);
}

} // namespace pcl_flashreg
