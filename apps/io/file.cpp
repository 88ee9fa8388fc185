// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "file.h"

#include "error.h"
#include "support/whole_file.h"

#include <cctype>
#include <filesystem>
#include <system_error>

namespace fs = std::filesystem;

namespace pcl_flashreg::io {
namespace {

[[noreturn]] void
fail(const std::string& path, const char* what, const std::error_code& reason)
{
  throw InputError(path + ": cannot be " + what + ": " + reason.message());
}

} // namespace

std::string
readFile(const std::string& path)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    throw InputError(path + ": no such file");
  if (error)
    fail(path, "opened", error);
  if (fs::is_directory(status))
    throw InputError(path + ": is a directory, not a file");
  if (!fs::is_regular_file(status) && !fs::is_fifo(status))
    throw InputError(path + ": is neither a file nor a pipe");
  std::string bytes;
  try {
    bytes = readWholeFile(path);
  }
  catch (const std::system_error& failure) {
    fail(path, "read", failure.code());
  }
  if (bytes.empty())
    throw InputError(path + ": is empty");
  return bytes;
}

void
writeFile(const std::string& path, const std::string& bytes)
{
  std::error_code unknown;
  if (fs::is_directory(path, unknown))
    throw InputError(path + ": cannot be written: it is a directory");
  try {
    writeWholeFile(path, bytes);
  }
  catch (const std::system_error& failure) {
    fail(path, "written", failure.code());
  }
}

std::string
extensionOf(const std::string& path)
{
  std::string extension = fs::path(path).extension().string();
  // Not by std::tolower(), which asks the user's language.
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

} // namespace pcl_flashreg::io
