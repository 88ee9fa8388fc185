// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/cloud_view.h>
#include <pcl_flashreg/device_correspondences.h>
#include <pcl_flashreg/parameters.h>
#include <pcl_flashreg/result.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_flashreg {

struct Trace;

/** \brief The machine, not the data, kept an estimation from running: no usable device, an
 * instruction set that this processor lacks, a failed device call. */
class PCL_FLASHREG_EXPORT BackendError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief N putative correspondences as two packed arrays; nothing is copied or owned.
 * \tparam Scalar float or double
 */
template <typename Scalar>
struct CorrespondenceView {
  /** \brief N x 3, row-major, source frame. */
  const Scalar* source_xyz = nullptr;
  /** \brief N x 3, row-major, target frame; row i belongs to row i of source_xyz. */
  const Scalar* target_xyz = nullptr;
  /** \brief N. */
  std::size_t size = 0;
  /** \brief N ranks, smaller is better (a descriptor distance), or null: the order of the
   * rows is the rank. They decide which rows are left out beyond
   * Parameters::max_correspondences; a rank that is NaN counts as the worst. */
  const float* ranks = nullptr;
};

/** \brief Rigid transform from correspondences of which most may be wrong, with no initial
 * guess: the method of the FlashReg paper (3-cliques in a second-order compatibility
 * graph), as docs/method.md states it.
 *
 * Deterministic: the same input gives the same result to the last bit, whatever the number
 * of threads, the SIMD variant or the run. An object owns its working memory, so that a
 * second call of the same size allocates next to nothing; use one object per thread.
 *
 * On the CPU, an object may also be used and destroyed in the child of a fork() that was
 * made while no call was running on it; CUDA works in no child of a process that has used
 * it.
 */
class PCL_FLASHREG_EXPORT Estimator {
public:
  /** \param[in] backend where the stages run
   * \param[in] num_threads CPU threads; 0 takes as many as there are processors
   * \throws BackendError if the backend is not to be had on this machine
   * \throws std::invalid_argument if the environment variable PCL_FLASHREG_CPU names an
   * unknown SIMD variant (known: auto, scalar, avx2, avx512, neon)
   */
  explicit Estimator(BackendKind backend = BackendKind::Auto, unsigned num_threads = 0);
  ~Estimator();
  Estimator(Estimator&&) noexcept;
  Estimator&
  operator=(Estimator&&) noexcept;

  /** \brief Estimates T_target_source.
   * \param[in] correspondences rows with a coordinate that is not finite are ignored
   * \param[in] parameters validated first
   * \param[in] guess a pose that is scored as one more hypothesis; never a constraint
   * \param[in] clouds where the correspondences come from, or null: the hypotheses are
   * then judged by how the clouds fit, too, which finds more right poses and tells them
   * from wrong ones far better, and the best is moved onto the surfaces
   * \throws std::invalid_argument if a parameter is out of range, or if a pointer is null
   * while the size is not 0
   * \throws BackendError, std::bad_alloc if the machine fails; the object stays usable
   */
  Result
  estimate(const CorrespondenceView<float>& correspondences,
           const Parameters& parameters = {},
           const std::optional<RigidTransform>& guess = std::nullopt,
           const CloudPairView<float>* clouds = nullptr);

  /** \brief The same for coordinates in double precision: use it where coordinates are
   * large (geo-referenced clouds). They are centred before anything is rounded to single
   * precision. */
  Result
  estimate(const CorrespondenceView<double>& correspondences,
           const Parameters& parameters = {},
           const std::optional<RigidTransform>& guess = std::nullopt,
           const CloudPairView<double>* clouds = nullptr);

  /** \brief The same for correspondences on the device, in single precision: the result is the
   * one that their copies in host memory have, to the last bit.
   * \throws BackendError also if the backend is not CUDA */
  Result
  estimate(const DeviceCorrespondences& correspondences,
           const Parameters& parameters = {},
           const std::optional<RigidTransform>& guess = std::nullopt);

  /** \brief Many problems side by side: on the CPU a thread each, on a device in streams of
   * their own, of which there are as many as threads, eight at most.
   * \param[in] problems neither their number nor their order tells in a result: each is that of
   * estimate(), to the last bit, but for the times
   * \return a result a problem
   * \throws std::invalid_argument as estimate(), before anything is estimated
   * \throws BackendError, std::bad_alloc if the machine fails; the object stays usable
   */
  std::vector<Result>
  estimateBatch(const std::vector<CorrespondenceView<float>>& problems,
                const Parameters& parameters = {});
  std::vector<Result>
  estimateBatch(const std::vector<CorrespondenceView<double>>& problems,
                const Parameters& parameters = {});

  /** \brief For tests and diagnostics: where the next calls leave the output of every
   * stage; null (the default) for nowhere. See src/estimation/trace.h. */
  void
  setTrace(Trace* trace);

  /** \brief Name of the backend that was chosen, e.g. "cpu-avx512". */
  std::string
  backendName() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/** \brief Names of the backends that this machine can run, best first; the SIMD variants
 * of the CPU are listed apart ("cuda", "cpu-avx512", "cpu-avx2", "cpu-scalar"). */
PCL_FLASHREG_EXPORT std::vector<std::string>
availableBackends();

/** \brief Version of the library, "major.minor.patch". */
PCL_FLASHREG_EXPORT const char*
version();

} // namespace pcl_flashreg
