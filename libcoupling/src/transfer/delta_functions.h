// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "coupling/delta_kernel.h"

/// The functions phi of one variable of which delta functions are made. Each has a `width`, the weights(t) of delta_weights() in
/// coupling/delta_kernel.h, from which the value at a single distance follows, and a `second_moment`, int r^2 phi(r) dr to six
/// digits: the mean of sum_j w_j r_j^2 over t.
namespace vesiflow::coupling {

// The 3-point function in terms of the middle point's distance c = t - 1/2.
struct ThreePointFunction {
  static constexpr int width = 3;
  static constexpr double second_moment = 0.298467;
  static std::array<double, 3> weights(double t) {
    const double c = t - 0.5, root = std::sqrt(1.0 - 3.0 * c * c);
    return {(2.0 - 3.0 * c - root) / 6.0, (1.0 + root) / 3.0, (2.0 + 3.0 * c - root) / 6.0};
  }
};

struct FourPointFunction {
  static constexpr int width = 4;
  static constexpr double second_moment = 0.523968;
  static std::array<double, 4> weights(double t) {
    const double root = std::sqrt(1.0 + 4.0 * t * (1.0 - t)), near = 3.0 - 2.0 * t, far = 1.0 + 2.0 * t;
    return {0.125 * (near - root), 0.125 * (near + root), 0.125 * (far + root), 0.125 * (far - root)};
  }
};

// The 3-point function averaged over one cell, in the closed form of Yang et al.
struct SmoothedFourPointFunction {
  static constexpr int width = 4;
  static constexpr double second_moment = 0.3818;
  static std::array<double, 4> weights(double t) {
    const double s = std::sqrt(1.0 + 12.0 * t * (1.0 - t));
    const double a = angle(t, s);
    return {outer(t, s, a), inner(t, s, a), inner(1.0 - t, s, -a), outer(1.0 - t, s, -a)};
  }

 private:
  static constexpr double root3 = std::numbers::sqrt3;
  static constexpr double inner_constant = 17.0 / 48.0 + root3 * std::numbers::pi / 108.0;
  static constexpr double outer_constant = 55.0 / 48.0 - root3 * std::numbers::pi / 108.0;
  // asin(x) of x = sqrt(3) (2 t - 1)/2, whose cosine is s/2: twice the arctangent of z = x/(1 + s/2), |z| <= 1/sqrt(3).
  // atan(z)/z is the polynomial in z^2 through 14 Chebyshev points of [0, 1/3], off by less than 1e-17, in two halves that are
  // summed side by side. Without calls and branches the weights of several axes are computed at once; std::asin stops that.
  static double angle(double t, double s) {
    constexpr std::array<double, 14> c{
        1.0,
        -0.3333333333333244,
        0.1999999999982505,
        -0.14285714272179476,
        0.11111110562698595,
        -0.09090895721549652,
        0.07692095364080975,
        -0.06664360549121498,
        0.058647108127846334,
        -0.05166535740527689,
        0.043807658502577104,
        -0.03267092797129498,
        0.018105276817683272,
        -0.005285678082762665,
    };
    const double z = root3 * (2.0 * t - 1.0) / (2.0 + s), z2 = z * z, z4 = z2 * z2;
    double even = c[12], odd = c[13];
    for (std::size_t k = 12; k > 0; k -= 2) {
      even = even * z4 + c[k - 2];
      odd = odd * z4 + c[k - 1];
    }
    return 2.0 * z * (even + z2 * odd);
  }
  // The value at |r| = t in [0, 1].
  static double inner(double t, double s, double a) {
    return inner_constant + 0.25 * t * (1.0 - t) + (1.0 - 2.0 * t) / 16.0 * s - root3 / 12.0 * a;
  }
  // The value at |r| = 1 + t.
  static double outer(double t, double s, double a) {
    const double r = 1.0 + t;
    return outer_constant - 13.0 / 12.0 * r + 0.25 * r * r + (2.0 * t - 1.0) / 48.0 * s + root3 / 36.0 * a;
  }
};

// Five linear conditions on the six weights (even and odd points sum to 1/2 each, first moment 0, second K, third 0)
// leave p + q n, with n = (1, -3, 2, 2, -3, 1) in the nullspace. With p orthogonal to n the sixth condition, a constant sum of
// squares C, is |p|^2 + 28 q^2 = C. C follows from the marker on a point, where the outermost weight is zero. K
// is the one that joins the pieces with three continuous derivatives. All in s = t - 1/2, in which p_j(-s) = p_{5-j}(s).
struct SixPointFunction {
  static constexpr int width = 6;
  static constexpr double second_moment = 59.0 / 60.0 - 5.3851648071345040 / 20.0;  // the root is that of 29
  static std::array<double, 6> weights(double t) {
    constexpr double K = second_moment;
    const double s = t - 0.5, s2 = s * s;
    const double even0 = (-3.0 / 32.0 + 5.0 / 56.0 * K) + 5.0 / 56.0 * s2;
    const double even1 = (7.0 / 32.0 - K / 56.0) - s2 / 56.0;
    const double even2 = (3.0 / 8.0 - K / 14.0) - s2 / 14.0;
    const double odd0 = s * ((7.0 / 96.0 - K / 8.0) - s2 / 24.0);
    const double odd1 = s * ((-31.0 / 96.0 + K / 8.0) + s2 / 24.0);
    const double odd2 = s * ((-19.0 / 48.0 + K / 4.0) + s2 / 12.0);
    const double q = std::sqrt(square0 + s2 * (square1 + s2 * (square2 - s2 / 1344.0)));
    return {even0 + odd0 + q,       even1 + odd1 - 3.0 * q, even2 + odd2 + 2.0 * q,
            even2 - odd2 + 2.0 * q, even1 - odd1 - 3.0 * q, even0 - odd0 + q};
  }

