// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// A scan as bytes: a header, the arrays, each from a multiple of 64 bytes on, a checksum.
// Numbers are little-endian.

#include "scan/scan_file.h"

#include "scan/scan_data.h"
#include "support/binary_header.h"
#include "support/checksum.h"
#include "support/whole_file.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <system_error>

namespace pcl_flashreg {
namespace {

constexpr std::string_view MAGIC = "flscan\r\n";
constexpr std::uint32_t VERSION = 2;
constexpr std::uint64_t HAS_VIEWPOINT = 1, HAS_ORIGINS = 2, VIEWPOINT_FROM_POINTS = 4,
                        NORMALS_ORIENTED = 8;
constexpr std::uint64_t ALL_FLAGS =
    HAS_VIEWPOINT | HAS_ORIGINS | VIEWPOINT_FROM_POINTS | NORMALS_ORIENTED;

struct Header {
  FileBeginning beginning;
  std::uint64_t size;
  std::uint64_t dimension;
  std::uint64_t flags;
  double spacing;
  double shift[3];
  double viewpoint[3];
};
static_assert(sizeof(Header) == 96, "no padding: the bytes are the format");

void
append(std::string& bytes, const void* data, std::size_t size)
{
  if (size > 0)
    bytes.append(static_cast<const char*>(data), size);
  bytes.resize(alignedInFile(bytes.size()));
}

template <typename Value>
void
append(std::string& bytes, const Array<Value>& values)
{
  const std::size_t begin = bytes.size();
  append(bytes, values.data(), values.size() * sizeof(Value));
  swapToLittleEndian(&bytes[begin], values.size() * sizeof(Value), sizeof(Value));
}

/** \brief Bytes that a scan with this header has in all. */
std::size_t
sizeFor(const Header& header)
{
  const auto n = static_cast<std::size_t>(header.size);
  std::size_t size = alignedInFile(sizeof(Header));
  for (const std::size_t row :
       {std::size_t{3}, std::size_t{3}, std::size_t{1}, std::size_t{header.dimension}})
    size += alignedInFile(n * row * sizeof(float));
  if (header.flags & HAS_ORIGINS)
    size += alignedInFile(n * sizeof(std::int32_t));
  return size + sizeof(std::uint64_t);
}

/** \brief The next array: a copy, or where it is, if somebody keeps it there. */
template <typename Value>
void
take(std::string_view& bytes,
     const std::shared_ptr<const void>& keeper,
     std::size_t count,
     Array<Value>& array)
{
  if (keeper) {
    array.map(keeper, reinterpret_cast<const Value*>(bytes.data()), count);
  }
  else {
    std::vector<Value> values(count);
    if (count > 0)
      std::memcpy(values.data(), bytes.data(), count * sizeof(Value));
    swapToLittleEndian(
        reinterpret_cast<char*>(values.data()), count * sizeof(Value), sizeof(Value));
    array = std::move(values);
  }
  bytes.remove_prefix(alignedInFile(count * sizeof(Value)));
}

/** \brief What can be told before the arrays are looked at. */
Header
checkedHeader(std::string_view bytes)
{
  const auto header = readHeader<Header, ScanFileError>(
      bytes, MAGIC, VERSION, "is no scan: it does not begin as one");
  const bool from_points = (header.flags & VIEWPOINT_FROM_POINTS) != 0;
  if ((header.flags & ~ALL_FLAGS) != 0 ||
      (from_points && (header.flags & HAS_VIEWPOINT) == 0))
    throw ScanFileError("is damaged: it claims to hold what no scan has");
  constexpr std::uint64_t MOST_ROWS = std::numeric_limits<std::int32_t>::max();
  constexpr std::uint64_t MOST_VALUES = 1 << 20;
  if (header.size > MOST_ROWS || header.dimension > MOST_VALUES)
    throw ScanFileError("is damaged: no scan has so many keypoints or values");
  const std::size_t expected = sizeFor(header);
  if (bytes.size() != expected)
    throw ScanFileError("is incomplete or damaged: it has " +
                        std::to_string(bytes.size()) + " bytes, its header says " +
                        std::to_string(expected));
  return header;
}

bool
allFinite(const Array<float>& values)
{
  for (const float value : values)
    if (!std::isfinite(value))
      return false;
  return true;
}

/** \brief What the rest of the library relies on, whoever wrote the bytes. */
void
checkContents(const Header& header, const Scan::Data& data)
{
  bool sound = data.size() == 0 || (data.spacing > 0 && std::isfinite(data.spacing));
  sound = sound && data.shift.allFinite() && allFinite(data.points);
  if (header.flags & HAS_VIEWPOINT)
    for (const double coordinate : header.viewpoint)
      sound = sound && std::isfinite(coordinate);
  for (const std::int32_t origin : data.origins)
    sound = sound && origin >= 0;
  if (!sound)
    throw ScanFileError("holds numbers that no scan has");
}

Scan
takeScan(const Header& header,
         std::string_view bytes,
         const std::shared_ptr<const void>& keeper)
{
  const auto data = std::make_shared<Scan::Data>();
  const auto n = static_cast<std::size_t>(header.size);
  data->dimension = static_cast<std::size_t>(header.dimension);
  data->spacing = header.spacing;
  data->normals_oriented = (header.flags & NORMALS_ORIENTED) != 0;
  data->shift = Eigen::Map<const Eigen::Vector3d>(header.shift);
  bytes.remove_prefix(alignedInFile(sizeof(header)));
  take(bytes, keeper, 3 * n, data->points);
  take(bytes, keeper, 3 * n, data->normals);
  take(bytes, keeper, n, data->curvatures);
  take(bytes, keeper, n * data->dimension, data->descriptors);
  take(bytes, keeper, header.flags & HAS_ORIGINS ? n : 0, data->origins);
  checkContents(header, *data);
  ViewpointSource source = ViewpointSource::Unknown;
  if (header.flags & HAS_VIEWPOINT)
    source = header.flags & VIEWPOINT_FROM_POINTS ? ViewpointSource::Points
                                                  : ViewpointSource::Stated;
  return {data, Eigen::Map<const Eigen::Vector3d>(header.viewpoint), source};
}

} // namespace

std::string
Scan::serialize() const
{
  const Data& data = *data_;
  Header header = {};
  header.beginning = FileBeginning::of(MAGIC, VERSION);
  header.size = data.size();
  header.dimension = data.dimension;
  header.flags =
      (viewpoint_ ? HAS_VIEWPOINT : 0) | (data.origins.empty() ? 0 : HAS_ORIGINS) |
      (viewpoint_source_ == ViewpointSource::Points ? VIEWPOINT_FROM_POINTS : 0) |
      (data.normals_oriented ? NORMALS_ORIENTED : 0);
  header.spacing = data.spacing;
  Eigen::Map<Eigen::Vector3d>(header.shift) = data.shift;
  if (viewpoint_)
    Eigen::Map<Eigen::Vector3d>(header.viewpoint) = *viewpoint_;

  std::string bytes;
  bytes.reserve(sizeFor(header));
  header = swappedHeader(header);
  append(bytes, &header, sizeof(header));
  append(bytes, data.points);
  append(bytes, data.normals);
  append(bytes, data.curvatures);
  append(bytes, data.descriptors);
  append(bytes, data.origins);
  std::uint64_t checksum = checksumOf(bytes.data(), bytes.size());
  swapToLittleEndian(reinterpret_cast<char*>(&checksum), 8, 8);
  bytes.append(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
  return bytes;
}

Scan
Scan::deserialize(std::string_view bytes)
{
  const Header header = checkedHeader(bytes);
  std::uint64_t checksum;
  const std::size_t end = bytes.size() - sizeof(checksum);
  std::memcpy(&checksum, bytes.data() + end, sizeof(checksum));
  swapToLittleEndian(reinterpret_cast<char*>(&checksum), 8, 8);
  if (checksum != checksumOf(bytes.data(), end))
    throw ScanFileError("is damaged: its checksum is not that of its contents");
  return takeScan(header, bytes, nullptr);
}

Scan
mapScan(std::string_view bytes, const std::shared_ptr<const void>& keeper)
{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  return Scan::deserialize(bytes);
#else
  return takeScan(checkedHeader(bytes), bytes, keeper);
#endif
}

void
Scan::save(const std::string& path) const
{
  try {
    writeWholeFile(path, serialize());
  }
  catch (const std::system_error& error) {
    throw ScanFileError(path + ": cannot be written: " + error.code().message());
  }
}

Scan
Scan::load(const std::string& path)
{
  try {
    return deserialize(readWholeFile(path));
  }
  catch (const std::system_error& error) {
    throw ScanFileError(path + ": cannot be read: " + error.code().message());
  }
  catch (const ScanFileError& error) {
    throw ScanFileError(path + ": " + error.what());
  }
}

} // namespace pcl_flashreg
