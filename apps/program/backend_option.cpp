// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "backend_option.h"

#include "help_text.h"

namespace pcl_flashreg::program {

const std::map<std::string, BackendKind> BACKENDS = {{"auto", BackendKind::Auto},
                                                     {"cpu", BackendKind::Cpu},
                                                     {"cuda", BackendKind::Cuda}};

void
addBackend(CLI::App& app, const std::string& group, std::string& word)
{
  app.add_option("--backend", word, wrapped("auto, cpu or cuda"))
      ->capture_default_str()
      ->check(CLI::IsMember(BACKENDS).description(""))
      ->group(group);
}

} // namespace pcl_flashreg::program
