// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>
#include <vector>

namespace pcl_flashreg::benchmark {

/** \brief How stage 2 is done. */
enum class SecondOrderModule {
  /** \brief Dense product in single precision, as TurboReg has it. */
  Product,
  /** \brief The same product with inputs of half precision, on tensor cores. */
  HalfProduct,
  /** \brief FastSOG: bounded, as sparse rows. */
  FastSog,
  /** \brief This project's exact form, as sparse rows. */
  Lists
};

/** \brief A row of the ablation: which stages take FlashReg's or this project's form, and
 * which the dense one of TurboReg. */
struct AblationRow {
  std::string name;
  /** \brief Stage 1: FastFOG, a bit matrix; else a matrix of numbers. */
  bool fast_fog;
  SecondOrderModule second_order;
  /** \brief Stages 3 and 4 read the sparse rows; else a dense matrix of scores, into which
   * FastSOG's rows are written. Pivots then come from all entries, and not from the pools:
   * what the bounded form gives for m = L. */
  bool dataflow;
  /** \brief With dataflow: bounded stage 2 and stage 3 in one kernel; with own_rest, stage
   * 7, too. */
  bool fused;
  /** \brief Stages 6 and 7 are this project's; else residuals are written to memory, and
   * rounds of refinement are driven by the host, as in TurboReg. */
  bool own_rest;

  bool
  sparse() const
  {
    return second_order == SecondOrderModule::FastSog ||
           second_order == SecondOrderModule::Lists;
  }
  /** \brief Whether pivots have no time of their own. */
  bool
  pivotsInSecondOrder() const
  {
    return second_order == SecondOrderModule::FastSog && dataflow && fused;
  }
};

/** \brief The eight rows of the paper's table, tab:ablation, then this project's own.
 *
 * The dense reference is what TurboReg computes, with kernels where TurboReg strings tensor
 * operations together: a kernel writes the graph, another masks the product, in place and
 * above the diagonal alone; pivots are sorted from the positive scores and not from all
 * pairs; hypotheses take the closed form instead of a singular value decomposition; a round
 * of refinement is two kernels and one number read back. So it is faster than the original
 * and takes less memory; what is left between it and the other rows is the dense form.
 */
const std::vector<AblationRow>&
ablationRows();

} // namespace pcl_flashreg::benchmark
