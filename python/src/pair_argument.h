// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <pcl_flashreg/pair_registration.h>

#include <functional>
#include <optional>

namespace pcl_flashreg::python {

/** \brief The source or the target of a registration: a cloud, a scan or an index. */
class PairArgument {
public:
  PairArgument(py::handle object, const char* name);

  /** \brief Nothing if it is a scan or an index. */
  const std::optional<Cloud>&
  cloud() const
  {
    return cloud_;
  }

  /** \brief Nothing if it is something else. */
  const std::optional<ScanIndex>&
  index() const
  {
    return index_;
  }

  bool
  isDouble() const
  {
    return cloud_ && python::isDouble(cloud_->points());
  }

  /** \brief Of the scan or the index; nothing of a cloud. */
  std::optional<double>
  spacing() const;

  /** \throws ValueError if it is a scan with keypoints, but with no descriptors */
  void
  requireDescriptors(const char* name) const;

  using MakeScan = std::function<Scan(PairRegistration&, double resolution)>;
  /** \brief Makes the scan, or has it; what is returned may be called without Python's lock,
   * and is to be destroyed with it. */
  MakeScan
  scanMaker(ScanContent content) const;

private:
  std::optional<Cloud> cloud_;
  std::optional<Scan> scan_;
  std::optional<ScanIndex> index_;
};

/** \brief The voxel size for a cloud that is registered with a scan. */
double
resolutionBeside(const PairArgument& source,
                 const PairArgument& target,
                 const PairOptions& options);

} // namespace pcl_flashreg::python
