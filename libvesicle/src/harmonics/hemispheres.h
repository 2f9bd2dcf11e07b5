// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

#include "harmonics/longitude_transform.h"

namespace vesiflow::vesicle {

/// Sums over degrees of one parity of n - m for one order and field: real and imaginary parts at the northern
/// latitudes, each padded to whole blocks of rings.
struct HalfSums {
  double* real;
  double* imaginary;
};

/// How an order m appears in the modes of a ring pair: the derivative (i m)^d of its exponential in longitude, and
/// whether sums of even n - m are equal (+1, values and second derivatives) or opposite (-1, first derivatives in
/// theta) at mirrored latitudes.
struct OrderFactor {
  int m;
  int longitude_derivative;
  double south_sign;
};

/// Puts orders m and -m of a field into the modes that they equal at the longitudes; adds if several orders share
/// these modes and this is not the first of them.
void unfold_hemispheres(const HalfSums& even, const HalfSums& odd, const OrderFactor& order, bool add, int column,
                        LongitudeTransform& transform);

/// The adjoint of unfolding: even(j) and odd(j) from the mode m of ring j and its mirror image, times weight(j).
/// The weights are half of what a value at latitude j counts for, and a quarter on the equator, which is its own
/// mirror image. Adds to what is there if asked to.
void fold_hemispheres(LongitudeTransform& transform, int column, const double* weight, const OrderFactor& order,
                      bool add, const HalfSums& even, const HalfSums& odd);

}  // namespace vesiflow::vesicle
