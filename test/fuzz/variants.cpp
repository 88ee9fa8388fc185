// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// One input through the code for every instruction set that this machine has.

#include "simd/kernels.h"
#include "support/aligned_buffer.h"
#include "targets.h"

#include <pcl_flashreg/pair_registration.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

namespace pcl_flashreg::fuzz {
namespace {

std::vector<float>
floatsOf(std::string_view bytes, std::size_t most)
{
  std::vector<float> values(std::min(bytes.size() / sizeof(float), most));
  if (!values.empty())
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

/** \brief What a variant made of an input, as bytes. */
class Output {
public:
  template <typename Value>
  void
  add(const Value* values, std::size_t count)
  {
    if (count > 0)
      bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
  }

  /** \brief Which of the many NaN a sum is hangs by the order of its operands. */
  void
  addNumbers(const float* values, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i) {
      const float value = std::isnan(values[i]) ? NAN : values[i];
      add(&value, 1);
    }
  }

  const std::string&
  bytes() const
  {
    return bytes_;
  }

private:
  std::string bytes_;
};

void
expectSame(const std::vector<std::string>& outputs, const char* what)
{
  for (const std::string& output : outputs)
    if (output != outputs.front())
      throw std::logic_error(std::string("instruction sets differ in ") + what);
}

const std::vector<const cpu::Kernels*>&
variants()
{
  static const std::vector<const cpu::Kernels*> all = [] {
    std::size_t count = 0;
    const cpu::Kernels* const* available = cpu::availableKernels(count);
    return std::vector<const cpu::Kernels*>(available, available + count);
  }();
  return all;
}

/** \brief An object for every variant. */
template <typename Object>
std::vector<std::unique_ptr<Object>>
makeForEach(const std::function<std::unique_ptr<Object>()>& make)
{
  std::vector<std::unique_ptr<Object>> objects;
  for (const cpu::Kernels* kernels : variants()) {
    setenv("PCL_FLASHREG_CPU", kernels->name, 1);
    objects.push_back(make());
  }
  unsetenv("PCL_FLASHREG_CPU");
  return objects;
}

/** \brief Oriented points in the layout of the kernels. */
struct OrientedPoints {
  static constexpr std::size_t MOST = 150;

  std::vector<float> columns[6];
  std::size_t size = 0;

  explicit OrientedPoints(const std::vector<float>& values)
      : size(std::min(values.size() / 6, MOST))
  {
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t i = 0; i < size + cpu::NEIGHBOR_BLOCK; ++i)
        columns[k].push_back(i < size ? values[6 * i + k] : 0);
    for (std::size_t i = 0; i < size; ++i)
      normalize(i);
  }

