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

class Shuffler {
public:
  /** \brief The order of this pass over n things. */
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
          Shuffler& shuffler,
          std::string& failure)
{
  Grid g;
  g.body = &body;
  setUp(g, blocks, grid_size, block_size, shared_bytes);
  grid = &g;
  while (g.finished < g.threads.size() && g.failure.empty()) {
    bool progress = false;
    for (const std::size_t i : shuffler.order(g.threads.size()))
      if (g.threads[i].ready && g.failure.empty()) {
        current = &g.threads[i];
        current->fibre->resume();
        progress = true;
      }
    if (!progress && g.failure.empty())
      g.failure = "threads wait at a barrier that others do not reach";
  }
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
  Shuffler shuffler;
  if (at_once)
    runBlocks(blocks, grid_size, block_size, shared_bytes, body, shuffler, failure);
  else {
    Shuffler block_shuffler;
    for (const std::size_t b : block_shuffler.order(blocks.size())) {
      runBlocks(
          {blocks[b]}, grid_size, block_size, shared_bytes, body, shuffler, failure);
      if (!failure.empty())
        break;
    }
  }
  return failure.empty() ? nullptr : failure.c_str();
}

} // namespace cuda_emulation
