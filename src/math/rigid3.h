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

/** \brief A 4x4 matrix with the determinants of its upper and of its lower two rows. */
struct Matrix4 {
  double a[4][4];
  /** \brief By columns: 01, 02, 03, 12, 13, 23. */
  double upper[6], lower[6];

  PCL_FLASHREG_HD void
  computeMinors()
  {
    int k = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i + 1; j < 4; ++j, ++k) {
        upper[k] = a[0][i] * a[1][j] - a[1][i] * a[0][j];
        lower[k] = a[2][i] * a[3][j] - a[3][i] * a[2][j];
      }
  }
  PCL_FLASHREG_HD double
  determinant() const
  {
    return ((upper[0] * lower[5] - upper[1] * lower[4]) +
            (upper[2] * lower[3] + upper[3] * lower[2])) +
           (upper[5] * lower[0] - upper[4] * lower[1]);
  }
};

/** \brief The column of a symmetric matrix's adjugate with the largest diagonal entry: a
 * vector of its null space, if that has one dimension. */
PCL_FLASHREG_HD inline void
largestAdjugateColumn(const Matrix4& m, double q[4])
{
  const auto& a = m.a;
  const auto& s = m.upper;
  const auto& c = m.lower;
  const double d0 = fabs((a[1][1] * c[5] - a[1][2] * c[4]) + a[1][3] * c[3]);
  const double d1 = fabs((a[0][0] * c[5] - a[0][2] * c[2]) + a[0][3] * c[1]);
  const double d2 = fabs((a[3][0] * s[4] - a[3][1] * s[2]) + a[3][3] * s[0]);
  const double d3 = fabs((a[2][0] * s[3] - a[2][1] * s[1]) + a[2][2] * s[0]);
  if (d0 >= d1 && d0 >= d2 && d0 >= d3) {
    q[0] = (a[1][1] * c[5] - a[1][2] * c[4]) + a[1][3] * c[3];
    q[1] = (a[1][2] * c[2] - a[1][0] * c[5]) - a[1][3] * c[1];
    q[2] = (a[1][0] * c[4] - a[1][1] * c[2]) + a[1][3] * c[0];
    q[3] = (a[1][1] * c[1] - a[1][0] * c[3]) - a[1][2] * c[0];
  }
  else if (d1 >= d2 && d1 >= d3) {
    q[0] = (a[0][2] * c[4] - a[0][1] * c[5]) - a[0][3] * c[3];
    q[1] = (a[0][0] * c[5] - a[0][2] * c[2]) + a[0][3] * c[1];
    q[2] = (a[0][1] * c[2] - a[0][0] * c[4]) - a[0][3] * c[0];
    q[3] = (a[0][0] * c[3] - a[0][1] * c[1]) + a[0][2] * c[0];
  }
  else if (d2 >= d3) {
    q[0] = (a[3][1] * s[5] - a[3][2] * s[4]) + a[3][3] * s[3];
    q[1] = (a[3][2] * s[2] - a[3][0] * s[5]) - a[3][3] * s[1];
    q[2] = (a[3][0] * s[4] - a[3][1] * s[2]) + a[3][3] * s[0];
    q[3] = (a[3][1] * s[1] - a[3][0] * s[3]) - a[3][2] * s[0];
  }
  else {
    q[0] = (a[2][2] * s[4] - a[2][1] * s[5]) - a[2][3] * s[3];
    q[1] = (a[2][0] * s[5] - a[2][2] * s[2]) + a[2][3] * s[1];
    q[2] = (a[2][1] * s[2] - a[2][0] * s[4]) - a[2][3] * s[0];
    q[3] = (a[2][0] * s[3] - a[2][1] * s[1]) + a[2][2] * s[0];
  }
}