  void
  normalize(std::size_t i)
  {
    double squared = 0;
    for (std::size_t k = 3; k < 6; ++k)
      squared += static_cast<double>(columns[k][i]) * columns[k][i];
    for (std::size_t k = 3; k < 6; ++k)
      columns[k][i] = static_cast<float>(columns[k][i] / std::sqrt(squared));
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

std::string
neighborhoods(const cpu::Kernels& kernels,
              const OrientedPoints& points,
              float squared_radius)
{
  Output output;
  std::vector<std::uint32_t> indices(points.size + 2 * cpu::NEIGHBOR_BLOCK);
  std::vector<float> distances(indices.size());
  const auto end = static_cast<std::uint32_t>(points.size);
  for (std::uint32_t query = 0; query < end; query += 1 + end / 8) {
    const cpu::PointRun runs[] = {{0, query / 2}, {query / 2, query}, {query, end}};
    const float at[] = {
        points.columns[0][query], points.columns[1][query], points.columns[2][query]};
    std::size_t count = kernels.collectNeighbors(
        points.arrays(), runs, 3, at, squared_radius, indices.data(), distances.data());
    output.add(&count, 1);
    output.add(indices.data(), count);
    output.addNumbers(distances.data(), count);
    while (count % cpu::NEIGHBOR_BLOCK != 0)
      indices[count++] = query;
    float sums[9];
    kernels.momentSums(points.arrays(), at, indices.data(), count, sums);
    output.addNumbers(sums, 9);
    std::uint32_t histogram[cpu::FPFH_BINS] = {};
    kernels.pairHistogram(points.arrays(), query, indices.data(), count, histogram);
    output.add(histogram, cpu::FPFH_BINS);
  }
  return output.bytes();
}

std::string
rowSums(const cpu::Kernels& kernels, const std::vector<float>& values)
{
  const std::size_t count = values.size() / cpu::HISTOGRAM_STRIDE;
  AlignedBuffer<float> rows;
  rows.resize(count * cpu::HISTOGRAM_STRIDE);
  std::copy_n(values.begin(), rows.size(), rows.begin());
  std::vector<std::uint32_t> indices;
  std::vector<float> weights;
  for (std::size_t i = 0; i < count; ++i) {
    indices.push_back(static_cast<std::uint32_t>(count - 1 - i));
    weights.push_back(values[values.size() - 1 - i]);
  }
  float sum[cpu::HISTOGRAM_STRIDE];
  kernels.weightedRowSum(rows.data(), indices.data(), weights.data(), count, sum);
  Output output;
  output.addNumbers(sum, cpu::HISTOGRAM_STRIDE);
  return output.bytes();
}

/** \brief Rows of 64 words, as many as there are bytes for. */
std::string
bitRows(const cpu::Kernels& kernels, std::string_view bytes)
{
  constexpr std::size_t WORDS = 64, ROW = WORDS * sizeof(std::uint64_t);
  const std::size_t count = std::min<std::size_t>(bytes.size() / ROW, 8);
  if (count < 2)
    return "";
  AlignedBuffer<std::uint64_t> rows;
  rows.resize(count * WORDS);
  std::memcpy(rows.data(), bytes.data(), count * ROW);
  Output output;
  std::vector<std::uint32_t> others, common(count), bits(64 * WORDS), a(bits), b(bits);
  for (std::size_t i = 0; i < count; ++i)
    others.push_back(static_cast<std::uint32_t>(count - 1 - i));
  kernels.commonNeighbours(
      rows.data(), rows.data(), WORDS, WORDS, others.data(), count, common.data());
  output.add(common.data(), count);
  const std::size_t first = rows[0] % WORDS;
  const std::size_t shared = kernels.intersect(rows.data(),
                                               rows.data() + WORDS,
                                               first,
                                               WORDS,
                                               rows[1],
                                               bits.data(),
                                               a.data(),
                                               b.data());
  for (const auto* list : {&bits, &a, &b})
    output.add(list->data(), shared);
  const std::size_t set = kernels.countBits(rows.data(), rows.size());
  output.add(&set, 1);
  kernels.transpose(rows.data());
  output.add(rows.data(), WORDS);
  return output.bytes();
}

std::string
bytesOf(const Result& result)
{
  Output output;
  output.add(&result.status, 1);
  output.add(result.T_target_source.rotation.data(), 9);
  output.add(result.T_target_source.translation.data(), 3);
  output.add(&result.confidence, 1);
  output.add(&result.score, 1);
  output.add(result.inliers.data(), result.inliers.size());
  for (const Hypothesis& hypothesis : result.hypotheses)
    output.add(hypothesis.T_target_source.translation.data(), 3);
  return output.bytes();
}

/** \brief A cloud whose coordinates are the bytes, and its scan. */
std::string
scanAndRegistration(PairRegistration& registration, std::vector<float> xyz)
{
  ScanInput<float> input;
  input.points.data = xyz.data();
  input.points.size = xyz.size() / 3;
  PairOptions options;
  options.resolution = 0.25;
  try {
    const Scan scan = registration.makeScan(input, *options.resolution);
    // Against a part of it, so that there is something to choose.
    input.points.size /= 2;
    const PairResult result =
        registration.align(registration.makeScan(input, 0.2), scan, options);
    Output matches;
    matches.add(result.matches.data(), result.matches.size());
    return scan.serialize() + bytesOf(result.pose) + matches.bytes();
  }
  catch (const std::invalid_argument& error) {
    return error.what();
  }
}

} // namespace

void
kernelsOnEveryVariant(std::string_view bytes)
{
  const std::vector<float> values = floatsOf(bytes, 6 * 200);
  if (values.empty())
    return;
  const OrientedPoints points(values);
  std::vector<std::string> neighbors, sums, rows;
  for (const cpu::Kernels* kernels : variants()) {
    neighbors.push_back(neighborhoods(*kernels, points, std::abs(values.back())));
    sums.push_back(rowSums(*kernels, values));
    rows.push_back(bitRows(*kernels, bytes));
  }
  expectSame(neighbors, "neighbourhoods");
  expectSame(sums, "sums of rows");
  expectSame(rows, "rows of bits");
}

void
estimateOnEveryVariant(std::string_view bytes)
{
  static const auto estimators = makeForEach<Estimator>(
      [] { return std::make_unique<Estimator>(BackendKind::Cpu, 1); });
  const std::vector<float> values = floatsOf(bytes, 6 * 200);
  const std::size_t n = values.size() / 6;
  for (const SecondOrder second_order : {SecondOrder::Exact, SecondOrder::Bounded}) {
    Parameters parameters;
    parameters.second_order = second_order;
    std::vector<std::string> results;
    for (const auto& estimator : estimators)
      results.push_back(bytesOf(estimator->estimate(
          CorrespondenceView<float>{values.data(), values.data() + 3 * n, n, nullptr},
          parameters)));
    expectSame(results, "estimates");
  }
}

void
registerOnEveryVariant(std::string_view bytes)
{
  static const auto registrations = makeForEach<PairRegistration>(
      [] { return std::make_unique<PairRegistration>(BackendKind::Cpu, 1); });
  std::vector<std::string> results;
  for (const auto& registration : registrations)
    results.push_back(scanAndRegistration(*registration, floatsOf(bytes, 3 * 300)));
  expectSame(results, "registrations");
}

} // namespace pcl_flashreg::fuzz
