// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

/// A function of two parameters (u, v) by its Taylor polynomial of total order <= Order about the origin,
///   sum_{i + j <= Order} c_ij u^i v^j:
/// arithmetic with jets is exact differentiation to that order (forward-mode automatic differentiation), in extended
/// precision.
template <int Order>
class Jet {
 public:
  static_assert(Order >= 0);

  Jet(long double constant = 0) { terms_[0] = constant; }

  /// The parameters themselves.
  static Jet u() { return parameter(0); }
  static Jet v() { return parameter(1); }

  long double value() const { return terms_[0]; }

  /// Coefficient of u^i v^j; i + j <= Order.
  long double& operator()(int i, int j) { return terms_[position(i + j, j)]; }
  long double operator()(int i, int j) const { return terms_[position(i + j, j)]; }

  /// The same function to a lower order.
  template <int Lower>
  Jet<Lower> truncated() const {
    static_assert(Lower <= Order);
    Jet<Lower> result;
    for (int d = 0; d <= Lower; ++d)
      for (int j = 0; j <= d; ++j) result(d - j, j) = (*this)(d - j, j);
    return result;
  }

  Jet<Order - 1> du() const {
    Jet<Order - 1> result;
    for (int d = 0; d < Order; ++d)
      for (int j = 0; j <= d; ++j) result(d - j, j) = (d - j + 1) * (*this)(d - j + 1, j);
    return result;
  }

  Jet<Order - 1> dv() const {
    Jet<Order - 1> result;
    for (int d = 0; d < Order; ++d)
      for (int j = 0; j <= d; ++j) result(d - j, j) = (j + 1) * (*this)(d - j, j + 1);
    return result;
  }

  /// sum_k taylor[k] (f - f(0))^k: the outer function by its Taylor coefficients at value().
  Jet composed(const std::array<long double, Order + 1>& taylor) const {
    Jet step = *this;
    step.terms_[0] = 0;
    Jet result = taylor[Order];
    for (int k = Order - 1; k >= 0; --k) result = result * step + Jet(taylor[k]);
    return result;
  }

  Jet& operator+=(const Jet& other) {
    for (int k = 0; k < size; ++k) terms_[k] += other.terms_[k];
    return *this;
  }
  Jet& operator-=(const Jet& other) {
    for (int k = 0; k < size; ++k) terms_[k] -= other.terms_[k];
    return *this;
  }
  Jet& operator*=(long double factor) {
    for (long double& term : terms_) term *= factor;
    return *this;
  }

  friend Jet operator+(Jet a, const Jet& b) { return a += b; }
  friend Jet operator-(Jet a, const Jet& b) { return a -= b; }
  friend Jet operator-(Jet a) { return a *= -1; }
  friend Jet operator*(long double factor, Jet a) { return a *= factor; }

  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet result;
    for (int d = 0; d <= Order; ++d)
      for (int j = 0; j <= d; ++j)
        for (int e = 0; e <= Order - d; ++e)
          for (int k = 0; k <= e; ++k)
            result.terms_[position(d + e, j + k)] += a.terms_[position(d, j)] * b.terms_[position(e, k)];
    return result;
  }

  friend Jet operator/(const Jet& a, const Jet& b) {
    std::array<long double, Order + 1> taylor;  // of 1 / x
    taylor[0] = 1 / b.value();
    for (int k = 1; k <= Order; ++k) taylor[k] = -taylor[k - 1] * taylor[0];
    return a * b.composed(taylor);
  }

  friend Jet sqrt(const Jet& a) {
    std::array<long double, Order + 1> taylor;
    taylor[0] = std::sqrt(a.value());
    for (int k = 1; k <= Order; ++k) taylor[k] = taylor[k - 1] * (1.5L - k) / (k * a.value());
    return a.composed(taylor);
  }

  friend Jet exp(const Jet& a) {
    std::array<long double, Order + 1> taylor;
    taylor[0] = std::exp(a.value());
    for (int k = 1; k <= Order; ++k) taylor[k] = taylor[k - 1] / k;
    return a.composed(taylor);
  }

 private:
  static constexpr int size = (Order + 1) * (Order + 2) / 2;

  // By total order, so that a lower order is a prefix.
  static constexpr int position(int total, int j) { return total * (total + 1) / 2 + j; }

  static Jet parameter(int which) {
    Jet result;
    if constexpr (Order > 0) result(1 - which, which) = 1;
    return result;
  }

  std::array<long double, size> terms_{};
};
