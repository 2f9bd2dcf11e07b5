// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "harmonics/hemispheres.h"

#include "harmonics/lanes.h"

namespace vesiflow::vesicle {
namespace {

constexpr int block_rings = LongitudeTransform::block_rings;

double* reals(std::complex<double>* data) {
  return reinterpret_cast<double*>(data);
}

/// (i m)^derivative as a pair of real factors, after an exchange of real and imaginary parts if `exchange`.
struct Rotation {
  Rotation(int m, int derivative) {
    exchange = derivative == 1;
    real = derivative == 0 ? 1 : derivative == 1 ? -m : -double(m) * m;
    imaginary = derivative == 1 ? m : real;
  }
  bool exchange;
  double real, imaginary;
};

/// Real and imaginary parts exchanged if the rotation says so.
HalfSums exchanged(const HalfSums& sums, const Rotation& rotation) {
  return rotation.exchange ? HalfSums{sums.imaginary, sums.real} : sums;
}

template <bool add>
void unfold(const HalfSums& even, const HalfSums& odd, const OrderFactor& order, int column,
            LongitudeTransform& transform) {
  const Rotation factor(order.m, order.longitude_derivative);
  const HalfSums e = exchanged(even, factor), o = exchanged(odd, factor);
  const int positive = order.m % transform.longitudes();
  const int negative = positive == 0 ? 0 : transform.longitudes() - positive;
  for (int block = 0; block < transform.blocks(); ++block) {
    double* const plus = reals(transform.mode(column, block, positive));
    double* const minus = reals(transform.mode(column, block, negative));
#pragma GCC unroll 2
    for (int r = 0; r < block_rings; r += lane_count) {
      const int j = block * block_rings + r;
      const Lanes er = factor.real * load<Lanes>(e.real + j), ei = factor.imaginary * load<Lanes>(e.imaginary + j);
      const Lanes orr = factor.real * load<Lanes>(o.real + j), oi = factor.imaginary * load<Lanes>(o.imaginary + j);
      const Lanes north_real = er + orr, north_imaginary = ei + oi;
      const Lanes south_real = order.south_sign * (er - orr), south_imaginary = order.south_sign * (ei - oi);
      if (positive != negative) {
        store_complex<add>(plus + 2 * r, north_real - south_imaginary, north_imaginary + south_real);
        store_complex<add>(minus + 2 * r, north_real + south_imaginary, south_real - north_imaginary);
      } else {
        // Orders m and -m are the same real function of the nodes.
        const double both = order.m == 0 ? 1 : 2;
        store_complex<add>(plus + 2 * r, both * north_real, both * south_real);
      }
    }
  }
}

}  // namespace

void unfold_hemispheres(const HalfSums& even, const HalfSums& odd, const OrderFactor& order, bool add, int column,
                        LongitudeTransform& transform) {
  (add ? unfold<true> : unfold<false>)(even, odd, order, column, transform);
}

void fold_hemispheres(LongitudeTransform& transform, int column, const double* weight, const OrderFactor& order,
                      bool add, const HalfSums& even, const HalfSums& odd) {
  const Rotation factor(order.m, order.longitude_derivative);
  const HalfSums e = exchanged(even, factor), o = exchanged(odd, factor);
  const int positive = order.m % transform.longitudes();
  const int negative = positive == 0 ? 0 : transform.longitudes() - positive;
  for (int block = 0; block < transform.blocks(); ++block) {
    const double* const plus = reals(transform.mode(column, block, positive));
    const double* const minus = reals(transform.mode(column, block, negative));
#pragma GCC unroll 2
    for (int r = 0; r < block_rings; r += lane_count) {
      const int j = block * block_rings + r;
      const ComplexLanes p = load_complex(plus + 2 * r), q = load_complex(minus + 2 * r);
      const Lanes w = load<Lanes>(weight + j);
      const Lanes wr = factor.real * w, wi = factor.imaginary * w;
      const Lanes north_real = wr * (p.real + q.real), north_imaginary = wi * (p.imaginary - q.imaginary);
      const Lanes south_real = order.south_sign * wr * (p.imaginary + q.imaginary);
      const Lanes south_imaginary = order.south_sign * wi * (q.real - p.real);
      const auto put = [add](double* to, Lanes sum) { store(to, add ? load<Lanes>(to) + sum : sum); };
      put(e.real + j, north_real + south_real);
      put(e.imaginary + j, north_imaginary + south_imaginary);
      put(o.real + j, north_real - south_real);
      put(o.imaginary + j, north_imaginary - south_imaginary);
    }
  }
}

}  // namespace vesiflow::vesicle
