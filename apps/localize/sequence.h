// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "locator.h"

#include <pcl_flashreg/sequence_localization.h>

#include <string>
#include <vector>

namespace pcl_flashreg::localize {

/** \brief Where scans of known relative motion are, all together. */
struct LocatedSequence {
  /** \brief With the poses. */
  std::string file;
  /** \brief That could be used. */
  std::size_t scans = 0;
  /** \brief Converged if it is trusted, which a sequence with a scan beyond --near is not. */
  SequenceResult result;
  std::vector<std::string> warnings;
  /** \brief Milliseconds, beside what the scans took. */
  double placing = 0;

  bool
  isTrusted() const
  {
    return result.converged;
  }
};

/** \brief As of a scan. */
std::vector<const SequencePlacement*>
rivalsOf(const SequenceResult& result);

/** \brief Finds the scans of a sequence, each by itself, and then all together.
 * \param[out] scans in their order
 * \throws io::InputError if the poses can't be read, or are not those of the files
 * \throws BackendError, std::bad_alloc if the machine fails */
LocatedSequence
locateSequence(const Options& options,
               const std::vector<program::ScanFile>& files,
               Locator& locator,
               std::vector<Located>& scans);

/** \brief The pose of each file in the sequence.
 * \throws io::InputError as locateSequence() */
std::vector<RigidTransform>
sequencePoses(const Options& options, const std::vector<program::ScanFile>& files);

} // namespace pcl_flashreg::localize
