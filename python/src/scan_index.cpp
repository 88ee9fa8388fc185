// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "bindings.h"
#include "scan_files.h"

#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/scan_index.h>

namespace pcl_flashreg::python {
namespace {

using namespace py::literals;

std::string
describe(const ScanIndex& index)
{
  return "ScanIndex(" + std::to_string(index.scan().size()) +
         " keypoints, resolution " + detail::toText(index.scan().spacing()) + ", " +
         std::to_string(index.bytes()) + " bytes)";
}

} // namespace

void
bindScanIndex(py::module_& module)
{
  py::class_<ScanIndex>(module,
                        "ScanIndex",
                        R"(A Scan made ready for smaller ones to be found in it: a map.

Made by PairRegistration.make_index(), and given to align() as the target: what is found in it
is what is found in its scan, to the last bit, sooner. Never changes.
)")
      .def_property_readonly("scan", &ScanIndex::scan, "The scan that it was made of.")
      .def_property_readonly("nbytes", &ScanIndex::bytes, "Of memory, or of the file.")
      .def(
          "save",
          [](const ScanIndex& index, py::handle path) {
            writingFile([&, to = pathOf(path)] { index.save(to); });
          },
          "path"_a,
          "Writes it to a file, whole or not at all.\n\nRaises:\n    OSError: that "
          "failed.\n")
      .def_static(
          "open",
          [](py::handle path, bool verify) {
            return readingFile([from = readablePath(path), verify] {
              return ScanIndex::open(from, verify);
            });
          },
          "path"_a,
          py::kw_only(),
          "verify"_a = false,
          R"(Opens what save() wrote, in milliseconds whatever its size: the file is mapped.

While the index is there the file may be replaced or removed, but nobody may write into it.

Args:
    path: a str or a path.
    verify: whether to read all of it and compare its checksum; without, damage may lead to
        other results, to nothing worse.

Raises:
    OSError: there is no such file.
    ValueError: it is no index, of another version, incomplete or damaged.
)")
      .def("__len__", [](const ScanIndex& index) { return index.scan().size(); })
      .def("__repr__", &describe);
}

} // namespace pcl_flashreg::python
