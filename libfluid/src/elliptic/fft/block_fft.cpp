// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// With n = p m:  Z_{pk+s} = sum_{j<m} exp(-2 pi i j k / m) [exp(-2 pi i j s / n) sum_{q<p} exp(-2 pi i q s / p) z_{j+qm}].
#include "elliptic/fft/block_fft.h"

#include <cmath>
#include <numbers>

#include "elliptic/fft/lanes.h"
#include "grid/aligned_array.h"

namespace vesiflow::fluid {
namespace {

fftw_complex* as_complex(double* block) {
  return reinterpret_cast<fftw_complex*>(block);
}

int parts_of(int n) {
  if (n >= 192 && n % 3 == 0) return 3;
  return n >= 256 && n % 2 == 0 ? 2 : 1;
}

fftw_plan make_plan(int n, int sign) {
  const AlignedArray in = allocate_aligned(static_cast<std::size_t>(lanes<double>) * n);
  const AlignedArray out = allocate_aligned(static_cast<std::size_t>(lanes<double>) * n);
  return fftw_plan_many_dft(1, &n, lanes<double> / 2, as_complex(in.get()), nullptr, lanes<double> / 2, 1,
                            as_complex(out.get()), nullptr, lanes<double> / 2, 1, sign, FFTW_ESTIMATE);
}

Vector4 multiply(const Vector4& z, double real, double imaginary) {
  return real * z + imaginary * times_i(z);
}

}  // namespace

BlockFft::BlockFft(int n, Direction direction)
    : parts_(parts_of(n)),
      length_(n / parts_),
      sign_(direction == Direction::forward ? -1.0 : 1.0),
      rows_(n),
      plan_([&] { return make_plan(length_, direction == Direction::forward ? FFTW_FORWARD : FFTW_BACKWARD); }) {
  for (int k = 0; k < n; ++k) rows_[k] = lanes<double> * (k % parts_ * length_ + k / parts_);
  for (int j = 0; j < length_; ++j) {
    for (int s = 1; s < parts_; ++s) {
      const double angle = 2.0 * std::numbers::pi * (j * s) / n;
      cosine_.push_back(std::cos(angle));
      sine_.push_back(sign_ * std::sin(angle));
    }
  }
}

void BlockFft::execute(double* block, double* result) const {
  if (parts_ == 2) split_in_two(block);
  if (parts_ == 3) split_in_three(block);
  for (int part = 0; part < parts_; ++part) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(lanes<double>) * part * length_;
    fftw_execute_dft(plan_.get(), as_complex(block + first), as_complex(result + first));
  }
}

void BlockFft::split_in_two(double* block) const {
  double* high = block + static_cast<std::ptrdiff_t>(lanes<double>) * length_;
  for (int j = 0; j < length_; ++j) {
    for (int at = lanes<double> * j; at < lanes<double> * (j + 1); at += 4) {
      const Vector4 difference = load_pack(block + at) - load_pack(high + at);
      store_pack(block + at, load_pack(block + at) + load_pack(high + at));
      store_pack(high + at, multiply(difference, cosine_[j], sine_[j]));
    }
  }
}

void BlockFft::split_in_three(double* block) const {
  double* middle = block + static_cast<std::ptrdiff_t>(lanes<double>) * length_;
  double* high = middle + static_cast<std::ptrdiff_t>(lanes<double>) * length_;
  const double root = sign_ * 0.5 * std::numbers::sqrt3;
  for (int j = 0; j < length_; ++j) {
    for (int at = lanes<double> * j; at < lanes<double> * (j + 1); at += 4) {
      const Vector4 sum = load_pack(middle + at) + load_pack(high + at);
      const Vector4 difference = root * times_i(load_pack(middle + at) - load_pack(high + at));
      const Vector4 rest = load_pack(block + at) - 0.5 * sum;
      store_pack(block + at, load_pack(block + at) + sum);
      store_pack(middle + at, multiply(rest + difference, cosine_[2 * j], sine_[2 * j]));
      store_pack(high + at, multiply(rest - difference, cosine_[2 * j + 1], sine_[2 * j + 1]));
    }
  }
}

}  // namespace vesiflow::fluid
