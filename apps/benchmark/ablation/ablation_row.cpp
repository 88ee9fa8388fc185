// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "ablation_row.h"

namespace pcl_flashreg::benchmark {

const std::vector<AblationRow>&
ablationRows()
{
  using Module = SecondOrderModule;
  static const std::vector<AblationRow> rows = {
      // name, FastFOG, stage 2, dataflow, fused, own stages 6 and 7
      {"Dense reference", false, Module::Product, false, false, false},
      {"FastFOG", true, Module::Product, false, false, false},
      {"FastSOG", false, Module::FastSog, false, false, false},
      {"FastFOG + FastSOG", true, Module::FastSog, false, false, false},
      {"FastSOG + dataflow (fused)", false, Module::FastSog, true, true, false},
      {"FastSOG + dataflow (split)", false, Module::FastSog, true, false, false},
      {"Full (split)", true, Module::FastSog, true, false, false},
      {"Full (fused)", true, Module::FastSog, true, true, false},
      {"Dense, tensor cores", false, Module::HalfProduct, false, false, false},
      {"Full (split), own rest", true, Module::FastSog, true, false, true},
      {"Full (fused), own rest", true, Module::FastSog, true, true, true},
      {"Exact (split), own rest", true, Module::Lists, true, false, true},
      {"Exact (fused), own rest", true, Module::Lists, true, true, true},
  };
  return rows;
}

} // namespace pcl_flashreg::benchmark
