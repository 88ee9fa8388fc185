// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <new>
#include <utility>

namespace pcl_flashreg {

/** \brief An array of plain values on a cache line boundary, uninitialised, that grows and
 * never shrinks: working memory that is kept between calls. Growing loses the contents. */
template <typename T>
class AlignedBuffer {
public:
  AlignedBuffer() = default;
  AlignedBuffer(const AlignedBuffer&) = delete;
  AlignedBuffer&
  operator=(const AlignedBuffer&) = delete;
  AlignedBuffer(AlignedBuffer&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        capacity_(std::exchange(other.capacity_, 0))
  {
  }
  ~AlignedBuffer()
  {
    release();
  }

  void
  resize(std::size_t n)
  {
    if (n > capacity_) {
      release();
      data_ = static_cast<T*>(::operator new(n * sizeof(T), ALIGNMENT));
      capacity_ = n;
    }
    size_ = n;
  }

  T*
  data()
  {
    return data_;
  }
  const T*
  data() const
  {
    return data_;
  }
  std::size_t
  size() const
  {
    return size_;
  }
  T&
  operator[](std::size_t i)
  {
    return data_[i];
  }
  const T&
  operator[](std::size_t i) const
  {
    return data_[i];
  }
  T*
  begin()
  {
    return data_;
  }
  T*
  end()
  {
    return data_ + size_;
  }

private:
  static constexpr std::align_val_t ALIGNMENT{64};

  void
  release()
  {
    ::operator delete(data_, ALIGNMENT);
    data_ = nullptr;
    capacity_ = 0;
    size_ = 0;
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

} // namespace pcl_flashreg
