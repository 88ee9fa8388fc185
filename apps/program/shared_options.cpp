// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "shared_options.h"

#include "../io/raw_bin.h"
#include "help_text.h"
#include "pose_format.h"

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

void
addThreads(CLI::App& app, const std::string& group, unsigned& threads)
{
  app.add_option("--threads", threads, wrapped("CPU threads; 0 for all"))
      ->capture_default_str()
      ->group(group);
}

void
addBinFields(CLI::App& app, const std::string& group, std::size_t& fields)
{
  app.add_option(
         "--bin-fields",
         fields,
         wrapped("How many float32 a row of a raw .bin file has, x y z first: 4 in "
                 "KITTI's, 5 in nuScenes' (default: told from the values)"))
      ->type_name("N")
      ->check(CLI::Range(std::size_t{3}, io::kMaxRawFields).description(""))
      ->group(group);
}

void
addPoseFormat(CLI::App& app, const std::string& group, std::string& word)
{
  app.add_option("--format", word, wrapped("Of --poses, whatever its name"))
      ->type_name("tum|kitti|csv|json")
      ->check(CLI::IsMember(POSE_FORMATS).description(""))
      ->group(group);
}

} // namespace pcl_flashreg::program
