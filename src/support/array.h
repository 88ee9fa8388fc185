// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace pcl_flashreg {

/** \brief Values that don't change any more once they are there: in memory of its own, or in a
 * file that is mapped. */
template <typename Value>
class Array {
public:
  Array() = default;
  Array(const Array&) = delete;
  Array&
  operator=(const Array&) = delete;
  Array(Array&& other) noexcept
      : own_(std::move(other.own_)),
        keeper_(std::move(other.keeper_)),
        data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0))
  {
  }

  Array&
  operator=(Array&& other) noexcept
  {
    own_ = std::move(other.own_);
    keeper_ = std::move(other.keeper_);
    data_ = std::exchange(other.data_, nullptr);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }

  Array&
  operator=(std::vector<Value> values)
  {
    keeper_.reset();
    own_ = std::move(values);
    seal();
    return *this;
  }

  /** \brief Memory of its own to be filled, which seal() is to end: that of before. */
  std::vector<Value>&
  own()
  {
    keeper_.reset();
    return own_;
  }

  void
  seal()
  {
    data_ = own_.data();
    size_ = own_.size();
  }

  /** \param[in] keeper has the memory as long as it lives */
  void
  map(std::shared_ptr<const void> keeper, const Value* data, std::size_t size)
  {
    own_ = {};
    keeper_ = std::move(keeper);
    data_ = data;
    size_ = size;
  }

  const Value*
  data() const
  {
    return data_;
  }
  std::size_t
  size() const
  {
    return size_;
  }
  bool
  empty() const
  {
    return size_ == 0;
  }
  const Value&
  operator[](std::size_t i) const
  {
    return data_[i];
  }
  const Value&
  front() const
  {
    return data_[0];
  }
  const Value*
  begin() const
  {
    return data_;
  }
  const Value*
  end() const
  {
    return data_ + size_;
  }

  /** \brief Of memory, its own or not. */
  std::size_t
  bytes() const
  {
    return (keeper_ ? size_ : own_.capacity()) * sizeof(Value);
  }

private:
  std::vector<Value> own_;
  std::shared_ptr<const void> keeper_;
  const Value* data_ = nullptr;
  std::size_t size_ = 0;
};

} // namespace pcl_flashreg
