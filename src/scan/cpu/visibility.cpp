// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan/cpu/visibility.h"

#include "math/cube_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_flashreg {
namespace cpu {
namespace {

constexpr std::uint32_t NOBODY = 0xFFFFFFFF;

/** \brief The nearest point in each pixel of a cube around a place. Pixels may be as small as
 * they like: only those that are hit take memory. */
class RangeImage {
public:
  RangeImage(std::size_t points, float pixels_an_edge)
      : edge_(std::clamp(pixels_an_edge, 4.0f, 1e6f))
  {
    std::size_t slots = 16;
    while (slots < 2 * points)
      slots *= 2;
    slots_.assign(slots, Slot{});
  }

  std::uint64_t
  pixelOf(const Eigen::Vector3f& ray) const
  {
    const CubePlace place = cubePlaceOf(ray);
    const auto number = [&](float share) {
      return static_cast<std::uint64_t>(share * edge_);
    };
    return (static_cast<std::uint64_t>(place.face) << 48) + (number(place.row) << 24) +
           number(place.column);
  }

  void
  add(std::uint64_t pixel, std::uint32_t point, float range)
  {
    Slot& slot = slots_[slotOf(pixel)];
    if (slot.point != NOBODY && !(range < slot.range))
      return;
    slot = {pixel, point, range};
  }

  /** \brief NOBODY, if nothing was seen there. */
  std::uint32_t
  nearest(std::uint64_t pixel) const
  {
    return slots_[slotOf(pixel)].point;
  }

private:
  struct Slot {
    std::uint64_t pixel = 0;
    std::uint32_t point = NOBODY;
    float range = 0;
  };

  /** \brief Where the pixel is, or would be put. */
  std::size_t
  slotOf(std::uint64_t pixel) const
  {
    constexpr std::uint64_t GOLDEN = 0x9E3779B97F4A7C15ULL;
    std::size_t at = static_cast<std::size_t>((pixel * GOLDEN) >> 32);
    for (;; ++at) {
      at &= slots_.size() - 1;
      if (slots_[at].point == NOBODY || slots_[at].pixel == pixel)
        return at;
    }
  }

  float edge_;
  std::vector<Slot> slots_;
};

/** \brief Whether the surface at one point keeps another, farther one from being seen. */
bool
hides(const SurfaceElement& front,
      const Eigen::Vector3f& behind,
      const Eigen::Vector3f& place,
      float spacing)
{
  constexpr float MARGIN = 2, BESIDE = 2;
  const Eigen::Vector3f ray = front.point - place, offset = behind - front.point;
  const float range = ray.norm();
  if (!(range > 0) || !(offset.dot(ray) > MARGIN * spacing * range))
    return false;
  const float aside = (offset - (offset.dot(ray) / (range * range)) * ray).norm();
  if (aside > BESIDE * spacing)
    return false;
  // Floors seen at a small angle lie one behind the other and hide nothing: what counts is
  // the distance from the plane.
  const float depth = front.normal.dot(offset);
  return (front.normal.dot(ray) > 0 ? depth : -depth) > MARGIN * spacing;
}

} // namespace

Visibility::Visibility(std::vector<SurfaceElement> elements,
                       std::size_t surface_size,
                       float spacing)
    : elements_(std::move(elements)), surface_size_(surface_size), spacing_(spacing)
{
  if (elements_.empty())
    return;
  for (const SurfaceElement& element : elements_)
    middle_ += element.point / static_cast<float>(elements_.size());
  std::vector<float> distances;
  distances.reserve(elements_.size());
  for (const SurfaceElement& element : elements_)
    distances.push_back((element.point - middle_).norm());
  const auto median =
      distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), median, distances.end());
  extent_ = std::max(*median, spacing);
}

double
Visibility::hiddenShare(const Eigen::Vector3f& place, std::size_t count) const
{
  count = std::min(count, elements_.size());
  if (count == 0)
    return 0;
  // What is left of a surface when points are taken away has larger gaps.
  const float spacing = spacing_ * std::sqrt(static_cast<float>(surface_size_) /
                                             static_cast<float>(count));
  float mean_range = 0;
  for (std::size_t i = 0; i < count; ++i)
    mean_range += (elements_[i].point - place).norm() / static_cast<float>(count);
  // A face of the cube is two units wide at a distance of one.
  constexpr float PIXEL = 1.5f;
  RangeImage image(count, 2 * mean_range / (PIXEL * spacing));
  std::vector<std::uint64_t> pixels(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f ray = elements_[i].point - place;
    pixels[i] = image.pixelOf(ray);
    if (elements_[i].solid)
      image.add(pixels[i], static_cast<std::uint32_t>(i), ray.squaredNorm());
  }
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t front = image.nearest(pixels[i]);
    if (front != NOBODY && front != i &&
        hides(elements_[front], elements_[i].point, place, spacing))
      ++hidden;
  }
  return static_cast<double>(hidden) / static_cast<double>(count);
}

double
Visibility::thinning(const Eigen::Vector3f& place, std::size_t count) const
{
  // Where the surface is seen edge-on, its normal is not exact enough to say how much.
  constexpr float LEAST_COSINE = 0.1f;
  count = std::min(count, elements_.size());
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceElement& element = elements_[i];
    const Eigen::Vector3f ray = element.point - place;
    const float squared = std::max(ray.squaredNorm(), spacing_ * spacing_);
    const float cosine = std::abs(element.normal.dot(ray)) / std::sqrt(squared);
    const double rays = std::log(std::max(cosine, LEAST_COSINE) / squared);
    const double points = element.log_count;
    x += rays;
    y += points;
    xx += rays * rays;
    yy += points * points;
    xy += rays * points;
  }
  const double n = std::max<double>(1, static_cast<double>(count));
  const double spread = (xx - x * x / n) * (yy - y * y / n);
  return spread > 1e-12 * n * n ? (xy - x * y / n) / std::sqrt(spread) : 0;
}

double
Visibility::implausibility(const Eigen::Vector3f& place, std::size_t count) const
{
  constexpr double THINNING = 0.5, FARNESS = 0.03, FAR = 3;
  const double distance = (place - middle_).norm() / extent_;
  return hiddenShare(place, count) - THINNING * thinning(place, count) +
         FARNESS * std::max(0.0, std::log(distance / FAR));
}

} // namespace cpu
} // namespace pcl_flashreg
