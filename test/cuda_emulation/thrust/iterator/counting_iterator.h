// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Stands in for Thrust's header of this name: an array of 0, 1, 2 ... that isn't there.

namespace thrust {

template <typename Number>
class counting_iterator {
public:
  explicit counting_iterator(Number first) : first_(first) {}

  Number
  operator[](Number i) const
  {
    return first_ + i;
  }

private:
  Number first_;
};

} // namespace thrust