/** \brief Divides by the Euclidean norm. \return false if that is 0 or not finite */
PCL_FLASHREG_HD inline bool
normalize4(double q[4])
{
  const double squared = (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
  if (!(squared > 0) || !(squared < HUGE_VAL))
    return false;
  const double inverse = 1 / sqrt(squared);
  for (int i = 0; i < 4; ++i)
    q[i] *= inverse;
  return true;
}

/** \brief Unit eigenvector to the eigenvalue x of a symmetric matrix. */
PCL_FLASHREG_HD inline bool
eigenvector4(const Matrix4& n, double x, double q[4])
{
  Matrix4 shifted = n;
  for (int i = 0; i < 4; ++i)
    shifted.a[i][i] -= x;
  shifted.computeMinors();
  largestAdjugateColumn(shifted, q);
  return normalize4(q);
}

/** \brief Unit eigenvector to the largest eigenvalue of a symmetric 4x4 matrix with trace 0
 * whose squared entries sum to 4, so that its eigenvalues lie within sqrt(3) of 0.
 *
 * Newton's method on the characteristic polynomial x^4 - 2 x^2 + c1 x + c0, which falls
 * steadily onto the largest root from above. That leaves an eigenvector with an error of
 * first order in the root's; its Rayleigh quotient, with one of second order, gives the
 * final one. A chain of some hundred operations instead of the thousands of Jacobi's
 * method: on a device nothing else runs meanwhile.
 * \return false if the largest eigenvalue is a double one, to within a millionth
 */
PCL_FLASHREG_HD inline bool
largestEigenvector4(const Matrix4& n, double c1, double q[4])
{
  constexpr double SQRT_3 = 1.7320508075688772;
  constexpr double LEAST_SLOPE = 1e-6;
  constexpr int MOST_STEPS = 64;
  const double c0 = n.determinant();
  double x = SQRT_3, slope = 0;
  for (int i = 0; i < MOST_STEPS; ++i) {
    const double x2 = x * x;
    slope = (4 * x2 - 4) * x + c1;
    const double value = ((x2 - 2) * x + c1) * x + c0;
    if (!(slope > LEAST_SLOPE))
      return false;
    const double step = value / slope;
    if (!(step > 1e-15))
      break;
    x -= step;
  }
  if (!eigenvector4(n, x, q))
    return false;
  double quotient = 0;
  for (int i = 0; i < 4; ++i)
    quotient += q[i] * ((n.a[i][0] * q[0] + n.a[i][1] * q[1]) +
                        (n.a[i][2] * q[2] + n.a[i][3] * q[3]));
  return eigenvector4(n, quotient, q);
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
  double squared_norm = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      m[a][b] = sums.products[3 * a + b] - s[a] * t[b];
      squared_norm += m[a][b] * m[a][b];
    }
  if (!(squared_norm > 0) || !(squared_norm < HUGE_VAL))
    return false;
  const double scale = 1 / sqrt(squared_norm);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      m[a][b] *= scale;

  Matrix4 n;
  n.a[0][0] = m[0][0] + m[1][1] + m[2][2];
  n.a[1][1] = m[0][0] - m[1][1] - m[2][2];
  n.a[2][2] = m[1][1] - m[0][0] - m[2][2];
  n.a[3][3] = m[2][2] - m[0][0] - m[1][1];
  n.a[0][1] = n.a[1][0] = m[1][2] - m[2][1];
  n.a[0][2] = n.a[2][0] = m[2][0] - m[0][2];
  n.a[0][3] = n.a[3][0] = m[0][1] - m[1][0];
  n.a[1][2] = n.a[2][1] = m[0][1] + m[1][0];
  n.a[1][3] = n.a[3][1] = m[2][0] + m[0][2];
  n.a[2][3] = n.a[3][2] = m[1][2] + m[2][1];
  n.computeMinors();
  const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                             m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  double q[4];
  // A double largest eigenvalue means that a turn about some axis changes nothing.
  if (!largestEigenvector4(n, -8 * determinant, q))
    return false;
  quaternionToRotation(q, T_target_source.r);
  setTranslation(T_target_source, source_mean, target_mean);
  return true;
}

} // namespace pcl_flashreg
