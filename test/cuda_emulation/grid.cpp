// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "grid.h"

#include "emulation.h"
#include "fibre.h"
#include "guarded_memory.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace cuda_emulation {
namespace {

constexpr unsigned WARP = 32;

struct Block;

struct Thread {
  Fibre* fibre = nullptr;
  Place place;
  Block* block = nullptr;
  unsigned warp = 0, lane = 0;
  bool ready = true;
  bool done = false;
};

/** \brief An exchange that some lanes of a warp have come to. */
struct Meeting {
  unsigned mask = 0, arrived = 0;
  Exchange what = Exchange::Barrier;
  std::uint64_t values[WARP];
  unsigned operands[WARP];
};

struct Warp {
  std::vector<Meeting> meetings;
  std::uint64_t results[WARP];
  Thread* lanes[WARP] = {};
};

struct Block {
  std::vector<Thread*> threads;
  std::vector<Warp> warps;
  std::unique_ptr<GuardedMemory> shared;
  std::size_t waiting = 0, finished = 0;
  int predicates = 0, predicates_result = 0;
};

struct Grid {
  std::vector<Thread> threads;
  std::vector<Block> blocks;
  const std::function<void()>* body = nullptr;
  std::size_t waiting = 0, finished = 0;
  std::string failure;
};

Grid* grid = nullptr;
Thread* current = nullptr;

/** \brief Stacks are kept from launch to launch. */
Fibre*
fibre(std::size_t i)
{
  static std::vector<std::unique_ptr<Fibre>> fibres;
  while (fibres.size() <= i)
    fibres.push_back(std::make_unique<Fibre>());
  return fibres[i].get();
}

void
wait()
{
  current->ready = false;
  current->fibre->leave();
}

void
runThread(void* argument)
{
  auto* thread = static_cast<Thread*>(argument);
  try {
    (*grid->body)();
  }
  catch (const std::exception& error) {
    grid->failure = error.what();
  }
  thread->done = true;
  thread->ready = false;
  ++thread->block->finished;
  ++grid->finished;
  thread->fibre->leave();
}

/** \brief 0 to n - 1 in the order that the test asks for. */
class Sequence {
public:
  const std::vector<std::size_t>&
  order(std::size_t n)
  {
    order_.resize(n);
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    if (device().order == Order::Reversed)
      std::reverse(order_.begin(), order_.end());
    if (device().order == Order::Random)
      for (std::size_t i = n; i > 1; --i)
        std::swap(order_[i - 1], order_[next() % i]);
    return order_;
  }

private:
  /** \brief SplitMix64 (Steele, Lea and Flood 2014). */
  std::uint64_t
  next()
  {
    std::uint64_t z = (device().seed += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }

  std::vector<std::size_t> order_;
};

/** \brief Runs the threads from `first` on, `count` of them, once each if they are ready.
 * \return whether any was */
bool
runOnce(std::size_t first, std::size_t count, Sequence& sequence)
{
  bool progress = false;
  for (const std::size_t i : sequence.order(count)) {
    Thread& thread = grid->threads[first + i];
    if (!thread.ready || !grid->failure.empty())
      continue;
    current = &thread;
    thread.fibre->resume();
    progress = true;
  }
  return progress;
}

/** \brief Runs all threads for a while. In random order each gets one turn; else a warp
 * goes as far as it gets before the next one begins, so that it is far ahead of those
 * which it does not wait for.
 * \return whether any could run */
bool
runThreads(Sequence& warps, Sequence& lanes)
{
  const std::size_t size = grid->threads.size();
  if (device().order == Order::Random)
    return runOnce(0, size, lanes);
  bool progress = false;
  for (const std::size_t w : warps.order((size + WARP - 1) / WARP)) {
    const std::size_t count = std::min<std::size_t>(WARP, size - w * WARP);
    while (runOnce(w * WARP, count, lanes))
      progress = true;
  }
  return progress;
}

void
setUp(Grid& g,
      const std::vector<dim3>& blocks,
      const dim3& grid_size,
      const dim3& block_size,
      std::size_t shared_bytes)
{
  const std::size_t per_block = std::size_t{block_size.x} * block_size.y * block_size.z;
  g.threads.resize(blocks.size() * per_block);
  g.blocks.resize(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Block& block = g.blocks[b];
    block.shared = std::make_unique<GuardedMemory>(shared_bytes);
    block.warps.resize((per_block + WARP - 1) / WARP);
    for (std::size_t t = 0; t < per_block; ++t) {
      Thread& thread = g.threads[b * per_block + t];
      thread.block = &block;
      thread.warp = static_cast<unsigned>(t / WARP);
      thread.lane = static_cast<unsigned>(t % WARP);
      thread.place.thread = {static_cast<unsigned>(t % block_size.x),
                             static_cast<unsigned>(t / block_size.x % block_size.y),
                             static_cast<unsigned>(t / block_size.x / block_size.y)};
      thread.place.block = blocks[b];
      thread.place.block_size = block_size;
      thread.place.grid_size = grid_size;
      thread.place.shared = block.shared->data();
      thread.fibre = fibre(b * per_block + t);
      thread.fibre->start(&runThread, &thread);
      block.threads.push_back(&thread);
      block.warps[thread.warp].lanes[thread.lane] = &thread;
    }
  }
}

/** \brief Runs the given blocks side by side to their end. */
void
runBlocks(const std::vector<dim3>& blocks,
          const dim3& grid_size,
          const dim3& block_size,
          std::size_t shared_bytes,
          const std::function<void()>& body,
          std::string& failure)
{
  Grid g;
  g.body = &body;
  setUp(g, blocks, grid_size, block_size, shared_bytes);
  grid = &g;
  Sequence warps, lanes;
  while (g.finished < g.threads.size() && g.failure.empty())
    if (!runThreads(warps, lanes) && g.failure.empty())
      g.failure = "threads wait at a barrier that others do not reach";
  grid = nullptr;
  current = nullptr;
  for (const Block& block : g.blocks)
    if (g.failure.empty() && !block.shared->intact())
      g.failure = "a store outside of shared memory";
  failure = g.failure;
}

/** \brief What a lane gets out of a complete exchange. */
std::uint64_t
resultOf(const Meeting& m, unsigned lane)
{
  std::uint64_t result = 0;
  if (m.what == Exchange::Shuffle) {
    const unsigned from = m.operands[lane];
    return (m.mask >> from) & 1 ? m.values[from] : m.values[lane];
  }
  for (unsigned i = 0; i < WARP; ++i) {
    if (!((m.mask >> i) & 1))
      continue;
    if (m.what == Exchange::Ballot)
      result |= static_cast<std::uint64_t>(m.values[i] != 0) << i;
    else if (m.what == Exchange::Add)
      result = static_cast<std::uint32_t>(result + m.values[i]);
    else if (m.what == Exchange::Max)
      result = std::max(result, m.values[i]);
  }
  return result;
}

} // namespace

const Place&
place()
{
  return current->place;
}

std::uint64_t
exchange(unsigned mask, Exchange what, std::uint64_t value, unsigned operand)
{
  Thread* self = current;
  if (!((mask >> self->lane) & 1))
    throw std::logic_error("a lane takes part in an exchange that its mask leaves out");
  Warp& warp = self->block->warps[self->warp];
  auto meeting = std::find_if(warp.meetings.begin(),
                              warp.meetings.end(),
                              [&](const Meeting& m) { return (m.mask & mask) != 0; });
  if (meeting == warp.meetings.end()) {
    warp.meetings.emplace_back();
    meeting = warp.meetings.end() - 1;
    meeting->mask = mask;
    meeting->what = what;
  }
  if (meeting->mask != mask || meeting->what != what)
    throw std::logic_error("lanes of a warp meet in different exchanges");
  meeting->values[self->lane] = value;
  meeting->operands[self->lane] = operand;
  meeting->arrived |= 1u << self->lane;
  if (meeting->arrived != mask) {
    wait();
    return warp.results[self->lane];
  }
  const Meeting complete = *meeting;
  warp.meetings.erase(meeting);
  for (unsigned lane = 0; lane < WARP; ++lane)
    if ((mask >> lane) & 1) {
      if (!warp.lanes[lane])
        throw std::logic_error("a mask names lanes that the block does not have");
      warp.results[lane] = resultOf(complete, lane);
      warp.lanes[lane]->ready = true;
    }
  return warp.results[self->lane];
}

int
blockBarrier(bool predicate)
{
  Block& block = *current->block;
  if (block.finished > 0)
    throw std::logic_error("a barrier after threads of the block have ended");
  block.predicates += predicate;
  if (++block.waiting < block.threads.size()) {
    wait();
    return block.predicates_result;
  }
  block.waiting = 0;
  block.predicates_result = std::exchange(block.predicates, 0);
  for (Thread* thread : block.threads)
    thread->ready = true;
  return block.predicates_result;
}

void
gridBarrier()
{
  if (grid->finished > 0)
    throw std::logic_error("a grid-wide barrier after threads have ended");
  if (++grid->waiting < grid->threads.size()) {
    wait();
    return;
  }
  grid->waiting = 0;
  for (Thread& thread : grid->threads)
    thread.ready = true;
}

const char*
runGrid(const dim3& grid_size,
        const dim3& block_size,
        std::size_t shared_bytes,
        bool at_once,
        const std::function<void()>& body)
{
  static std::string failure;
  failure.clear();
  std::vector<dim3> blocks;
  for (unsigned z = 0; z < grid_size.z; ++z)
    for (unsigned y = 0; y < grid_size.y; ++y)
      for (unsigned x = 0; x < grid_size.x; ++x)
        blocks.push_back({x, y, z});
  // In random order some blocks run side by side, as on a device; else one after another.
  const std::size_t resident = static_cast<std::size_t>(device().multiprocessors) *
                               device().blocks_a_multiprocessor;
  const std::size_t together =
      at_once ? blocks.size() : (device().order == Order::Random ? resident : 1);
  Sequence sequence;
  std::vector<dim3> group;
  for (const std::size_t b : sequence.order(blocks.size())) {
    group.push_back(blocks[b]);
    if (group.size() < together && group.size() < blocks.size())
      continue;
    runBlocks(group, grid_size, block_size, shared_bytes, body, failure);
    group.clear();
    if (!failure.empty())
      break;
  }
  if (!group.empty())
    runBlocks(group, grid_size, block_size, shared_bytes, body, failure);
  return failure.empty() ? nullptr : failure.c_str();
}

} // namespace cuda_emulation
