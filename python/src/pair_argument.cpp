// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pair_argument.h"

#include <memory>

namespace pcl_flashreg::python {
namespace {

template <typename Scalar>
PairArgument::MakeScan
makerOf(const Cloud& cloud, ScanContent content)
{
  const auto input = std::make_shared<const CloudInput<Scalar>>(cloud);
  return [input, content](PairRegistration& registration, double resolution) {
    return registration.makeScan(input->input, resolution, content);
  };
}

} // namespace

PairArgument::PairArgument(py::handle object, const char* name)
{
  if (py::isinstance<Scan>(object))
    scan_ = object.cast<const Scan&>();
  else if (py::isinstance<ScanIndex>(object))
    index_ = object.cast<const ScanIndex&>();
  else
    cloud_ = cloudOf(object, name);
}

std::optional<double>
PairArgument::spacing() const
{
  if (cloud_)
    return std::nullopt;
  return (scan_ ? *scan_ : index_->scan()).spacing();
}

void
PairArgument::requireDescriptors(const char* name) const
{
  if (scan_ && !scan_->empty() && scan_->features().dimension == 0)
    throw py::value_error(std::string(name) + ": is a scan without descriptors, which "
                                              "judges correspondences only");
}

PairArgument::MakeScan
PairArgument::scanMaker(ScanContent content) const
{
  if (cloud_)
    return isDouble() ? makerOf<double>(*cloud_, content)
                      : makerOf<float>(*cloud_, content);
  const Scan scan = scan_ ? *scan_ : index_->scan();
  return [scan](PairRegistration&, double) { return scan; };
}

double
resolutionBeside(const PairArgument& source,
                 const PairArgument& target,
                 const PairOptions& options)
{
  const double of_scan = target.spacing() ? *target.spacing() : *source.spacing();
  return options.resolution.value_or(of_scan);
}

} // namespace pcl_flashreg::python
