// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 2, bounded: FastSOG, Eq. (sog_trunc) and (ell_sog), with stage 3 in the same kernel
// where the device launches cooperatively.
//
// A block takes one row after the other. The voters, the row's first L neighbours, are a
// bit set in shared memory that ends with the word of the last of them; a candidate's votes
// are the bits that its own row shares with them (by symmetry its column), a warp a
// candidate. On the dense graphs that this form is for, that set is a few words, and one
// load a lane fetches a candidate's. Candidates are gathered and positive ones compacted in
// the order of columns, by ballots and prefix sums.

#include "cuda/estimation/second_order_graph.cuh"

#include "cuda/support/block.cuh"
#include "cuda/support/launch.cuh"
#include "cuda/estimation/pivot_selection.cuh"

#include <cooperative_groups.h>

#include <algorithm>

namespace pcl_flashreg {
namespace cuda {
namespace {

constexpr unsigned THREADS = 128;
constexpr unsigned WARPS = THREADS / WARP;
/** \brief Candidates that are gathered at a time: one a thread. */
constexpr unsigned GATHERED = THREADS;
/** \brief Words of a candidate's row that a lane fetches at a time. */
constexpr unsigned AHEAD = 4;

struct Shared {
  BlockScratch scratch;
  unsigned voter_words;
  /** \brief Number of candidates that were gathered, and where the next ones begin: a word
   * of the row, and how many of its bits are through. */
  unsigned gathered, next_word, next_bit;
  unsigned columns[GATHERED], votes[GATHERED];
};

/** \brief Shared memory: a Shared, then these arrays. */
struct Layout {
  Shared* shared;
  /** \brief Call::words words. */
  unsigned* voters;
  /** \brief The row at hand: row_capacity entries each. */
  unsigned *row_columns, *row_scores;
  /** \brief Of the pools of all rows of this block: row_capacity + 1 bins. */
  unsigned* histogram;

