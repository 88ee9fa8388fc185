// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/whole_file.h"

#include <sys/mman.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace pcl_flashreg {

/** \brief The bytes of a file where the system keeps them: read when they are looked at. Whoever
 * replaces the file by another one leaves this one alone; who writes into it does not. */
class MappedFile {
public:
  /** \throws std::system_error if it can't be opened, or is no plain file */
  explicit MappedFile(const std::string& path)
  {
    const OpenFile file(path, O_RDONLY);
    size_ = file.plainSize();
    if (size_ == 0)
      return;
    bytes_ = ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, file.descriptor(), 0);
    if (bytes_ == MAP_FAILED)
      throwSystemError();
  }
  ~MappedFile()
  {
    if (size_ > 0)
      ::munmap(bytes_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile&
  operator=(const MappedFile&) = delete;

  std::string_view
  bytes() const
  {
    return {static_cast<const char*>(bytes_), size_};
  }

private:
  void* bytes_ = nullptr;
  std::size_t size_ = 0;
};

} // namespace pcl_flashreg
