// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <cstring>
#include <new>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#endif

namespace cuda_emulation {

/** \brief Memory full of rubbish between two zones that nobody may touch: the address
 * sanitizer stops whoever does; without it, intact() tells of stores. */
class GuardedMemory {
public:
  explicit GuardedMemory(std::size_t bytes)
      : bytes_(bytes),
        memory_(static_cast<unsigned char*>(
            ::operator new (bytes + 2 * GUARD, std::align_val_t{GUARD})))
  {
    std::memset(memory_, GUARD_VALUE, GUARD);
    std::memset(memory_ + GUARD + bytes, GUARD_VALUE, GUARD);
    // Large memory is left to the system, which gives it out when it is touched.
    if (bytes <= LARGEST_FILLED)
      std::memset(memory_ + GUARD, RUBBISH, bytes);
#if defined(__SANITIZE_ADDRESS__)
    ASAN_POISON_MEMORY_REGION(memory_, GUARD);
    ASAN_POISON_MEMORY_REGION(memory_ + GUARD + bytes, GUARD);
#endif
  }
  ~GuardedMemory()
  {
#if defined(__SANITIZE_ADDRESS__)
    ASAN_UNPOISON_MEMORY_REGION(memory_, bytes_ + 2 * GUARD);
#endif
    ::operator delete (memory_, std::align_val_t{GUARD});
  }
  GuardedMemory(const GuardedMemory&) = delete;
  GuardedMemory&
  operator=(const GuardedMemory&) = delete;

  unsigned char*
  data() const
  {
    return memory_ + GUARD;
  }
  std::size_t
  size() const
  {
    return bytes_;
  }

  bool
  intact() const
  {
#if !defined(__SANITIZE_ADDRESS__)
    for (std::size_t i = 0; i < GUARD; ++i)
      if (memory_[i] != GUARD_VALUE || memory_[GUARD + bytes_ + i] != GUARD_VALUE)
        return false;
#endif
    return true;
  }

private:
  static constexpr std::size_t GUARD = 256;
  static constexpr std::size_t LARGEST_FILLED = std::size_t{64} << 20;
  static constexpr unsigned char GUARD_VALUE = 0xA5, RUBBISH = 0xCD;

  std::size_t bytes_;
  unsigned char* memory_;
};

} // namespace cuda_emulation
