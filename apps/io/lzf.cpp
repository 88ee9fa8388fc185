// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "lzf.h"

#include "error.h"

#include <algorithm>
#include <cstring>

// The format is a sequence of two kinds of items, told apart by the first byte c:
//   c < 32   c + 1 bytes follow as they are;
//   else     a copy of earlier output: length (c >> 5) + 2, where 7 + 2 is lengthened
//   by
//            the next byte; then distance - 1, its high 5 bits in c, its low 8 in a
//            byte.

namespace pcl_flashreg::io {
namespace {

constexpr std::size_t kMaxLiterals = 32;
constexpr std::size_t kMinCopy = 3;
constexpr std::size_t kMaxCopy = 264;
constexpr std::size_t kMaxDistance = 8192;
constexpr std::size_t kHashBits = 16;
// Three bytes at least make kMaxCopy.
constexpr std::size_t kMaxExpansion = kMaxCopy / 3;

std::size_t
hashOf(const std::uint8_t* p)
{
  const std::uint32_t three = p[0] | (p[1] << 8) | (p[2] << 16);
  return (three * 2654435761u) >> (32 - kHashBits);
}

void
putLiterals(std::vector<std::uint8_t>& out,
            const std::uint8_t* begin,
            const std::uint8_t* end)
{
  while (begin != end) {
    const auto n = std::min<std::size_t>(kMaxLiterals, end - begin);
    out.push_back(static_cast<std::uint8_t>(n - 1));
    out.insert(out.end(), begin, begin + n);
    begin += n;
  }
}

void
putCopy(std::vector<std::uint8_t>& out, std::size_t distance, std::size_t length)
{
  const std::size_t d = distance - 1;
  const std::size_t l = length - 2;
  if (l < 7) {
    out.push_back(static_cast<std::uint8_t>((l << 5) | (d >> 8)));
  }
  else {
    out.push_back(static_cast<std::uint8_t>((7 << 5) | (d >> 8)));
    out.push_back(static_cast<std::uint8_t>(l - 7));
  }
  out.push_back(static_cast<std::uint8_t>(d & 255));
}

/** \brief How many bytes at a and at b agree, at most limit. */
std::size_t
commonLength(const std::uint8_t* a, const std::uint8_t* b, std::size_t limit)
{
  std::size_t n = 0;
  while (n < limit && a[n] == b[n])
    ++n;
  return n;
}

} // namespace

std::vector<std::uint8_t>
compressLzf(const std::vector<std::uint8_t>& bytes)
{
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> last_seen(std::size_t(1) << kHashBits, none);
  std::vector<std::uint8_t> out;
  out.reserve(bytes.size() / 2);
  const std::uint8_t* const data = bytes.data();
  std::size_t literals = 0;
  std::size_t i = 0;
  while (i + kMinCopy <= bytes.size()) {
    std::size_t& slot = last_seen[hashOf(data + i)];
    const std::size_t earlier = slot;
    slot = i;
    std::size_t length = 0;
    if (earlier != none && i - earlier <= kMaxDistance)
      length =
          commonLength(data + earlier, data + i, std::min(kMaxCopy, bytes.size() - i));
    if (length < kMinCopy) {
      ++i;
      continue;
    }
    putLiterals(out, data + literals, data + i);
    putCopy(out, i - earlier, length);
    i += length;
    literals = i;
  }
  putLiterals(out, data + literals, data + bytes.size());
  return out;
}

std::vector<std::uint8_t>
decompressLzf(std::string_view bytes, std::size_t size)
{
  if (size / kMaxExpansion > bytes.size())
    throw InputError("the compressed body is too short for the points it declares");
  const InputError damaged("the compressed body is damaged");
  std::vector<std::uint8_t> out(size);
  std::size_t done = 0;
  std::size_t i = 0;
  const auto byteAt = [&](std::size_t k) -> std::size_t {
    if (k >= bytes.size())
      throw damaged;
    return static_cast<std::uint8_t>(bytes[k]);
  };
  while (i < bytes.size()) {
    const std::size_t c = byteAt(i++);
    if (c < kMaxLiterals) {
      const std::size_t n = c + 1;
      if (n > bytes.size() - i || n > size - done)
        throw damaged;
      std::memcpy(out.data() + done, bytes.data() + i, n);
      i += n;
      done += n;
      continue;
    }
    std::size_t length = (c >> 5) + 2;
    if (c >> 5 == 7)
      length += byteAt(i++);
    const std::size_t distance = ((c & 31) << 8 | byteAt(i++)) + 1;
    if (distance > done || length > size - done)
      throw damaged;
    // Byte by byte: the copy may overlap what it writes.
    for (std::size_t end = done + length; done < end; ++done)
      out[done] = out[done - distance];
  }
  if (done != size)
    throw damaged;
  return out;
}

} // namespace pcl_flashreg::io
