// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pcl_flashreg::fuzz {

/** \brief Something that must take any bytes without a crash: it gives a sound result
 * or throws io::InputError. Whatever else it throws, and std::logic_error for an
 * unsound result, is a finding. */
using Target = void (*)(std::string_view);

void
readPcd(std::string_view bytes);

void
readPly(std::string_view bytes);

void
readRawBin(std::string_view bytes);

/** \brief Correspondences in all their forms. */
void
readCorrespondences(std::string_view bytes);

void
readTransform(std::string_view bytes);

/** \brief Scan::deserialize(), with the bytes' own checksum and with the right one, and a
 * registration of what comes out. */
void
readScan(std::string_view bytes);

/** \brief The estimator on correspondences whose coordinates are the bytes. */
void
estimate(std::string_view bytes);

/** \brief Hot loops, the estimator on correspondences and the registration of points that
 * are the bytes: the same for every instruction set of this machine, to the last bit. */
void
kernelsOnEveryVariant(std::string_view bytes);
void
estimateOnEveryVariant(std::string_view bytes);
void
registerOnEveryVariant(std::string_view bytes);

/** \brief A target, and inputs from which mutations reach far into it. */
struct NamedTarget {
  const char* name;
  Target target;
  std::vector<std::string> seeds;
  /** \brief Mutations of each seed. */
  int rounds = 4000;
  /** \brief Bytes that are cut off at a time. */
  std::size_t truncation = 1;
};

std::vector<NamedTarget>
allTargets();

} // namespace pcl_flashreg::fuzz