 private:
  // Sum of squares C: phi(0) = 1/2 - 2 phi(2), phi(1) = 1/4, phi(2) = (K - 1/2)/8, phi(3) = 0.
  static constexpr double at_two = (second_moment - 0.5) / 8.0, at_zero = 0.5 - 2.0 * at_two;
  static constexpr double sum_of_squares = at_zero * at_zero + 0.125 + 2.0 * at_two * at_two;
  // q^2 = (C - |p|^2)/28 in powers of s^2.
  static constexpr double square0 =
      (sum_of_squares - (101.0 / 256.0 + second_moment * (-5.0 / 32.0 + second_moment * 3.0 / 112.0))) / 28.0;
  static constexpr double square1 =
      -(289.0 / 768.0 + second_moment * (-121.0 / 224.0 + second_moment * 3.0 / 16.0)) / 28.0;
  static constexpr double square2 = (115.0 / 672.0 - second_moment / 8.0) / 28.0;
};

// The cardinal B-spline of an order: the indicator of a cell convolved with itself order - 1 times, by the recursion of
// Cox and de Boor.
template <int order>
struct BSplineFunction {
  static constexpr int width = order;
  static constexpr double second_moment = order / 12.0;  // 1/12 of each cell
  static std::array<double, order> weights(double t) {
    std::array<double, order> w{1.0};
    for (int m = 1; m < order; ++m) {
      const double scale = 1.0 / m;
      w[m] = scale * t * w[m - 1];
      for (int j = m - 1; j > 0; --j) w[j] = scale * ((t + (m - j)) * w[j - 1] + ((1.0 - t) + j) * w[j]);
      w[0] *= scale * (1.0 - t);
    }
    return w;
  }
};

/// phi at one signed distance.
template <class Function>
double value_of(double r) {
  const double x = r - 0.5 * Function::width + 1.0, below = std::floor(x);
  if (!(below > -Function::width && below <= 0.0)) return 0.0;
  return Function::weights(x - below)[static_cast<std::size_t>(-below)];
}

template <class NormalFunction, class TangentialFunction = NormalFunction>
struct KernelFunctions {
  using Normal = NormalFunction;
  using Tangential = TangentialFunction;
};

/// Calls visitor(KernelFunctions<...>{}) with the functions of a kernel: the one place that lists them.
template <class Visitor>
auto with_functions_of(DeltaKernel kernel, const Visitor& visitor) {
  switch (kernel) {
    case DeltaKernel::three_point:
      return visitor(KernelFunctions<ThreePointFunction>{});
    case DeltaKernel::four_point:
      return visitor(KernelFunctions<FourPointFunction>{});
    case DeltaKernel::smoothed_four_point:
      return visitor(KernelFunctions<SmoothedFourPointFunction>{});
    case DeltaKernel::six_point:
      return visitor(KernelFunctions<SixPointFunction>{});
    case DeltaKernel::composite_bspline_32:
      return visitor(KernelFunctions<BSplineFunction<3>, BSplineFunction<2>>{});
    case DeltaKernel::composite_bspline_43:
      return visitor(KernelFunctions<BSplineFunction<4>, BSplineFunction<3>>{});
    case DeltaKernel::composite_bspline_54:
      return visitor(KernelFunctions<BSplineFunction<5>, BSplineFunction<4>>{});
  }
  throw std::invalid_argument("delta kernel: not one of the enumeration");
}

/// The same with one of the two functions.
template <class Visitor>
auto with_function_of(DeltaKernel kernel, Direction direction, const Visitor& visitor) {
  return with_functions_of(kernel, [&](auto functions) {
    using Functions = decltype(functions);
    return direction == Direction::normal ? visitor(typename Functions::Normal{})
                                          : visitor(typename Functions::Tangential{});
  });
}

}  // namespace vesiflow::coupling
