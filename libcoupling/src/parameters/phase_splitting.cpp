// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/phase_splitting.h"

#include <algorithm>

#include "coupling/validity.h"

namespace vesiflow::coupling {

// With s the acceleration of a phase over the solved one and L the viscous decay of a mode in a step over Re_s, errors are multiplied in a
// step by the roots z of
//   (3/2 + L) z^3 = 3/2 (1 - s) ((2 + b) z^2 - (1 + 2 b) z + b) + s (2 z^2 - z/2).
// At L = 0 they are within the circle of radius 1 for s < 3 (1 + b)/(1 + 3 b). At small s some L makes them grow, but for b <= 1/2:
//   b = 1:   second order, for 0.2326 < s < 1.5;
//   b = 1/3: two thirds of the error of first order, for s < 2;
//   b = 0:   for s < 3.
// Where s of the outer phase is 1, nothing is put on the grid away from bodies. A larger Re_s makes the phase of s << 1 slow to forget. Thin
// insides are quietest with s = 2.5 and b = 0 (ratio 0.05, Re = 0.05, dt = 1/48: a surface divergence of 0.1, with 1.8 and 1/3 of 0.6),
// thick ones beyond the reach of b = 1 with 1.8 and 1/3 (ratio 100, Re = 3, dt = 1/48: 0.03, with 1 and 1/3 of 0.2).
PhaseSplitting phase_splitting(double reynolds_number, double least_ratio, double greatest_ratio, bool is_slow) {
  constexpr double least_share = 0.28, greatest_share = 1.4, share_of_some_curvature = 1.8, share_of_two_times = 2.5;
  const double greatest = reynolds_number / least_ratio, least = reynolds_number / greatest_ratio;
  if (is_slow || least_ratio < validity::thin_sharp_ratio)
    return {std::max(reynolds_number, greatest / share_of_two_times), 0.0};
  if (greatest > validity::widest_contrast_of_second_order * least)
    return {greatest / share_of_some_curvature, 1.0 / 3.0};
  return {std::clamp(reynolds_number, greatest / greatest_share, least / least_share), 1.0};
}

}  // namespace vesiflow::coupling
