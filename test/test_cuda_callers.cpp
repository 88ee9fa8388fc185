// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Programs that live on the device, on the emulated one: correspondences in its memory, streams
// of theirs, batches, several devices and threads.

#include "emulation.h"
#include "support/made_batch.h"
#include "support/same_result.h"

#include <pcl_flashreg/estimator.h>

#include <cuda_runtime.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <thread>

namespace pcl_flashreg {
namespace {

/** \brief An array in device memory, or pinned. */
class Floats {
public:
  using Allocate = cudaError_t (*)(void**, std::size_t);
  using Free = cudaError_t (*)(void*);

  Floats(std::size_t n, Allocate allocate, Free free) : free_(free)
  {
    void* memory = nullptr;
    EXPECT_EQ(allocate(&memory, n * sizeof(float)), cudaSuccess);
    data = static_cast<float*>(memory);
  }
  ~Floats()
  {
    free_(data);
  }
  Floats(const Floats&) = delete;
  Floats&
  operator=(const Floats&) = delete;

  float* data;

private:
  Free free_;
};

class CudaCallers : public testing::Test {
protected:
  void
  SetUp() override
  {
    cuda_emulation::reset();
    made::Recipe recipe;
    recipe.size = N;
    recipe.inlier_ratio = 0.3;
    const made::Correspondences made = made::make(recipe);
    source_.assign(made.source.begin(), made.source.end());
    target_.assign(made.target.begin(), made.target.end());
    for (std::size_t i = 0; i < N; ++i)
      ranks_.push_back(static_cast<float>((7 * i) % N));
    ASSERT_EQ(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), cudaSuccess);
    Floats* to[] = {&device_source_, &device_target_, &device_ranks_, &staging_};
    for (const Floats* memory : to)
      ASSERT_NE(memory->data, nullptr);
  }
  void
  TearDown() override
  {
    cudaStreamDestroy(stream_);
  }

  /** \brief Has them copied in the caller's stream, which is not waited for. */
  DeviceCorrespondences
  sendPoints(bool with_ranks = false)
  {
    std::copy(source_.begin(), source_.end(), staging_.data);
    std::copy(target_.begin(), target_.end(), staging_.data + 3 * N);
    std::copy(ranks_.begin(), ranks_.end(), staging_.data + 6 * N);
    const auto send = [&](float* to, const float* from, std::size_t n) {
      ASSERT_EQ(
          cudaMemcpyAsync(to, from, n * sizeof(float), cudaMemcpyHostToDevice, stream_),
          cudaSuccess);
    };
    send(device_source_.data, staging_.data, 3 * N);
    send(device_target_.data, staging_.data + 3 * N, 3 * N);
    send(device_ranks_.data, staging_.data + 6 * N, N);
    DeviceCorrespondences sent;
    sent.source_xyz = device_source_.data;
    sent.target_xyz = device_target_.data;
    sent.size = N;
    sent.ranks = with_ranks ? device_ranks_.data : nullptr;
    sent.stream = stream_;
    return sent;
  }

  CorrespondenceView<float>
  onHost(bool with_ranks = false) const
  {
    return {source_.data(), target_.data(), N, with_ranks ? ranks_.data() : nullptr};
  }

  std::array<float, 16>
  poseIn(const Floats& memory)
  {
    std::array<float, 16> pose{};
    cudaMemcpyAsync(
        pose.data(), memory.data, sizeof pose, cudaMemcpyDeviceToHost, stream_);
    return pose;
  }

  static constexpr std::size_t N = 300;
  std::vector<float> source_, target_, ranks_;
  cudaStream_t stream_ = nullptr;
  Floats device_source_{3 * N, &cudaMalloc, &cudaFree};
  Floats device_target_{3 * N, &cudaMalloc, &cudaFree};
  Floats device_ranks_{N, &cudaMalloc, &cudaFree};
  Floats staging_{7 * N, &cudaMallocHost, &cudaFreeHost};
};

TEST_F(CudaCallers, GetWhatCopiesOnTheHostGet)
{
  Estimator estimator(BackendKind::Cuda, 1);
  for (const bool with_ranks : {false, true}) {
    Parameters parameters;
    parameters.max_correspondences = 200;
    const Result expected = estimator.estimate(onHost(with_ranks), parameters);
    EXPECT_EQ(expected.correspondences_dropped, N - 200);
    expectSameResult(expected, estimator.estimate(sendPoints(with_ranks), parameters));
  }
}

TEST_F(CudaCallers, FindThePoseWhereTheyAskedForIt)
{
  Estimator estimator(BackendKind::Cuda, 1);
  const Floats first(16, &cudaMalloc, &cudaFree), second(16, &cudaMalloc, &cudaFree);
  DeviceCorrespondences sent = sendPoints();
  sent.T_target_source = first.data;
  const Result result = estimator.estimate(sent);
  ASSERT_TRUE(result.converged);
  // One that has no pose, while the other's may be on its way.
  sent.size = 2;
  sent.T_target_source = second.data;
  EXPECT_EQ(estimator.estimate(sent).status, Status::TooFewCorrespondences);
  const Eigen::Matrix4f T = result.T_target_source.toMatrix<float>();
  const std::array<float, 16> found = poseIn(first), none = poseIn(second);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      EXPECT_EQ(found[4 * row + column], T(row, column));
      EXPECT_EQ(none[4 * row + column], row == column ? 1 : 0);
    }
}

