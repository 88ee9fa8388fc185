// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/estimator.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <map>
#include <string>

namespace pcl_flashreg::program {

/** \brief What --backend takes. */
extern const std::map<std::string, BackendKind> BACKENDS;

/** \brief --backend. */
void
addBackend(CLI::App& app, const std::string& group, std::string& word);

/** \brief --threads. */
void
addThreads(CLI::App& app, const std::string& group, unsigned& threads);

/** \brief --bin-fields; 0 to tell it from the values. */
void
addBinFields(CLI::App& app, const std::string& group, std::size_t& fields);

/** \brief --format, of files of poses. */
void
addPoseFormat(CLI::App& app, const std::string& group, std::string& word);

} // namespace pcl_flashreg::program
