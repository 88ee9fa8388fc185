// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/host_device.h"
#include "math/residual.h"

#include <cmath>

namespace pcl_flashreg {

/** \brief Three doubles. */
struct Vec3 {
  double x, y, z;
};

PCL_FLASHREG_HD inline Vec3
operator+(const Vec3& a, const Vec3& b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

PCL_FLASHREG_HD inline Vec3
operator-(const Vec3& a, const Vec3& b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

PCL_FLASHREG_HD inline Vec3
operator*(double s, const Vec3& a)
{
  return {s * a.x, s * a.y, s * a.z};
}

PCL_FLASHREG_HD inline double
dot(const Vec3& a, const Vec3& b)
{
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

PCL_FLASHREG_HD inline Vec3
cross(const Vec3& a, const Vec3& b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/** \brief T_target_source: target = r * source + t. */
struct Pose {
  /** \brief Rotation, row-major. */
  double r[9];
  double t[3];
};

PCL_FLASHREG_HD inline Vec3
rotate(const double r[9], const Vec3& p)
{
  return {(r[0] * p.x + r[1] * p.y) + r[2] * p.z,
          (r[3] * p.x + r[4] * p.y) + r[5] * p.z,
          (r[6] * p.x + r[7] * p.y) + r[8] * p.z};
}

PCL_FLASHREG_HD inline Vec3
transform(const Pose& T, const Vec3& p)
{
  const Vec3 q = rotate(T.r, p);
  return {q.x + T.t[0], q.y + T.t[1], q.z + T.t[2]};
}

/** \brief Sets the translation so that it takes the one point onto the other. */
PCL_FLASHREG_HD inline void
setTranslation(Pose& T, const Vec3& source, const Vec3& target)
{
  const Vec3 rotated = rotate(T.r, source);
  T.t[0] = target.x - rotated.x;
  T.t[1] = target.y - rotated.y;
  T.t[2] = target.z - rotated.z;
}

PCL_FLASHREG_HD inline PoseF
toSingle(const Pose& T)
{
  PoseF F;
  for (int i = 0; i < 9; ++i)
    F.r[i] = static_cast<float>(T.r[i]);
  for (int i = 0; i < 3; ++i)
    F.t[i] = static_cast<float>(T.t[i]);
  return F;
}

/** \brief Orthonormal frame of a triangle: x along the first edge, z the normal. */
struct TriangleFrame {
  Vec3 x, y, z;
};

/** \brief The frame of the triangle with edges a and b from one corner.
 * \return false if the corners are collinear or coincident to within 0.6 degrees, or not
 * finite
 */
PCL_FLASHREG_HD inline bool
triangleFrame(const Vec3& a, const Vec3& b, TriangleFrame& frame)
{
  constexpr double MIN_SQUARED_SINE = 1e-4;
  const Vec3 normal = cross(a, b);
  const double squared_area = dot(normal, normal);
  const double squared_a = dot(a, a);
  if (!(squared_area > MIN_SQUARED_SINE * (squared_a * dot(b, b))))
    return false;
  frame.x = (1.0 / sqrt(squared_a)) * a;
  frame.z = (1.0 / sqrt(squared_area)) * normal;
  frame.y = cross(frame.z, frame.x);
  return true;
}

/** \brief Rotation with the columns of `to` times the in-plane rotation by (c, s) times
 * the rows of `from`. */
PCL_FLASHREG_HD inline void
composeFrames(
    const TriangleFrame& from, const TriangleFrame& to, double c, double s, double r[9])
{
  const Vec3 x = c * to.x + s * to.y;
  const Vec3 y = c * to.y - s * to.x;
  const Vec3 to_columns[3] = {x, y, to.z};
  const Vec3 from_rows[3] = {from.x, from.y, from.z};
  for (int i = 0; i < 9; ++i)
    r[i] = 0;
  for (int k = 0; k < 3; ++k) {
    const double column[3] = {to_columns[k].x, to_columns[k].y, to_columns[k].z};
    for (int i = 0; i < 3; ++i) {
      r[3 * i + 0] += column[i] * from_rows[k].x;
      r[3 * i + 1] += column[i] * from_rows[k].y;
      r[3 * i + 2] += column[i] * from_rows[k].z;
    }
  }
}

/** \brief Least-squares rigid alignment of three point pairs, in closed form.
 *
 * Both triangles are planar, so the best rotation takes plane onto plane, and what is
 * left is the best rotation in the plane (2D Procrustes). Taking the normals with the
 * same sign is the optimum as long as the in-plane covariance has a positive determinant;
 * where it has not, the triangle is mirrored (all of it lies within the length
 * tolerance's noise) and flipping the normal fits better: the same formulas, with one
 * axis negated.
 * \return false if a triangle is degenerate, see triangleFrame()
 */
PCL_FLASHREG_HD inline bool
alignTriplet(const Vec3 s[3], const Vec3 t[3], Pose& T_target_source)
{
  TriangleFrame from, to;
  if (!triangleFrame(s[1] - s[0], s[2] - s[0], from) ||
      !triangleFrame(t[1] - t[0], t[2] - t[0], to))
    return false;
  const Vec3 source_mean = (1.0 / 3.0) * (s[0] + s[1] + s[2]);
  const Vec3 target_mean = (1.0 / 3.0) * (t[0] + t[1] + t[2]);

  // Covariance of the in-plane coordinates, target by source.
  double xx = 0, xy = 0, yx = 0, yy = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 p = s[i] - source_mean;
    const Vec3 q = t[i] - target_mean;
    const double px = dot(p, from.x), py = dot(p, from.y);
    const double qx = dot(q, to.x), qy = dot(q, to.y);
    xx += qx * px;
    xy += qx * py;
    yx += qy * px;
    yy += qy * py;
  }
  if (xx * yy - xy * yx < 0) {
    // Mirrored: turn the target frame over about its x axis.
    to.y = -1.0 * to.y;
    to.z = -1.0 * to.z;
    yx = -yx;
    yy = -yy;
  }
  const double cosine = xx + yy;
  const double sine = yx - xy;
  const double norm = sqrt(cosine * cosine + sine * sine);
  if (!(norm > 0))
    return false;
  composeFrames(from, to, cosine / norm, sine / norm, T_target_source.r);
  setTranslation(T_target_source, source_mean, target_mean);
  return true;
}

/** \brief Sums of a weighted alignment problem; add() takes one pair at a time. */
struct AlignmentSums {
  double weight = 0;
  Vec3 source{0, 0, 0};
  Vec3 target{0, 0, 0};
  /** \brief Sum of weight * source_a * target_b, row-major in (a, b). */
  double products[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};

  PCL_FLASHREG_HD void
  add(double w, const Vec3& s, const Vec3& t)
  {
    const Vec3 ws = w * s;
    weight += w;
    source = source + ws;
    target = target + w * t;
    products[0] += ws.x * t.x;
    products[1] += ws.x * t.y;
    products[2] += ws.x * t.z;
    products[3] += ws.y * t.x;
    products[4] += ws.y * t.y;
    products[5] += ws.y * t.z;
    products[6] += ws.z * t.x;
    products[7] += ws.z * t.y;
    products[8] += ws.z * t.z;
  }
};

/** \brief Pairs are dealt out to this many sums in turn, in ascending order; sumLanes()
 * adds those up. So every backend rounds the same way, and a warp finds work for all of
 * its lanes. */
constexpr int ALIGNMENT_LANES = 32;

/** \brief The sum of all lanes, in a fixed order, left in the first: lane i takes in lane
 * i + 16, then i + 8, and so on. */
inline const AlignmentSums&
sumLanes(AlignmentSums lanes[ALIGNMENT_LANES])
{
  for (int distance = ALIGNMENT_LANES / 2; distance > 0; distance /= 2)
    for (int i = 0; i < distance; ++i) {
      AlignmentSums& a = lanes[i];
      const AlignmentSums& b = lanes[i + distance];
      a.weight += b.weight;
      a.source = a.source + b.source;
      a.target = a.target + b.target;
      for (int k = 0; k < 9; ++k)
        a.products[k] += b.products[k];
    }
  return lanes[0];
}

/** \brief Eigenvectors of a symmetric 4x4 matrix by cyclic Jacobi rotations.
 * \param[in,out] a the matrix; its diagonal is left with the eigenvalues
 * \param[out] v eigenvectors in columns
 */
PCL_FLASHREG_HD inline void
jacobiEigen4(double a[4][4], double v[4][4])
{
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      v[i][j] = i == j ? 1.0 : 0.0;
  constexpr int MAX_SWEEPS = 12;
  for (int sweep = 0; sweep < MAX_SWEEPS; ++sweep) {
    double off_diagonal = 0, diagonal = 0;
    for (int i = 0; i < 4; ++i) {
      diagonal += a[i][i] * a[i][i];
      for (int j = i + 1; j < 4; ++j)
        off_diagonal += a[i][j] * a[i][j];
    }
    if (off_diagonal <= 1e-32 * diagonal)
      return;
    for (int p = 0; p < 3; ++p)
      for (int q = p + 1; q < 4; ++q) {
        if (a[p][q] == 0)
          continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t =
            (theta >= 0 ? 1.0 : -1.0) / (fabs(theta) + sqrt(theta * theta + 1));
        const double c = 1 / sqrt(t * t + 1);
        const double s = t * c;
        for (int k = 0; k < 4; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 4; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
        for (int k = 0; k < 4; ++k) {
          const double kp = v[k][p], kq = v[k][q];
          v[k][p] = c * kp - s * kq;
          v[k][q] = s * kp + c * kq;
        }
      }
  }
}

/** \brief Rotation of a unit quaternion (w, x, y, z). */
PCL_FLASHREG_HD inline void
quaternionToRotation(const double q[4], double r[9])
{
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  r[0] = 1 - 2 * (y * y + z * z);
  r[1] = 2 * (x * y - w * z);
  r[2] = 2 * (x * z + w * y);
  r[3] = 2 * (x * y + w * z);
  r[4] = 1 - 2 * (x * x + z * z);
  r[5] = 2 * (y * z - w * x);
  r[6] = 2 * (x * z - w * y);
  r[7] = 2 * (y * z + w * x);
  r[8] = 1 - 2 * (x * x + y * y);
}

/** \brief Weighted least-squares rigid alignment by Horn's quaternion method.
 * \return false if the sums do not determine a rotation: less than three pairs' worth of
 * spread (collinear or coincident points), or not finite
 */
PCL_FLASHREG_HD inline bool
alignWeighted(const AlignmentSums& sums, Pose& T_target_source)
{
  if (!(sums.weight > 0))
    return false;
  const Vec3 source_mean = (1.0 / sums.weight) * sums.source;
  const Vec3 target_mean = (1.0 / sums.weight) * sums.target;
  const double s[3] = {source_mean.x, source_mean.y, source_mean.z};
  const double t[3] = {sums.target.x, sums.target.y, sums.target.z};
  double m[3][3];
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      m[a][b] = sums.products[3 * a + b] - s[a] * t[b];

  double n[4][4], v[4][4];
  n[0][0] = m[0][0] + m[1][1] + m[2][2];
  n[1][1] = m[0][0] - m[1][1] - m[2][2];
  n[2][2] = m[1][1] - m[0][0] - m[2][2];
  n[3][3] = m[2][2] - m[0][0] - m[1][1];
  n[0][1] = n[1][0] = m[1][2] - m[2][1];
  n[0][2] = n[2][0] = m[2][0] - m[0][2];
  n[0][3] = n[3][0] = m[0][1] - m[1][0];
  n[1][2] = n[2][1] = m[0][1] + m[1][0];
  n[1][3] = n[3][1] = m[2][0] + m[0][2];
  n[2][3] = n[3][2] = m[1][2] + m[2][1];
  jacobiEigen4(n, v);

  int best = 0;
  for (int i = 1; i < 4; ++i)
    if (n[i][i] > n[best][best])
      best = i;
  double second = -HUGE_VAL;
  for (int i = 0; i < 4; ++i)
    if (i != best && n[i][i] > second)
      second = n[i][i];
  // A double largest eigenvalue means that a turn about some axis changes nothing.
  if (!(n[best][best] > 0) || !(n[best][best] - second > 1e-9 * n[best][best]))
    return false;
  double q[4];
  double squared_norm = 0;
  for (int i = 0; i < 4; ++i)
    squared_norm += v[i][best] * v[i][best];
  for (int i = 0; i < 4; ++i)
    q[i] = v[i][best] / sqrt(squared_norm);
  quaternionToRotation(q, T_target_source.r);
  setTranslation(T_target_source, source_mean, target_mean);
  return true;
}

} // namespace pcl_flashreg