TEST_F(CudaCallers, AreToldWhatIsWrong)
{
  Estimator estimator(BackendKind::Cuda, 1);
  DeviceCorrespondences sent = sendPoints();
  sent.target_xyz = nullptr;
  EXPECT_THROW(estimator.estimate(sent), std::invalid_argument);
  sent = {};
  EXPECT_EQ(estimator.estimate(sent).status, Status::TooFewCorrespondences);
}

/** \brief Warm calls wait for the points and for the result, and allocate nothing. */
TEST_F(CudaCallers, AreWaitedForTwice)
{
  Estimator estimator(BackendKind::Cuda, 1);
  Parameters parameters;
  const DeviceCorrespondences sent = sendPoints();
  estimator.estimate(sent, parameters);
  const std::size_t host = [&] {
    estimator.estimate(onHost(), parameters);
    const std::size_t before = cuda_emulation::counters().synchronisations;
    estimator.estimate(onHost(), parameters);
    return cuda_emulation::counters().synchronisations - before;
  }();
  const cuda_emulation::Counters before = cuda_emulation::counters();
  estimator.estimate(sent, parameters);
  EXPECT_EQ(cuda_emulation::counters().allocations, before.allocations);
  EXPECT_EQ(cuda_emulation::counters().synchronisations,
            before.synchronisations + host + 1);
}

TEST_F(CudaCallers, SurviveAnyFailedAllocation)
{
  const Result expected = Estimator(BackendKind::Cuda, 1).estimate(onHost());
  const Floats pose(16, &cudaMalloc, &cudaFree);
  std::size_t failures = 0;
  for (std::size_t n = 0;; ++n) {
    Estimator estimator(BackendKind::Cuda, 1);
    DeviceCorrespondences sent = sendPoints();
    sent.T_target_source = pose.data;
    cuda_emulation::device().allocations_left = n;
    bool failed = false;
    try {
      estimator.estimate(sent);
    }
    catch (const BackendError&) {
      failed = true;
      ++failures;
    }
    cuda_emulation::device().allocations_left = 1000;
    if (n % 5 == 0 || !failed)
      expectSameResult(expected, estimator.estimate(sent));
    if (!failed)
      break; // so many are enough
  }
  EXPECT_GT(failures, 10u);
}

TEST_F(CudaCallers, HaveBatches)
{
  const made::Batch batch;
  std::vector<Result> expected;
  Estimator one(BackendKind::Cuda, 1);
  for (const CorrespondenceView<double>& view : batch.views())
    expected.push_back(one.estimate(view));
  for (const unsigned threads : {1u, 3u}) {
    Estimator many(BackendKind::Cuda, threads);
    const std::vector<Result> found = many.estimateBatch(batch.views());
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      expectSameResult(expected[i], found[i]);
  }
}

/** \brief An estimator stays on the device that it was made on, and leaves the callers' threads
 * theirs. */
TEST_F(CudaCallers, MayHaveSeveralDevicesAndThreads)
{
  cuda_emulation::device().count = 2;
  const Result expected = Estimator(BackendKind::Cuda, 1).estimate(onHost());
  ASSERT_EQ(cudaSetDevice(1), cudaSuccess);
  Estimator estimator(BackendKind::Cuda, 2);
  ASSERT_EQ(cudaSetDevice(0), cudaSuccess);
  expectSameResult(expected, estimator.estimate(onHost()));
  for (const Result& found : estimator.estimateBatch({onHost(), onHost(), onHost()}))
    expectSameResult(expected, found);
  std::thread([&] {
    expectSameResult(expected, estimator.estimate(onHost()));
    int current = -1;
    EXPECT_EQ(cudaGetDevice(&current), cudaSuccess);
    EXPECT_EQ(current, 0);
  }).join();
}

} // namespace
} // namespace pcl_flashreg
