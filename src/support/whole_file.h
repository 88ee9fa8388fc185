// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Files that are read and written as a whole. In a header, since the library keeps its
// symbols to itself and the programs do the same.

#include <pcl_flashreg/impl/number_text.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

namespace pcl_flashreg {

/** \brief Why the last call of the system failed. */
[[noreturn]] inline void
throwSystemError()
{
  throw std::system_error(errno, std::generic_category());
}

/** \brief Repeats a call of the system that a signal interrupts.
 * \throws std::system_error if it fails */
template <typename Call>
auto
systemCall(const Call& call)
{
  for (;;) {
    const auto result = call();
    if (result >= 0)
      return result;
    if (errno != EINTR)
      throwSystemError();
  }
}

/** \brief An open file. */
class OpenFile {
public:
  /** \throws std::system_error if it can't be opened */
  OpenFile(const std::string& path, int flags)
      : fd_(systemCall([&] { return ::open(path.c_str(), flags | O_CLOEXEC, 0666); }))
  {
  }
  ~OpenFile()
  {
    ::close(fd_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile&
  operator=(const OpenFile&) = delete;

  int
  descriptor() const
  {
    return fd_;
  }

  /** \brief Bytes of a plain file.
   * \throws std::system_error if it is none */
  std::size_t
  plainSize() const
  {
    struct stat status;
    systemCall([&] { return ::fstat(fd_, &status); });
    if (!S_ISREG(status.st_mode))
      throw std::system_error(S_ISDIR(status.st_mode) ? EISDIR : ESPIPE,
                              std::generic_category());
    return static_cast<std::size_t>(status.st_size);
  }

  /** \brief All bytes that are left.
   * \throws std::system_error if that fails midway */
  std::string
  readAll() const
  {
    struct stat status;
    systemCall([&] { return ::fstat(fd_, &status); });
    // One byte more than a file has shows its end without another buffer.
    const std::size_t expected =
        S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 65536;
    std::string bytes(expected + 1, '\0');
    std::size_t done = 0;
    for (;;) {
      const auto n =
          systemCall([&] { return ::read(fd_, &bytes[done], bytes.size() - done); });
      if (n == 0)
        break;
      done += static_cast<std::size_t>(n);
      if (done == bytes.size())
        bytes.resize(2 * done);
    }
    bytes.resize(done);
    return bytes;
  }

  /** \throws std::system_error if not all of them could be written */
  void
  writeAll(std::string_view bytes) const
  {
    while (!bytes.empty()) {
      const auto n =
          systemCall([&] { return ::write(fd_, bytes.data(), bytes.size()); });
      if (n == 0)
        throw std::system_error(EIO, std::generic_category());
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
  }

  /** \brief Waits until the device has what was written. */
  void
  sync() const
  {
    systemCall([&] { return ::fsync(fd_); });
  }

private:
  int fd_;
};

/** \brief Beside a file, for what will replace it; no other thread of this machine has this
 * name at the time. */
inline std::string
partNameOf(const std::string& path)
{
  return path + ".part" + std::to_string(::getpid()) + '-' +
         detail::toText(std::this_thread::get_id());
}

/** \brief Puts bytes into a file under another name, which is then renamed. */
inline void
replaceFile(const std::string& path, std::string_view bytes)
{
  /** Removes the file unless it has its name. */
  struct Part {
    const std::string name;
    bool is_there = false;

    ~Part()
    {
      if (is_there)
        ::unlink(name.c_str());
    }
  } part{partNameOf(path)};
  // A process of the same number that was killed may have left one.
  ::unlink(part.name.c_str());
  {
    const OpenFile file(part.name, O_WRONLY | O_CREAT | O_EXCL);
    part.is_there = true;
    file.writeAll(bytes);
    file.sync();
  }
  systemCall([&] { return std::rename(part.name.c_str(), path.c_str()); });
  part.is_there = false;
}

/** \brief The bytes of a file or a pipe.
 * \throws std::system_error with the reason, also if reading fails midway */
inline std::string
readWholeFile(const std::string& path)
{
  return OpenFile(path, O_RDONLY).readAll();
}

/** \brief Puts bytes into a file in place of what it held, if any; where that fails, at
 * whatever point, what was there is there, and nothing beside it. A link stays a link: what
 * it points to is replaced. Devices and pipes are written to directly.
 * \throws std::system_error with the reason */
inline void
writeWholeFile(const std::string& path, std::string_view bytes)
{
  namespace fs = std::filesystem;
  std::error_code unknown;
  const fs::file_status status = fs::status(path, unknown);
  if (!fs::exists(status))
    replaceFile(path, bytes);
  else if (fs::is_regular_file(status))
    replaceFile(fs::canonical(path).string(), bytes);
  else
    OpenFile(path, O_WRONLY).writeAll(bytes);
}

} // namespace pcl_flashreg
