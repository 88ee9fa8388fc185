// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/surface.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_flashreg {

/** \brief Numbers of points of a cloud, ascending, as ranges. */
class PointRanges {
public:
  struct Range {
    std::uint32_t begin = 0, end = 0;
  };

  PointRanges() = default;

  /** \brief The first so many. */
  explicit PointRanges(std::size_t count)
  {
    add({0, static_cast<std::uint32_t>(count)});
  }

  /** \brief Behind those that are there already. */
  void
  add(const Range& range)
  {
    size_ += range.end - range.begin;
    ranges_.push_back(range);
  }

  std::size_t
  size() const
  {
    return size_;
  }

  /** \brief Calls f(number) for so many of them at most, spread evenly. */
  template <typename F>
  void
  forSome(std::size_t most, F&& f) const
  {
    const std::size_t count = std::min(most, size_);
    std::size_t range = 0, before = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t rank = k * size_ / count;
      while (rank - before >= ranges_[range].end - ranges_[range].begin) {
        before += ranges_[range].end - ranges_[range].begin;
        ++range;
      }
      f(ranges_[range].begin + (rank - before));
    }
  }

private:
  std::vector<Range> ranges_;
  std::size_t size_ = 0;
};

/** \brief Of a target that is much larger than the source (a map), the part that the source
 * can meet where a pose takes it; of any other target, all of it. Out of a whole map, few
 * points of those that stand for the rest would lie where the source is. */
class Vicinity {
public:
  /** \brief A cloud that has so many times as many points as the other was put together from
   * several views, and only a part of it matters. */
  static constexpr std::size_t MUCH_LARGER = 3;

  static bool
  isMuchLarger(std::size_t cloud, std::size_t other)
  {
    return other > 0 && cloud > MUCH_LARGER * other;
  }

  /** \param[in] source, target the target in order if it is much larger */
  void
  build(const Surface& source, const Surface& target);

  /** \param[in] middle where the origin of the source's frame is taken */
  PointRanges
  around(const Eigen::Vector3f& middle) const;

private:
  /** \brief The level of the points' keys that the cells are of, and how many there are. */
  void
  layOut(const Surface& target);

  std::size_t points_ = 0;
  /** \brief How far the source reaches from the origin of its frame, but for stray points. */
  float reach_ = 0;
  /** \brief Side of a cell; its points are one range. Empty where all points matter. */
  float side_ = 1;
  Eigen::Vector3f low_ = Eigen::Vector3f::Zero();
  Eigen::Array3i counts_ = Eigen::Array3i::Zero();
  std::vector<PointRanges::Range> cells_;
};

} // namespace pcl_flashreg
