// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 2, exact, Eq. (sog): every edge (u, v) of the first-order graph is scored by the
// neighbours that u and v share. The bounded form is second_order_graph_bounded.cu.
//
// Two ways to count them, chosen edge by edge. Row u is a bit set in shared memory; either
// every neighbour of v, from its list, is looked up there (4 bytes a neighbour, and shared
// memory answers about ten random words a cycle), or row v's words are fetched and ANDed
// (4 bytes for 32 columns, 16 population counts a cycle). Lists win where v has few
// neighbours, which is nearly everywhere: at N = 7000 with 5 % inliers, 80 % of the 281 k
// edges end in a row of about 75 neighbours out of 7000. Bytes from the second-level
// cache: 246 MB if every edge takes rows, 157 MB if every edge takes lists, 125 MB mixed.
// Scores are kept for edges only, in the order of the lists.

#include "cuda/estimation/second_order_graph.cuh"

#include "cuda/support/block.cuh"
#include "cuda/support/launch.cuh"
#include "cuda/estimation/pivot_selection.cuh"

namespace pcl_flashreg {
namespace cuda {
namespace {

constexpr unsigned LIST_WARPS = 8;
/** \brief A block is through when its row is, and the rows of inliers have ten times as many
 * edges as the others: so many warps that these don't outlast all else. */
constexpr unsigned SCORE_WARPS = 8;

/** \brief The bits of word w that stand for columns above u. */
__device__ inline unsigned
above(unsigned word, unsigned w, unsigned u)
{
  if (w != u / WARP)
    return w > u / WARP ? word : 0;
  const unsigned bit = u % WARP;
  return bit == WARP - 1 ? 0 : word & (ALL_LANES << (bit + 1));
}

/** \brief Where the lists of the rows of a block begin. */
struct ListShared {
  unsigned degree[LIST_WARPS], above[LIST_WARPS];
  unsigned long long begin, edges_begin;
};

/** \brief Writes the columns of a row of bits, ascending, a warp a row. */
__device__ inline void
writeColumns(const unsigned* row, unsigned words, unsigned* columns)
{
  unsigned written = 0;
  for (unsigned first = 0; first < words; first += WARP) {
    const unsigned w = first + laneIndex();
    unsigned bits = w < words ? row[w] : 0;
    const unsigned count = __popc(bits);
    const unsigned inclusive = warpInclusiveScan(count);
    for (unsigned at = written + inclusive - count; bits != 0; bits &= bits - 1)
      columns[at++] = w * WARP + __ffs(static_cast<int>(bits)) - 1;
    written += __shfl_sync(ALL_LANES, inclusive, WARP - 1);
  }
}

/** \brief Counts neighbours and lists them, a warp a row. A block takes room for its rows
 * wherever there is some: nothing depends on the order of the lists. */
__global__ void
__launch_bounds__(LIST_WARPS* WARP) listRows(const Call call)
{
  ListShared& shared = *reinterpret_cast<ListShared*>(sharedMemory());
  const unsigned lane = laneIndex(), warp = warpIndex();
  const unsigned u = blockIdx.x * LIST_WARPS + warp;
  const unsigned* row = call.graph + static_cast<std::size_t>(u) * call.words;
  unsigned degree = 0, degree_above = 0;
  if (u < call.size)
    for (unsigned w = lane; w < call.words; w += WARP) {
      degree += __popc(row[w]);
      degree_above += __popc(above(row[w], w, u));
    }
  degree = warpSum(degree);
  degree_above = warpSum(degree_above);
  if (lane == 0) {
    shared.degree[warp] = degree;
    shared.above[warp] = degree_above;
  }
  __syncthreads();
  if (threadIdx.x == 0) {
    unsigned long long entries = 0, edges = 0;
    for (unsigned i = 0; i < LIST_WARPS; ++i) {
      entries += shared.degree[i];
      edges += shared.above[i];
    }
    shared.begin = atomicAdd(&call.control->entries, entries);
    shared.edges_begin = atomicAdd(&call.control->edges, edges);
  }
  __syncthreads();
  unsigned long long begin = shared.begin, edges_begin = shared.edges_begin;
  for (unsigned i = 0; i < warp; ++i) {
    begin += shared.degree[i];
    edges_begin += shared.above[i];
  }
  if (u >= call.size || !call.exact || begin + degree > call.entry_capacity)
    return; // planHolds() sees it, too
  const unsigned first = static_cast<unsigned>(begin);
  const unsigned scores_first = static_cast<unsigned>(edges_begin);
  writeColumns(row, call.words, call.neighbours + first);
  if (lane == 0) {
    call.neighbour_rows[u] = {first, degree, degree_above, scores_first};
    call.upper.rows[u] = {first + degree - degree_above, scores_first, degree_above};
  }
}

/** \brief Shared memory, with a row of the bit matrix behind it. */
struct alignas(16) ScoreShared {
  BlockScratch scratch;
  unsigned histogram[SHARED_BINS];
  unsigned best;

