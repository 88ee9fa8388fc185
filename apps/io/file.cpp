// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "file.h"

#include "error.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace fs = std::filesystem;

namespace pcl_flashreg::io {
namespace {

std::string
systemMessage()
{
  return std::strerror(errno);
}

/** \brief An open file descriptor. */
class Descriptor {
public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor()
  {
    if (fd_ >= 0)
      ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor&
  operator=(const Descriptor&) = delete;

  int
  get() const
  {
    return fd_;
  }

private:
  int fd_;
};

bool
writeAll(int fd, const std::string& bytes)
{
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(fd, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0)
      return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

void
writeDirectly(const std::string& path, const std::string& bytes)
{
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0 || !writeAll(file.get(), bytes))
    throw InputError(path + ": cannot be written: " + systemMessage());
}

} // namespace

std::string
readFile(const std::string& path)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    throw InputError(path + ": no such file");
  if (fs::is_directory(status))
    throw InputError(path + ": is a directory, not a file");
  if (!fs::is_regular_file(status) && !fs::is_fifo(status))
    throw InputError(path + ": is neither a file nor a pipe");
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw InputError(path + ": cannot be opened: " + systemMessage());
  std::string bytes;
  if (fs::is_regular_file(status)) {
    const auto size = fs::file_size(path, error);
    bytes.resize(error ? 0 : static_cast<std::size_t>(size));
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
  }
  else {
    std::ostringstream all;
    all << stream.rdbuf();
    bytes = all.str();
  }
  if (bytes.empty())
    throw InputError(path + ": is empty");
  return bytes;
}

void
writeFile(const std::string& path, const std::string& bytes)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status))
    throw InputError(path + ": cannot be written: it is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status))
    return writeDirectly(path, bytes);
  // A link stays a link: what it points to is replaced.
  const std::string final_path =
      fs::exists(status) ? fs::canonical(path, error).string() : path;
  const std::string temporary = final_path + ".part" + std::to_string(::getpid());
  // A process of the same number that was killed may have left one.
  ::unlink(temporary.c_str());
  {
    const Descriptor file(
        ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.get() < 0)
      throw InputError(path + ": cannot be written: " + systemMessage());
    if (!writeAll(file.get(), bytes) || ::fsync(file.get()) != 0) {
      const std::string message = systemMessage();
      ::unlink(temporary.c_str());
      throw InputError(path + ": cannot be written: " + message);
    }
  }
  fs::rename(temporary, final_path, error);
  if (error) {
    ::unlink(temporary.c_str());
    throw InputError(path + ": cannot be written: " + error.message());
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
