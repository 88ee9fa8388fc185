// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/scan.h>

namespace pcl_flashreg::evaluate {

struct StoredScan {
  Scan scan;
  /** \brief Milliseconds that it took to make it from the points. */
  double features_ms = 0;
};

} // namespace pcl_flashreg::evaluate