  __device__ unsigned*
  bits()
  {
    return reinterpret_cast<unsigned*>(this + 1);
  }
};

/** \brief Columns of a list that a lane looks up at a time. */
constexpr unsigned AHEAD = 4;

/** \brief Neighbours that v shares with the row in shared memory; a warp an edge.
 * \param[in] absent a column whose bit is not set: the row's own */
__device__ inline unsigned
countShared(const Call& call,
            const unsigned* bits,
            unsigned absent,
            unsigned v,
            unsigned begin,
            unsigned degree)
{
  unsigned count = 0;
  if (2 * degree < call.words)
    for (unsigned first = laneIndex(); first < degree; first += AHEAD * WARP) {
      // All of them on their way before the first is waited for.
      unsigned columns[AHEAD];
#pragma unroll
      for (unsigned j = 0; j < AHEAD; ++j) {
        const unsigned i = first + j * WARP;
        columns[j] = i < degree ? call.neighbours[begin + i] : absent;
      }
#pragma unroll
      for (unsigned j = 0; j < AHEAD; ++j)
        count += (bits[columns[j] / WARP] >> (columns[j] % WARP)) & 1;
    }
  else {
    const auto* row = reinterpret_cast<const uint4*>(
        call.graph + static_cast<std::size_t>(v) * call.words);
    const auto* mine = reinterpret_cast<const uint4*>(bits);
    for (unsigned w = laneIndex(); w < call.words / 4; w += WARP) {
      const uint4 a = mine[w], b = row[w];
      count +=
          __popc(a.x & b.x) + __popc(a.y & b.y) + __popc(a.z & b.z) + __popc(a.w & b.w);
    }
  }
  return warpSum(count);
}

/** \brief Scores row u's edges, dealt out to the warps one by one. */
__device__ inline void
scoreRow(const Call& call, unsigned u, const Neighbours& row, ScoreShared& shared)
{
  const unsigned lane = laneIndex();
  const unsigned* columns = call.neighbours + row.begin + row.degree - row.above;
  for (unsigned first = 0; first < row.above; first += SCORE_WARPS * WARP) {
    // Every lane reads up on one edge, then the warp scores them one after the other.
    const unsigned e = first + lane * SCORE_WARPS + warpIndex();
    const bool mine = e < row.above;
    const unsigned v = mine ? columns[e] : 0;
    const Neighbours other = call.neighbour_rows[v];
    const unsigned edges = __popc(__ballot_sync(ALL_LANES, mine));
    unsigned score = 0;
    for (unsigned i = 0; i < edges; ++i) {
      const unsigned count = countShared(call,
                                         shared.bits(),
                                         u,
                                         __shfl_sync(ALL_LANES, v, i),
                                         __shfl_sync(ALL_LANES, other.begin, i),
                                         __shfl_sync(ALL_LANES, other.degree, i));
      if (lane == i)
        score = count;
    }
    if (!mine)
      continue;
    call.upper.scores[row.scores_begin + e] = score;
    if (score == 0)
      continue;
    atomicMax(&shared.best, score);
    if (score < SHARED_BINS)
      atomicAdd(&shared.histogram[score], 1u);
    else
      atomicAdd(&call.histogram[score], 1u);
  }
}

/** \brief A block a row. */
__global__ void
__launch_bounds__(SCORE_WARPS* WARP) scoreRows(const Call call)
{
  if (!planHolds(call))
    return;
  ScoreShared& shared = *reinterpret_cast<ScoreShared*>(sharedMemory());
  const unsigned u = blockIdx.x;
  const Neighbours row = call.neighbour_rows[u];
  if (row.above > 0) {
    const unsigned* bits = call.graph + static_cast<std::size_t>(u) * call.words;
    for (unsigned w = threadIdx.x; w < call.words; w += blockDim.x)
      shared.bits()[w] = bits[w];
  }
  for (unsigned i = threadIdx.x; i < SHARED_BINS; i += blockDim.x)
    shared.histogram[i] = 0;
  if (threadIdx.x == 0)
    shared.best = 0;
  __syncthreads();
  scoreRow(call, u, row, shared);
  __syncthreads();
  const unsigned best = shared.best;
  for (unsigned i = threadIdx.x; i < SHARED_BINS && i <= best; i += blockDim.x)
    if (shared.histogram[i] > 0)
      atomicAdd(&call.histogram[i], shared.histogram[i]);
  if (threadIdx.x == 0) {
    call.row_best[u] = best;
    atomicMax(&call.control->best_score, best);
  }
  if (lastBlock(&call.control->score_ticket))
    findCut(call, shared.scratch);
}

} // namespace

void
listNeighbours(const Call& call, cudaStream_t stream)
{
  if (!call.exact && call.second_order == SecondOrder::Bounded)
    return;
  const Shape shape{dim3((call.size + LIST_WARPS - 1) / LIST_WARPS),
                    dim3(LIST_WARPS * WARP),
                    sizeof(ListShared)};
  launch(&listRows, shape, stream, call);
}

void
scoreExactly(const Call& call, cudaStream_t stream)
{
  const Shape shape{dim3(call.size),
                    dim3(SCORE_WARPS * WARP),
                    sizeof(ScoreShared) + call.words * sizeof(unsigned)};
  launch(&scoreRows, shape, stream, call);
}

} // namespace cuda
} // namespace pcl_flashreg
