// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/coefficients.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "check.h"
#include "vesicle/scale_degrees.h"

namespace vesiflow::vesicle {
namespace {

/// Calls visit(n, m, index), index of the first field, in the order of the storage.
template <class Visit>
void for_each_row(const Coefficients& c, const Visit& visit) {
  std::ptrdiff_t index = 0;
  for (int m = 0; m < c.degrees(); ++m)
    for (int parity : {0, 1})
      for (int n = m + parity; n < c.degrees(); n += 2, index += c.fields()) visit(n, m, index);
}

/// Orders m and -m.
double multiplicity(int m) {
  return m == 0 ? 1 : 2;
}

}  // namespace

int two_thirds_degrees(int latitudes) {
  return (2 * latitudes + 2) / 3;
}

void Coefficients::resize(int degrees, int fields) {
  check_argument(degrees >= 1, "degrees", degrees, ">= 1");
  check_argument(fields >= 1, "fields", fields, ">= 1");
  degrees_ = degrees;
  fields_ = fields;
  data_.resize(std::size_t(degrees) * (degrees + 1) / 2 * fields);
}

void Coefficients::set_zero() {
  std::fill(data_.begin(), data_.end(), Complex{});
}

void Coefficients::resample(const Coefficients& from, int degrees) {
  check_argument(&from != this, "from", "this", "another object");
  resize(degrees, from.fields());
  for (int m = 0; m < degrees; ++m)
    for (int parity : {0, 1}) {
      const int rows = (degrees - m - parity + 1) / 2;
      const int given = std::clamp((from.degrees() - m - parity + 1) / 2, 0, rows);
      Complex* const to = block(m, parity);
      if (given > 0) std::copy_n(from.block(m, parity), std::ptrdiff_t(given) * fields_, to);
      std::fill(to + std::ptrdiff_t(given) * fields_, to + std::ptrdiff_t(rows) * fields_, Complex{});
    }
}

void Coefficients::truncate(int k) {
  for_each_row(*this, [&](int n, int, std::ptrdiff_t index) {
    if (n >= k) std::fill_n(data_.begin() + index, fields_, Complex{});
  });
}

void Coefficients::filter_exponentially(double strength, double order) {
  check_argument(std::isfinite(strength) && strength >= 0, "strength", strength, "finite and >= 0");
  check_argument(order > 0, "order", order, "> 0");
  const double highest = std::max(1, degrees_ - 1);
  scale_degrees(*this, [&](int n) { return std::exp(-strength * std::pow(n / highest, order)); });
}

double Coefficients::dot(const Coefficients& other) const {
  check_argument(other.degrees_ == degrees_, "degrees", other.degrees_, "equal in a product");
  check_argument(other.fields_ == fields_, "fields", other.fields_, "equal in a product");
  double sum = 0;
  for_each_row(*this, [&](int, int m, std::ptrdiff_t index) {
    for (int field = 0; field < fields_; ++field) {
      const Complex a = data_[index + field], b = other.data_[index + field];
      sum += multiplicity(m) * (a.real() * b.real() + a.imag() * b.imag());
    }
  });
  return sum;
}

double Coefficients::energy(int first, int last) const {
  double sum = 0;
  for_each_row(*this, [&](int n, int m, std::ptrdiff_t index) {
    if (n < first || n >= last) return;
    for (int field = 0; field < fields_; ++field) sum += multiplicity(m) * std::norm(data_[index + field]);
  });
  return sum;
}

void Coefficients::energy_per_degree(ScalarField& energies) const {
  energies.setZero(degrees_);
  for_each_row(*this, [&](int n, int m, std::ptrdiff_t index) {
    for (int field = 0; field < fields_; ++field) energies[n] += multiplicity(m) * std::norm(data_[index + field]);
  });
}

std::size_t Coefficients::block_offset(int m, int parity) const {
  const std::size_t order_start = std::size_t(m) * degrees_ - std::size_t(m) * (m - 1) / 2;
  const std::size_t even_rows = (degrees_ - m + 1) / 2;
  return (order_start + (parity == 0 ? 0 : even_rows)) * fields_;
}

std::size_t Coefficients::position(int field, int n, int m) const {
  assert(0 <= field && field < fields_ && 0 <= m && m <= n && n < degrees_);
  return block_offset(m, (n - m) % 2) + std::size_t((n - m) / 2) * fields_ + field;
}

}  // namespace vesiflow::vesicle
