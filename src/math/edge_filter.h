// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// The edge test takes two square roots a pair. Most pairs are decided without them: with
// a and b the squared lengths, D = a - b, S = a + b, p = (sqrt a - sqrt b)^2 and
// q = (sqrt a + sqrt b)^2, one has pq = D^2 and p + q = 2 S, hence
//
//   (p - tau^2) (q - tau^2) = D^2 - 2 tau^2 S + tau^4 =: E,
//
// so that wherever q > tau^2 (any edge has sqrt q > r >= 2 tau), |sqrt a - sqrt b| < tau is
// E < 0; and sqrt q > r follows from 2 S - tau^2 > r^2 and implies 2 S > r^2. With a and b
// from norms and inner products that is 8 + 4 operations a pair and no root. It is carried
// out in single precision with a bound on everything that rounding can do to it; pairs
// inside the bound, a few in a hundred edges, are left to compatible().

namespace pcl_flashreg {

/** \brief Thresholds of the filter. */
struct EdgeFilter {
  /** \brief Whether they hold for this problem; if not, every pair takes the exact test. */
  bool use;
  /** \brief -2 tau^2 and tau^4. */
  float minus_two_tau2, tau4;
  /** \brief An edge for certain if E < sure_defect and S > sure_sum; possibly an edge if
   * E < possible_defect and S > possible_sum. */
  float sure_defect, possible_defect;
  float sure_sum, possible_sum;
};

/** \brief With u the unit roundoff and R the radius of the points, a and b carry errors of
 * at most 20 u R^2 from norms (in single precision) and products, D and S 44 and 48 u R^2.
 * E then is off by at most 900 u R^3 tau near its zero (|D| is below 8 R tau there; beyond,
 * E exceeds 48 R^2 tau^2), and the exact test's own rounding, at most 16 u R in
 * |sqrt a - sqrt b|, moves the zero by another 512 u R^3 tau. The bounds round these up.
 * \param[in] radius largest distance of a point from the origin
 */
inline EdgeFilter
edgeFilter(double radius, float length_tolerance, float min_length_sum)
{
  constexpr double UNIT_ROUNDOFF = 1.0 / (1 << 24);
  const double R = radius * (1 + 1e-6);
  const double tau = length_tolerance;
  const double r = min_length_sum;
  const double defect_margin = 2048 * UNIT_ROUNDOFF * R * R * R * tau;
  const double sum_margin = 128 * UNIT_ROUNDOFF * R * R + 1e-6 * r * r;
  EdgeFilter filter;
  filter.use = R >= 1e-6 && R <= 1e6 && tau <= R && tau >= 1e-6 * R && r >= 2 * tau &&
               r <= 4 * R;
  filter.minus_two_tau2 = static_cast<float>(-2 * tau * tau);
  filter.tau4 = static_cast<float>(tau * tau * tau * tau);
  filter.sure_defect = static_cast<float>(-defect_margin);
  filter.possible_defect = static_cast<float>(defect_margin);
  filter.sure_sum = static_cast<float>((r * r + tau * tau) / 2 + sum_margin);
  filter.possible_sum = static_cast<float>(r * r / 2 - sum_margin);
  return filter;
}

/** \brief Of an upright motion, with e the excess in height, which is the exact test's to the
 * last bit, and k the squared slope: a pair keeps its height for certain if e |e| - k a is
 * below minus this, and possibly if it is below this. Near the zero of e^2 - k a both terms
 * are at most 4 k R^2; a carries 20 u R^2 here and 16 u R^2 in the exact test, and the
 * products round by 12 k u R^2. Where e is negative, k a below 20 k u R^2 in the other
 * direction is all that speaks against the pair. The constant is far above where
 * products of tiny numbers lose their precision. Holds where EdgeFilter::use does. */
inline float
heightMargin(double radius, float squared_slope)
{
  constexpr double UNIT_ROUNDOFF = 1.0 / (1 << 24);
  const double R = radius * (1 + 1e-6);
  return static_cast<float>(128 * UNIT_ROUNDOFF * squared_slope * R * R + 1e-37);
}

} // namespace pcl_flashreg
