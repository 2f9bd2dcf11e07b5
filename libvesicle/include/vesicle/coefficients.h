#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

namespace vesiflow::vesicle {

/// Spherical-harmonic coefficients f_n^m of `fields` real fields, degrees 0 <= n < degrees and orders 0 <= m
/// <= n; negative orders follow from f_n^{-m} = (-1)^m conj(f_n^m). See SphericalHarmonics for the expansion.
///
/// Storage is what the Legendre transform reads: for each order, the degrees n = m, m + 2, ... and then
/// n = m + 1, m + 3, ..., each with its fields contiguous. Degrees ascend inside a block, so that a transform
/// of fewer degrees reads a prefix of it.
class Coefficients {
 public:
  using Complex = std::complex<double>;

  Coefficients() = default;
  Coefficients(int degrees, int fields) { resize(degrees, fields); }

  /// Sets the shape; values are unspecified afterwards. Allocates only when the storage must grow.
  /// @throws std::invalid_argument unless degrees >= 1 and fields >= 1.
  void resize(int degrees, int fields);

  int degrees() const { return degrees_; }
  int fields() const { return fields_; }

  /// Coefficient of field, degree n, order m; 0 <= m <= n < degrees (asserted).
  Complex& operator()(int field, int n, int m) { return data_[position(field, n, m)]; }
  Complex operator()(int field, int n, int m) const { return data_[position(field, n, m)]; }

  void set_zero();

  /// Sharp low-pass filter F_k: keeps the degrees n < k.
  void truncate(int k);

  /// sum over degrees first <= n < last of all fields of |f_n^0|^2 + 2 sum_{m>0} |f_n^m|^2, which is the
  /// squared L2 norm over the unit sphere of that part of the fields.
  double energy(int first, int last) const;

  /// First coefficient of order m with n - m even (parity 0) or odd (parity 1); rows of `fields` values.
  Complex* block(int m, int parity) { return data_.data() + block_offset(m, parity); }
  const Complex* block(int m, int parity) const { return data_.data() + block_offset(m, parity); }

 private:
  std::size_t block_offset(int m, int parity) const;
  std::size_t position(int field, int n, int m) const;

  int degrees_ = 0;
  int fields_ = 0;
  std::vector<Complex> data_;
};

}  // namespace vesiflow::vesicle
