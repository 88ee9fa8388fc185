// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The hot loops one by one, each variant that this processor runs (Google Benchmark). The
// counter "items_per_second" counts pairs, words, residuals or distances.

#include "support/aligned_buffer.h"
#include "simd/kernels.h"
#include "support/made_correspondences.h"

#include <benchmark/benchmark.h>

#include <limits>

namespace pcl_flashreg {
namespace {

using cpu::Kernels;

void
fill(AlignedBuffer<float>& values, std::size_t n, std::uint64_t seed)
{
  made::Random random(seed);
  values.resize(n);
  for (float& value : values)
    value = static_cast<float>(random.uniform(-1.5, 1.5));
}

/** \tparam TEST of all motions, or of upright ones */
template <auto TEST>
void
edgeTest(benchmark::State& state, const Kernels* kernels)
{
  AlignedBuffer<float> x[7], norms[2];
  for (int k = 0; k < 7; ++k)
    fill(x[k], 512, k);
  for (int side = 0; side < 2; ++side) {
    norms[side].resize(512);
    for (std::size_t i = 0; i < 512; ++i)
      norms[side][i] = x[3 * side][i] * x[3 * side][i] +
                       x[3 * side + 1][i] * x[3 * side + 1][i] +
                       x[3 * side + 2][i] * x[3 * side + 2][i];
  }
  const float tau2 = 0.012f * 0.012f;
  const cpu::EdgeTestInput input{
      x[0].data(), x[1].data(),     x[2].data(),     x[3].data(), x[4].data(),
      x[5].data(), norms[0].data(), norms[1].data(), 0.012f,      0.15f,
      true,        -2 * tau2,       tau2 * tau2,     -1e-5f,      1e-5f,
      0.0115f,     0.011f,          x[6].data(),     0.0027f,     1e-7f};
  std::uint64_t sure[64], possible[64];
  std::size_t column = 0;
  for (auto _ : state) {
    (kernels->*TEST)(input, 0, column, sure, possible);
    benchmark::DoNotOptimize(sure);
    benchmark::ClobberMemory();
    column = (column + 64) % 512;
  }
  state.SetItemsProcessed(state.iterations() * 64 * 64);
}

void
transpose(benchmark::State& state, const Kernels* kernels)
{
  std::uint64_t block[64];
  made::Random random(1);
  for (std::uint64_t& word : block)
    word = random.next();
  for (auto _ : state) {
    kernels->transpose(block);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * 64 * 64);
}

void
commonNeighbours(benchmark::State& state, const Kernels* kernels)
{
  constexpr std::size_t STRIDE = 112, ROWS = 1024;
  AlignedBuffer<std::uint64_t> matrix;
  matrix.resize(STRIDE * ROWS);
  made::Random random(1);
  for (std::uint64_t& word : matrix)
    word = random.next();
  std::vector<std::uint32_t> rows, common(64);
  for (std::uint32_t i = 0; i < 64; ++i)
    rows.push_back((i * 37) % ROWS);
  for (auto _ : state) {
    kernels->commonNeighbours(
        matrix.data(), matrix.data(), STRIDE, STRIDE, rows.data(), 64, common.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * 64 * STRIDE);
}

void
residualTest(benchmark::State& state, const Kernels* kernels)
{
  constexpr std::size_t WORDS = 16;
  AlignedBuffer<float> x[6];
  for (int k = 0; k < 6; ++k)
    fill(x[k], 64 * WORDS, k);
  const cpu::ResidualInput input{x[0].data(),
                                 x[1].data(),
                                 x[2].data(),
                                 x[3].data(),
                                 x[4].data(),
                                 x[5].data(),
                                 {1, 0, 0, 0, 1, 0, 0, 0, 1},
                                 {0, 0, 0},
                                 0.0099f,
                                 0.0101f};
  std::uint64_t sure[WORDS], possible[WORDS];
  for (auto _ : state) {
    kernels->residualTest(input, 0, WORDS, sure, possible);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * 64 * WORDS);
}

void
featureCandidates(benchmark::State& state, const Kernels* kernels)
{
  constexpr std::size_t BLOCKS = 64, DIMENSION = 33;
  AlignedBuffer<float> targets, norms, queries;
  fill(targets, BLOCKS * DIMENSION * cpu::FEATURE_BLOCK, 1);
  fill(norms, BLOCKS * cpu::FEATURE_BLOCK, 2);
  fill(queries, cpu::QUERY_BLOCK * DIMENSION, 3);
  const std::vector<float> thresholds(cpu::QUERY_BLOCK,
                                      -std::numeric_limits<float>::infinity());
  std::uint32_t candidates[cpu::QUERY_BLOCK];
  const cpu::FeatureBlock input{targets.data(), norms.data(), DIMENSION};
  const cpu::QueryRows rows{queries.data(), thresholds.data()};
  std::size_t block = 0;
  for (auto _ : state) {
    kernels->featureCandidates(input, block, rows, candidates);
    benchmark::ClobberMemory();
    block = (block + 1) % BLOCKS;
  }
  state.SetItemsProcessed(state.iterations() * cpu::QUERY_BLOCK * cpu::FEATURE_BLOCK);
}

/** \brief Points at random in a cube of which each reaches about one in eight. */
struct Surface {
  static constexpr std::size_t COUNT = 512;
  static constexpr float SQUARED_RADIUS = 0.08f;
  AlignedBuffer<float> columns[6];

  Surface()
  {
    for (int c = 0; c < 6; ++c)
      fill(columns[c], COUNT + cpu::NEIGHBOR_BLOCK, static_cast<std::uint64_t>(c + 1));
  }

  cpu::SurfaceArrays
  arrays() const
  {
    return {columns[0].data(),
            columns[1].data(),
            columns[2].data(),
            columns[3].data(),
            columns[4].data(),
            columns[5].data()};
  }
};

void
collectNeighbors(benchmark::State& state, const Kernels* kernels)
{
  const Surface surface;
  const cpu::PointRun run{0, Surface::COUNT};
  std::vector<std::uint32_t> indices(Surface::COUNT + cpu::NEIGHBOR_BLOCK);
  std::vector<float> distances(indices.size());
  const float query[3] = {
      surface.columns[0][0], surface.columns[1][0], surface.columns[2][0]};
  for (auto _ : state) {
    benchmark::DoNotOptimize(kernels->collectNeighbors(surface.arrays(),
                                                       &run,
                                                       1,
                                                       query,
                                                       Surface::SQUARED_RADIUS,
                                                       indices.data(),
                                                       distances.data()));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * Surface::COUNT);
}

void
pairHistogram(benchmark::State& state, const Kernels* kernels)
{
  const Surface surface;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < Surface::COUNT; ++i)
    indices.push_back((7 * i + 3) % Surface::COUNT);
  std::uint32_t histogram[cpu::FPFH_BINS] = {};
  for (auto _ : state) {
    kernels->pairHistogram(
        surface.arrays(), 0, indices.data(), indices.size(), histogram);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * Surface::COUNT);
}

} // namespace
} // namespace pcl_flashreg

int
main(int argc, char** argv)
{
  using namespace pcl_flashreg;
  std::size_t count = 0;
  const cpu::Kernels* const* kernels = cpu::availableKernels(count);
  const std::pair<const char*, void (*)(benchmark::State&, const cpu::Kernels*)>
      loops[] = {{"edgeTest", edgeTest<&Kernels::edgeTest>},
                 {"uprightEdgeTest", edgeTest<&Kernels::uprightEdgeTest>},
                 {"transpose", transpose},
                 {"commonNeighbours", commonNeighbours},
                 {"residualTest", residualTest},
                 {"featureCandidates", featureCandidates},
                 {"collectNeighbors", collectNeighbors},
                 {"pairHistogram", pairHistogram}};
  for (const auto& [name, loop] : loops)
    for (std::size_t i = 0; i < count; ++i)
      benchmark::RegisterBenchmark(
          (std::string(name) + "/" + kernels[i]->name).c_str(), loop, kernels[i]);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
