#include "hemispheres.h"

#include <utility>

#include "lanes.h"

namespace vesiflow::vesicle {
namespace {

constexpr int block_rings = LongitudeTransform::block_rings;

/// Four complex numbers.
struct ComplexLanes {
  Lanes real, imaginary;
};

ComplexLanes load_complex(const std::complex<double>* from) {
  const Lanes a = load<Lanes>(reinterpret_cast<const double*>(from));
  const Lanes b = load<Lanes>(reinterpret_cast<const double*>(from) + lane_count);
  return {__builtin_shufflevector(a, b, 0, 2, 4, 6), __builtin_shufflevector(a, b, 1, 3, 5, 7)};
}

void store_complex(std::complex<double>* to, Lanes real, Lanes imaginary, bool add) {
  double* const out = reinterpret_cast<double*>(to);
  Lanes a = __builtin_shufflevector(real, imaginary, 0, 4, 1, 5);
  Lanes b = __builtin_shufflevector(real, imaginary, 2, 6, 3, 7);
  if (add) {
    a += load<Lanes>(out);
    b += load<Lanes>(out + lane_count);
  }
  store(out, a);
  store(out + lane_count, b);
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

}  // namespace

void unfold_hemispheres(const HalfSums& even, const HalfSums& odd, const OrderFactor& order, bool add, int column,
                        LongitudeTransform& transform) {
  const Rotation factor(order.m, order.longitude_derivative);
  HalfSums e = even, o = odd;
  if (factor.exchange) {
    std::swap(e.real, e.imaginary);
    std::swap(o.real, o.imaginary);
  }
  const int positive = order.m % transform.longitudes();
  const int negative = positive == 0 ? 0 : transform.longitudes() - positive;
  for (int block = 0; block < transform.blocks(); ++block) {
    std::complex<double>* const plus = transform.mode(column, block, positive);
    std::complex<double>* const minus = transform.mode(column, block, negative);
#pragma GCC unroll 2
    for (int r = 0; r < block_rings; r += lane_count) {
      const int j = block * block_rings + r;
      const Lanes er = factor.real * load<Lanes>(e.real + j), ei = factor.imaginary * load<Lanes>(e.imaginary + j);
      const Lanes orr = factor.real * load<Lanes>(o.real + j), oi = factor.imaginary * load<Lanes>(o.imaginary + j);
      const Lanes north_real = er + orr, north_imaginary = ei + oi;
      const Lanes south_real = order.south_sign * (er - orr), south_imaginary = order.south_sign * (ei - oi);
      if (positive != negative) {
        store_complex(plus + r, north_real - south_imaginary, north_imaginary + south_real, add);
        store_complex(minus + r, north_real + south_imaginary, south_real - north_imaginary, add);
      } else {
        // Orders m and -m are the same real function of the nodes.
        const double both = order.m == 0 ? 1 : 2;
        store_complex(plus + r, both * north_real, both * south_real, add);
      }
    }
  }
}

void fold_hemispheres(LongitudeTransform& transform, int column, const double* weight, const OrderFactor& order,
                      bool add, const HalfSums& even, const HalfSums& odd) {
  const Rotation factor(order.m, order.longitude_derivative);
  HalfSums e = even, o = odd;
  if (factor.exchange) {
    std::swap(e.real, e.imaginary);
    std::swap(o.real, o.imaginary);
  }
  const int positive = order.m % transform.longitudes();
  const int negative = positive == 0 ? 0 : transform.longitudes() - positive;
  for (int block = 0; block < transform.blocks(); ++block) {
    const std::complex<double>* const plus = transform.mode(column, block, positive);
    const std::complex<double>* const minus = transform.mode(column, block, negative);
#pragma GCC unroll 2
    for (int r = 0; r < block_rings; r += lane_count) {
      const int j = block * block_rings + r;
      const ComplexLanes p = load_complex(plus + r), q = load_complex(minus + r);
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
