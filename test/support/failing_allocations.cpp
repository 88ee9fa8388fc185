// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "support/failing_allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>
#include <thread>

// With -Wl,--wrap=malloc: what this program calls malloc().
extern "C" void*
__real_malloc(std::size_t size);
extern "C" void*
__wrap_malloc(std::size_t size);

namespace pcl_flashreg {
namespace failing_allocations {
namespace {

std::atomic<Mode> mode{Mode::None};
std::atomic<std::thread::id> owner;
std::atomic<long> left{0}, live{0};
std::atomic<std::size_t> failed{0}, all{0};

/** \brief Whether the allocation at hand is to fail. */
bool
fails()
{
  const Mode now = mode.load();
  if (now == Mode::None ||
      (now == Mode::OfWorkersOnce && owner.load() == std::this_thread::get_id()))
    return false;
  const long before = left.fetch_sub(1);
  const bool fail = now == Mode::FromThenOn ? before <= 0 : before == 0;
  if (fail)
    ++failed;
  return fail;
}

} // namespace

void
begin(Mode wanted, std::size_t skip)
{
  owner = std::this_thread::get_id();
  left = static_cast<long>(skip);
  failed = 0;
  mode = wanted;
}

std::size_t
end()
{
  mode = Mode::None;
  return failed;
}

long
liveBlocks()
{
  return live;
}

std::size_t
allBlocks()
{
  return all;
}

namespace {

void*
allocate(std::size_t size, std::size_t alignment)
{
  // aligned_alloc() wants a multiple of the alignment.
  const std::size_t rounded = (size + alignment) / alignment * alignment;
  void* block = fails() ? nullptr : std::aligned_alloc(alignment, rounded);
  if (!block)
    throw std::bad_alloc();
  ++all;
  ++live;
  return block;
}

void
release(void* block) noexcept
{
  if (block)
    --live;
  std::free(block);
}

} // namespace
} // namespace failing_allocations
} // namespace pcl_flashreg

using pcl_flashreg::failing_allocations::allocate;
using pcl_flashreg::failing_allocations::release;

void*
__wrap_malloc(std::size_t size)
{
  return pcl_flashreg::failing_allocations::fails() ? nullptr : __real_malloc(size);
}

// Those that are not here call one of these.
void*
operator new(std::size_t size)
{
  return allocate(size, alignof(std::max_align_t));
}

void*
operator new(std::size_t size, std::align_val_t alignment)
{
  return allocate(size, static_cast<std::size_t>(alignment));
}

void
operator delete(void* block) noexcept
{
  release(block);
}

void
operator delete(void* block, std::size_t) noexcept
{
  release(block);
}

void
operator delete(void* block, std::align_val_t) noexcept
{
  release(block);
}

void
operator delete(void* block, std::size_t, std::align_val_t) noexcept
{
  release(block);
}
