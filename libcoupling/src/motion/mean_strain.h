// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/membrane.h"

namespace vesiflow::coupling {

/// Mean m of the area strain s, int exp(-s) dA = A exp(-m), and how it goes with the area of vesicles that are nearly
/// spheres.
///
/// All of m that is not ln(A/A0) has been taken off the area A by projections. A shape of excess area e (over that of
/// the sphere of its volume, less 1) can give no more than e, and deviates from a sphere by f, e = 2 f^2 (root mean
/// square, in radii); the tension that holds it in a flow grows like 1/f. So the area is kept while |m| <= 4 e
/// (`largest_held`). Beyond, m = ln(A/A0) + 4 e: the membrane is elastic there, and tends to the elastic sphere, m =
/// ln(A/A0), as e does to 0. There the tension is also soft enough for its mean to be explicit, as a uniform tension
/// acts on the deviation alone.
class MeanStrain {
 public:
  /// \param excess_area e of the area that is to be kept
  explicit MeanStrain(double excess_area);

  static double of(const vesicle::Membrane& membrane);

  /// Whether projections can hold all of it.
  bool is_held(const vesicle::Membrane& membrane) const;

  /// What m lacks of ln(A/A0) and what is held beside it: to be added to s where the area is not kept. An area is
  /// never farther from A0 than some local one then.
  double missing(const vesicle::Membrane& membrane) const;

  /// What a mean strain is more than that of the area: `largest_held` of it where it is larger than can be held, and
  /// never so that a strain is smaller than that of the area.
  static double held(double mean, double of_area, double largest_held);

 private:
  double largest_held_;
};

}  // namespace vesiflow::coupling
