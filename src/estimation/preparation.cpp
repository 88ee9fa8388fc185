// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "estimation/preparation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl_flashreg {
namespace {

/** \brief Coordinates beyond this overflow when squared in single precision; no unit of
 * length makes sense of them. */
constexpr double LARGEST_COORDINATE = 1e15;

template <typename Scalar>
bool
usable(const Scalar* xyz)
{
  // Comparisons with NaN are false.
  return std::abs(static_cast<double>(xyz[0])) <= LARGEST_COORDINATE &&
         std::abs(static_cast<double>(xyz[1])) <= LARGEST_COORDINATE &&
         std::abs(static_cast<double>(xyz[2])) <= LARGEST_COORDINATE;
}

template <typename Scalar>
Vec3
point(const Scalar* xyz, std::size_t row)
{
  return {static_cast<double>(xyz[3 * row]),
          static_cast<double>(xyz[3 * row + 1]),
          static_cast<double>(xyz[3 * row + 2])};
}

/** \brief Keeps the rows with the `limit` smallest ranks; of equal ranks the first. */
void
keepBestRanked(const float* ranks, std::size_t limit, std::vector<int>& rows)
{
  if (rows.size() <= limit)
    return;
  if (ranks) {
    const auto rank = [ranks](int row) {
      return std::isnan(ranks[row]) ? std::numeric_limits<float>::infinity()
                                    : ranks[row];
    };
    std::nth_element(rows.begin(), rows.begin() + limit, rows.end(), [&](int a, int b) {
      return rank(a) != rank(b) ? rank(a) < rank(b) : a < b;
    });
  }
  rows.resize(limit);
  std::sort(rows.begin(), rows.end());
}

template <typename Scalar>
Vec3
centroid(const Scalar* xyz, const std::vector<int>& rows)
{
  Vec3 sum{0, 0, 0};
  for (const int row : rows)
    sum = sum + point(xyz, row);
  return rows.empty() ? sum : (1.0 / static_cast<double>(rows.size())) * sum;
}

/** \brief Packs one side, padded with NaN.
 * \return the largest distance from the centre
 */
template <typename Scalar>
float
pack(const Scalar* xyz,
     const std::vector<int>& rows,
     const Vec3& centre,
     AlignedBuffer<float>& x,
     AlignedBuffer<float>& y,
     AlignedBuffer<float>& z)
{
  double squared_radius = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vec3 p = point(xyz, rows[i]) - centre;
    squared_radius = std::max(squared_radius, dot(p, p));
    x[i] = static_cast<float>(p.x);
    y[i] = static_cast<float>(p.y);
    z[i] = static_cast<float>(p.z);
  }
  for (AlignedBuffer<float>* coordinate : {&x, &y, &z})
    std::fill(coordinate->begin() + rows.size(),
              coordinate->end(),
              std::numeric_limits<float>::quiet_NaN());
  return static_cast<float>(std::sqrt(squared_radius));
}

/** \brief Chooses the rows that are used. */
template <typename Scalar>
void
chooseRows(const CorrespondenceView<Scalar>& in,
           const Parameters& parameters,
           Preparation& out)
{
  out.rows.clear();
  for (std::size_t row = 0; row < in.size; ++row)
    if (usable(in.source_xyz + 3 * row) && usable(in.target_xyz + 3 * row))
      out.rows.push_back(static_cast<int>(row));
  out.invalid = in.size - out.rows.size();
  const std::size_t valid = out.rows.size();
  keepBestRanked(
      in.ranks, static_cast<std::size_t>(parameters.max_correspondences), out.rows);
  out.dropped = valid - out.rows.size();
}

Vec3
unit(const std::array<float, 3>& direction)
{
  const Vec3 v{direction[0], direction[1], direction[2]};
  return (1 / std::sqrt(dot(v, v))) * v;
}

/** \brief Rounds once what is computed in double precision: heights may be far larger than
 * their differences. */
template <typename Scalar>
void
packRises(const CorrespondenceView<Scalar>& in,
          const Preparation& prepared,
          Problem& problem)
{
  const Upright& upright = problem.upright;
  for (std::size_t i = 0; i < problem.size; ++i) {
    const Vec3 s = point(in.source_xyz, prepared.rows[i]) - prepared.source_centre;
    const Vec3 t = point(in.target_xyz, prepared.rows[i]) - prepared.target_centre;
    problem.rise[i] =
        static_cast<float>(dot(upright.target_up, t) - dot(upright.source_up, s));
  }
  std::fill(problem.rise.begin() + problem.size,
            problem.rise.end(),
            std::numeric_limits<float>::quiet_NaN());
}

template <typename Scalar>
void
packBoth(const CorrespondenceView<Scalar>& in,
         const Preparation& prepared,
         const Parameters& parameters,
         Problem& problem)
{
  problem.upright = uprightOf(parameters);
  problem.resize(prepared.rows.size());
  problem.radius = std::max(pack(in.source_xyz,
                                 prepared.rows,
                                 prepared.source_centre,
                                 problem.sx,
                                 problem.sy,
                                 problem.sz),
                            pack(in.target_xyz,
                                 prepared.rows,
                                 prepared.target_centre,
                                 problem.tx,
                                 problem.ty,
                                 problem.tz));
  if (problem.upright.required)
    packRises(in, prepared, problem);
}

} // namespace

Upright
uprightOf(const Parameters& parameters)
{
  Upright upright;
  upright.required = parameters.motion == MotionModel::Upright;
  if (!upright.required)
    return upright;
  constexpr double RADIANS = 3.14159265358979323846 / 180;
  const double tilt = RADIANS * parameters.max_tilt;
  const double chord = 2 * std::sin(tilt / 2);
  upright.source_up = unit(parameters.source_gravity);
  upright.target_up = unit(parameters.target_gravity);
  upright.cosine = std::cos(tilt);
  upright.sine = std::sin(tilt);
  upright.squared_slope = static_cast<float>(chord * chord);
  return upright;
}

template <typename Scalar>
void
prepare(const CorrespondenceView<Scalar>& in,
        const Parameters& parameters,
        const std::optional<Vec3>& target_centre,
        Preparation& out,
        Problem& problem)
{
  chooseRows(in, parameters, out);
  out.source_centre = centroid(in.source_xyz, out.rows);
  out.target_centre =
      target_centre ? *target_centre : centroid(in.target_xyz, out.rows);
  packBoth(in, out, parameters, problem);
}

template <typename Scalar>
void
prepareLike(const Preparation& centred,
            const CorrespondenceView<Scalar>& in,
            const Parameters& parameters,
            Problem& problem)
{
  Preparation out;
  chooseRows(in, parameters, out);
  out.source_centre = centred.source_centre;
  out.target_centre = centred.target_centre;
  packBoth(in, out, parameters, problem);
}

template void
prepare(const CorrespondenceView<float>&,
        const Parameters&,
        const std::optional<Vec3>&,
        Preparation&,
        Problem&);
template void
prepare(const CorrespondenceView<double>&,
        const Parameters&,
        const std::optional<Vec3>&,
        Preparation&,
        Problem&);
template void
prepareLike(const Preparation&,
            const CorrespondenceView<double>&,
            const Parameters&,
            Problem&);

} // namespace pcl_flashreg
