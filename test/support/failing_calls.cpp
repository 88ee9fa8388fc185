// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "support/failing_calls.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>
#include <sys/uio.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>

namespace pcl_flashreg {
namespace failing_calls {
namespace {

bool armed = false, has_failed = false;
Call which;
int failure;
std::size_t left;

bool
fails(Call call)
{
  if (!armed || call != which || left-- > 0)
    return false;
  armed = false;
  has_failed = true;
  return true;
}

/** \brief What the program would call without this file. */
template <typename Function>
Function*
next(const char* name)
{
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/** \brief Whether the call at hand is to move no byte at all.
 * \param[in,out] size how many it may move */
bool
moveNothing(Call call, std::size_t& size)
{
  if (!fails(call))
    return false;
  errno = failure;
  size = std::min<std::size_t>(size, 1);
  return failure != SHORT;
}

int
openNext(const char* name, const char* path, int flags, int mode)
{
  if (fails(Call::Open)) {
    errno = failure;
    return -1;
  }
  return next<int(const char*, int, ...)>(name)(path, flags, mode);
}

} // namespace

void
begin(Call call, int wanted, std::size_t skip)
{
  which = call;
  failure = wanted;
  left = skip;
  has_failed = false;
  armed = true;
}

bool
end()
{
  armed = false;
  return has_failed;
}

} // namespace failing_calls
} // namespace pcl_flashreg

// A program's own functions go before those of the libraries, in these, too.
extern "C" {

using namespace pcl_flashreg::failing_calls;

int
open(const char* path, int flags, ...)
{
  va_list rest;
  va_start(rest, flags);
  const int mode = flags & O_CREAT ? va_arg(rest, int) : 0;
  va_end(rest);
  return openNext("open", path, flags, mode);
}

int
open64(const char* path, int flags, ...)
{
  va_list rest;
  va_start(rest, flags);
  const int mode = flags & O_CREAT ? va_arg(rest, int) : 0;
  va_end(rest);
  return openNext("open64", path, flags, mode);
}

ssize_t
read(int fd, void* bytes, std::size_t size)
{
  if (moveNothing(Call::Read, size))
    return -1;
  return next<ssize_t(int, void*, std::size_t)>("read")(fd, bytes, size);
}

ssize_t
write(int fd, const void* bytes, std::size_t size)
{
  if (moveNothing(Call::Write, size))
    return -1;
  return next<ssize_t(int, const void*, std::size_t)>("write")(fd, bytes, size);
}

ssize_t
writev(int fd, const iovec* parts, int count)
{
  std::size_t first = parts->iov_len;
  if (moveNothing(Call::Write, first))
    return -1;
  if (first < parts->iov_len)
    return next<ssize_t(int, const void*, std::size_t)>("write")(
        fd, parts->iov_base, first);
  return next<ssize_t(int, const iovec*, int)>("writev")(fd, parts, count);
}

int
fsync(int fd)
{
  if (!fails(Call::Sync))
    return next<int(int)>("fsync")(fd);
  errno = failure;
  return -1;
}

int
rename(const char* from, const char* to) noexcept
{
  if (!fails(Call::Rename))
    return next<int(const char*, const char*)>("rename")(from, to);
  errno = failure;
  return -1;
}
}