  __device__
  Layout(const Call& call, unsigned char* memory)
      : shared(reinterpret_cast<Shared*>(memory)),
        voters(reinterpret_cast<unsigned*>(memory + sizeof(Shared))),
        row_columns(voters + call.words),
        row_scores(row_columns + call.row_capacity),
        histogram(row_scores + call.row_capacity)
  {
  }
  static std::size_t
  bytes(const Call& call)
  {
    return sizeof(Shared) +
           sizeof(unsigned) * (call.words + 3 * std::size_t{call.row_capacity} + 1);
  }
};

/** \brief Keeps the lowest `count` of the bits. */
__device__ inline unsigned
lowestBits(unsigned bits, unsigned count)
{
  unsigned rest = bits;
  for (unsigned i = 0; i < count; ++i)
    rest &= rest - 1;
  return bits & ~rest;
}

/** \brief Copies the first L neighbours; the first warp. */
__device__ inline void
gatherVoters(const unsigned* row, const Call& call, const Layout& memory)
{
  unsigned open = call.row_capacity;
  unsigned words = 0;
  for (unsigned first = 0; first < call.words && open > 0; first += WARP) {
    const unsigned w = first + laneIndex();
    const unsigned bits = w < call.words ? row[w] : 0;
    const unsigned count = __popc(bits);
    const unsigned inclusive = warpInclusiveScan(count);
    const unsigned before = inclusive - count;
    const bool voting = count > 0 && before < open;
    if (w < call.words)
      memory.voters[w] =
          !voting ? 0 : (inclusive <= open ? bits : lowestBits(bits, open - before));
    const unsigned ballot = __ballot_sync(ALL_LANES, voting);
    if (ballot != 0)
      words = first + WARP - static_cast<unsigned>(__clz(static_cast<int>(ballot)));
    const unsigned total = __shfl_sync(ALL_LANES, inclusive, WARP - 1);
    open -= min(open, total);
  }
  if (laneIndex() == 0)
    memory.shared->voter_words = words;
}

/** \brief Lists the next neighbours above u, up to GATHERED; the first warp. */
__device__ inline void
gatherCandidates(const unsigned* row, const Call& call, Shared& shared)
{
  unsigned word = shared.next_word, bit = shared.next_bit;
  unsigned gathered = 0;
  __syncwarp();
  for (; word < call.words && gathered < GATHERED; word += WARP, bit = 0) {
    const unsigned w = word + laneIndex();
    unsigned bits = w < call.words ? row[w] : 0;
    if (laneIndex() == 0)
      bits = bit < WARP ? bits & (ALL_LANES << bit) : 0;
    const unsigned count = __popc(bits);
    const unsigned inclusive = warpInclusiveScan(count);
    unsigned at = gathered + inclusive - count;
    for (; bits != 0 && at < GATHERED; bits &= bits - 1)
      shared.columns[at++] = w * WARP + __ffs(static_cast<int>(bits)) - 1;
    const unsigned stop = __ballot_sync(ALL_LANES, bits != 0);
    gathered = min(GATHERED, gathered + __shfl_sync(ALL_LANES, inclusive, WARP - 1));
    if (stop != 0) {
      // The first lane with bits left is where the next call goes on.
      const int lane = __ffs(static_cast<int>(stop)) - 1;
      word = __shfl_sync(ALL_LANES, w, lane);
      bit = __shfl_sync(
          ALL_LANES, static_cast<unsigned>(__ffs(static_cast<int>(bits)) - 1), lane);
      break;
    }
  }
  if (laneIndex() == 0) {
    shared.gathered = gathered;
    shared.next_word = word;
    shared.next_bit = bit;
  }
}

/** \brief Votes for the gathered candidates, a warp a candidate. */
__device__ inline void
countVotes(const Call& call, const Layout& memory)
{
  Shared& shared = *memory.shared;
  const unsigned voter_words = shared.voter_words;
  for (unsigned c = warpIndex(); c < shared.gathered; c += WARPS) {
    const unsigned* row =
        call.graph + static_cast<std::size_t>(shared.columns[c]) * call.words;
    unsigned count = 0;
    for (unsigned first = laneIndex(); first < voter_words; first += AHEAD * WARP) {
      // All of them on their way before the first is waited for.
      unsigned words[AHEAD];
#pragma unroll
      for (unsigned j = 0; j < AHEAD; ++j) {
        const unsigned w = first + j * WARP;
        words[j] = w < voter_words ? row[w] : 0;
      }
#pragma unroll
      for (unsigned j = 0; j < AHEAD; ++j)
        if (words[j] != 0)
          count += __popc(memory.voters[first + j * WARP] & words[j]);
    }
    count = warpSum(count);
    if (laneIndex() == 0)
      shared.votes[c] = count;
  }
}

/** \brief Builds row u's entries in shared memory.
 * \return their number */
__device__ inline unsigned
buildRow(const Call& call, unsigned u, const Layout& memory)
{
  Shared& shared = *memory.shared;
  const unsigned* row = call.graph + static_cast<std::size_t>(u) * call.words;
  if (warpIndex() == 0) {
    gatherVoters(row, call, memory);
    if (laneIndex() == 0) {
      shared.next_word = u / WARP;
      shared.next_bit = u % WARP + 1;
    }
    __syncwarp();
  }
  unsigned length = 0;
  for (;;) {
    if (warpIndex() == 0)
      gatherCandidates(row, call, shared);
    __syncthreads();
    const unsigned gathered = shared.gathered;
    countVotes(call, memory);
    __syncthreads();
    const bool positive = threadIdx.x < gathered && shared.votes[threadIdx.x] > 0;
    unsigned total = 0;
    const unsigned at =
        length + blockExclusiveScan(positive ? 1 : 0, shared.scratch, total);
    if (positive && at < call.row_capacity) {
      memory.row_columns[at] = shared.columns[threadIdx.x];
      memory.row_scores[at] = shared.votes[threadIdx.x];
    }
    length = min(call.row_capacity, length + total);
    __syncthreads();
    if (gathered < GATHERED || length == call.row_capacity)
      return length;
  }
}

/** \brief Writes the row and its pool: an entry's place there is the number of entries
 * that are better. */
__device__ inline void
writeRow(const Call& call, unsigned u, unsigned length, const Layout& memory)
{
  const unsigned begin = u * call.row_capacity;
  const unsigned pool_begin = u * call.pool_capacity;
  for (unsigned i = threadIdx.x; i < length; i += THREADS) {
    const unsigned column = memory.row_columns[i], score = memory.row_scores[i];
    call.upper.columns[begin + i] = column;
    call.upper.scores[begin + i] = score;
    unsigned better = 0;
    for (unsigned k = 0; k < length; ++k)
      better +=
          memory.row_scores[k] > score || (memory.row_scores[k] == score && k < i);
    if (better >= call.pool_capacity)
      continue;
    call.pool.columns[pool_begin + better] = column;
    call.pool.scores[pool_begin + better] = score;
    atomicAdd(&memory.histogram[score], 1u);
    if (better == 0) {
      call.row_best[u] = score;
      atomicMax(&call.control->best_score, score);
    }
  }
  if (threadIdx.x == 0) {
    call.upper.rows[u] = {begin, begin, length};
    call.pool.rows[u] = {pool_begin, pool_begin, min(length, call.pool_capacity)};
    if (length == 0)
      call.row_best[u] = 0;
  }
}

/** \brief The block's rows, the histogram of all pools, and the cut. */
__device__ inline void
scoreAllRows(const Call& call, const Layout& memory)
{
  for (unsigned i = threadIdx.x; i <= call.row_capacity; i += THREADS)
    memory.histogram[i] = 0;
  __syncthreads();
  for (unsigned u = blockIdx.x; u < call.size; u += gridDim.x) {
    const unsigned length = buildRow(call, u, memory);
    writeRow(call, u, length, memory);
    __syncthreads();
  }
  for (unsigned i = threadIdx.x; i <= call.row_capacity; i += THREADS)
    if (memory.histogram[i] > 0)
      atomicAdd(&call.histogram[i], memory.histogram[i]);
  if (lastBlock(&call.control->score_ticket))
    findCut(call, memory.shared->scratch);
}

__global__ void
__launch_bounds__(THREADS) scoreRows(const Call call)
{
  if (planHolds(call))
    scoreAllRows(call, Layout(call, sharedMemory()));
}

__global__ void
__launch_bounds__(THREADS) scoreRowsAndSelect(const Call call)
{
  if (!planHolds(call))
    return;
  const Layout memory(call, sharedMemory());
  scoreAllRows(call, memory);
  cooperative_groups::this_grid().sync();
  collectAboveCut(call, memory.shared->scratch);
  cooperative_groups::this_grid().sync();
  collectTies(call);
}

Shape
shapeOf(const Call& call, unsigned resident_blocks)
{
  return {dim3(std::max(1u, std::min(call.size, resident_blocks))),
          dim3(THREADS),
          Layout::bytes(call)};
}

} // namespace

void
scoreBounded(const Call& call, unsigned multiprocessors, cudaStream_t stream)
{
  const unsigned resident =
      residentBlocks(&scoreRows, shapeOf(call, 1), multiprocessors);
  launch(&scoreRows, shapeOf(call, resident), stream, call);
}

void
scoreBoundedAndSelect(const Call& call, unsigned multiprocessors, cudaStream_t stream)
{
  const unsigned resident =
      residentBlocks(&scoreRowsAndSelect, shapeOf(call, 1), multiprocessors);
  launchCooperative(&scoreRowsAndSelect, shapeOf(call, resident), stream, call);
}

} // namespace cuda
} // namespace pcl_flashreg
