// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "modules.h"

#include <dlfcn.h>
#include <unistd.h>

#include <climits>
#include <stdexcept>

namespace pcl_flashreg::program {
namespace {

/** \brief The folder of this program, with a slash. */
std::string
programFolder()
{
  char path[PATH_MAX];
  const ssize_t length = readlink("/proc/self/exe", path, sizeof(path));
  const std::string program(path, length > 0 ? static_cast<std::size_t>(length) : 0);
  return program.substr(0, program.rfind('/') + 1);
}

} // namespace

void*
loadFunction(const std::string& module, const char* function)
{
  const std::string folder = programFolder();
  std::string problem = module + " is not installed";
  for (const std::string& place : {folder, folder + PCL_FLASHREG_MODULE_FOLDER "/"}) {
    const std::string path = place + module;
    if (access(path.c_str(), F_OK) != 0)
      continue;
    void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* address = handle ? dlsym(handle, function) : nullptr;
    if (address)
      return address;
    problem = dlerror();
  }
  throw std::runtime_error("a part of the program can't be loaded: " + problem);
}

} // namespace pcl_flashreg::program
