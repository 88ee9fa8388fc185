// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/host_device.h"

#include <cmath>

namespace pcl_flashreg {

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

} // namespace pcl_flashreg
