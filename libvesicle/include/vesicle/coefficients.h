// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <vector>

#include "vesicle/export.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// The paper's 2/3 rule: the number of degrees n < 2N/3.
VESIFLOW_VESICLE_EXPORT int two_thirds_degrees(int latitudes);

/// Spherical-harmonic coefficients f_n^m of `fields` real fields, degrees 0 <= n < degrees and orders 0 <= m
/// <= n; negative orders follow from f_n^{-m} = (-1)^m conj(f_n^m). See SphericalHarmonics for the expansion.
///
/// Storage is what the Legendre transform reads: for each order, the degrees n = m, m + 2, ... and then
/// n = m + 1, m + 3, ..., each with its fields contiguous. Degrees ascend inside a block, so that a transform
/// of fewer degrees reads a prefix of it.
class VESIFLOW_VESICLE_EXPORT Coefficients {
 public:
  using Complex = std::complex<double>;  ///< the type of a coefficient

  /// No coefficients: neither degrees nor fields until resize().
  Coefficients() = default;
  /// Coefficients of that shape, with unspecified values.
  /// \throws std::invalid_argument as resize().
  Coefficients(int degrees, int fields) { resize(degrees, fields); }

  /// Sets the shape; values are unspecified afterwards. Allocates only when the storage must grow.
  /// \throws std::invalid_argument unless degrees >= 1 and fields >= 1.
  void resize(int degrees, int fields);

  int degrees() const { return degrees_; }  ///< number of degrees
  int fields() const { return fields_; }    ///< number of fields

  /// Coefficient of field, degree n, order m; 0 <= m <= n < degrees (asserted).
  Complex& operator()(int field, int n, int m) { return data_[position(field, n, m)]; }
  Complex operator()(int field, int n, int m) const { return data_[position(field, n, m)]; }  ///< the same, by value

  void set_zero();  ///< sets all coefficients to zero

  /// The fields of `from` with another number of degrees: padded with zeros or truncated. What is synthesised on
  /// another grid is the field there (p <= latitudes) or its projection. Allocates only when the storage must grow.
  /// \throws std::invalid_argument unless degrees >= 1, and if `from` is this.
  void resample(const Coefficients& from, int degrees);

  /// Sharp low-pass filter F_k: keeps the degrees n < k.
  void truncate(int k);

  /// The two-thirds rule: keeps the degrees n < 2p/3, whose products of two alias only onto what it removes.
  void truncate_to_two_thirds() { truncate(two_thirds_degrees(degrees_)); }

  /// Exponential filter: degree n times exp(-strength (n / (p - 1))^order), of which `strength` = 36 takes the highest
  /// degree p - 1 to round-off (Hou & Li, J. Comput. Phys. 226, 379 (2007)).
  /// \throws std::invalid_argument unless strength is finite and >= 0, and order > 0.
  void filter_exponentially(double strength, double order);

  /// Inner product sum_n [ Re(conj(a_n^0) b_n^0) + 2 Re sum_{m>0} conj(a_n^m) b_n^m ], over all fields: the integral of
  /// the product over the unit sphere.
  /// \throws std::invalid_argument unless the shapes are equal.
  double dot(const Coefficients& other) const;

  /// dot(*this) of the degrees first <= n < last.
  double energy(int first, int last) const;

  /// The same for each degree, shape (degrees); resizes `energies`.
  void energy_per_degree(ScalarField& energies) const;

  /// First coefficient of order m with n - m even (parity 0) or odd (parity 1); rows of `fields` values.
  Complex* block(int m, int parity) { return data_.data() + block_offset(m, parity); }
  /// The same, to read.
  const Complex* block(int m, int parity) const { return data_.data() + block_offset(m, parity); }

 private:
  std::size_t block_offset(int m, int parity) const;
  std::size_t position(int field, int n, int m) const;

  int degrees_ = 0;
  int fields_ = 0;
  std::vector<Complex> data_;
};

}  // namespace vesiflow::vesicle
