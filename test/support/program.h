// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// For tests that run a built program as a user does, on files in a folder of their own.

#include "support/temporary_folder.h"

#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace pcl_flashreg {

/** \brief What a run of a program left. */
struct ProgramRun {
  /** \brief Exit status; 128 and more if a signal ended it. */
  int status = -1;
  std::string out, err;

  nlohmann::json
  json() const
  {
    return nlohmann::json::parse(out);
  }
};

/** \brief Runs programs in a folder of its own. */
class ProgramTest : public FolderTest {
protected:
  void
  write(const std::string& name, const std::string& text) const
  {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  std::string
  read(const std::string& name) const
  {
    std::ifstream stream(folder_ / name, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  /** \brief Runs a program in the folder.
   * \param[in] arguments as they are typed into a shell
   * \param[in] launcher what is typed before the program
   */
  ProgramRun
  runProgram(const std::string& program,
             const std::string& arguments,
             const std::string& launcher = "") const
  {
    const std::string command = "cd '" + folder_.string() + "' && " + launcher + " '" +
                                program + "' " + arguments + " >.out 2>.err </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            read(".out"),
            read(".err")};
  }
};

} // namespace pcl_flashreg
