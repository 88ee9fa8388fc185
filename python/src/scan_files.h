// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Files of the core's own, with Python's exceptions.

#include "call.h"
#include "cloud.h"

#include <pcl_flashreg/scan.h>

#include <cerrno>
#include <string>

namespace pcl_flashreg::python {

/** \brief The bytes of a path to a file that can be read. */
inline std::string
readablePath(py::handle path)
{
  std::string bytes = pathOf(path);
  requireReadableFile(bytes);
  return bytes;
}

/** \brief What reads a file that is there; a damaged one is a ValueError. */
template <typename Read>
auto
readingFile(const Read& read)
{
  try {
    return compute([&](const Cancellation&) { return read(); });
  }
  catch (const ScanFileError& error) {
    throw py::value_error(error.what());
  }
}

/** \brief What writes a file; an OSError where it can't. */
template <typename Write>
void
writingFile(const Write& write)
{
  try {
    computeInterruptibly([&](const Cancellation&) { write(); });
  }
  catch (const ScanFileError& error) {
    PyErr_SetString(PyExc_OSError, error.what());
    throw py::error_already_set();
  }
}

} // namespace pcl_flashreg::python
