// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Cells. With the even-odd order v = (x_0, x_2, x_4, .., x_5, x_3, x_1), its Fourier transform V_k and
// t = pi k / 2n, the cosine transform is (Makhoul 1980, doi:10.1109/TASSP.1980.1163351)
//   y_k = 2 Re(exp(-i t) V_k).
// Two lines as one complex line z have V_k = (Z_k + Z*_{n-k}) / 2 and (Z_k - Z*_{n-k}) / 2i. Insert: the pair of
// results, again as a complex number, is
//   y_k = cos t S - i sin t D,   y_{n-k} = sin t S + i cos t D,   S = Z_k + Z_{n-k},   D = Z_k - Z_{n-k},
// and backwards, up to the factor 2,  S = cos t y_k + sin t y_{n-k},   D = i (sin t y_k - cos t y_{n-k}).
// The sine transform is the cosine transform of (-1)^j x_j in reversed order.
//
// Cells with mixed ends: the same order with signs, v = (x_0, x_2, x_4, .., -x_5, -x_3, -x_1), is every second number of
// the continuation. With t = pi (2k+1) / 4n, and W the Fourier transform of exp(-i pi j / n) v_j,
//   y_k = sum_j 2 cos(pi (4j+1) (2k+1) / 4n) v_j = exp(-i t) W_k + exp(i t) W_{n-1-k},
// for a pair of lines as one complex line, n even or odd. That is, as above with n-1-k for n-k,
//   y_k = cos t S - i sin t D,   y_{n-1-k} = sin t S + i cos t D,   S = W_k + W_{n-1-k},   D = W_k - W_{n-1-k}.
//
// Waves. Two real lines have the real parts S_k / 2 and the imaginary parts -i D_k / 2.
//
// Points j = 1 .. n-1, between walls 0 and n. With u_j = x_j - x_{n-j} and w_j = x_j + x_{n-j}, j = 1 .. n/2,
//   y_{2k} = 2 sum_{j<n/2} u_j sin(pi j 2k / n),   y_{2k+1} = 2 sum_{j<n/2} w_j sin(pi j (2k+1) / n) + (-1)^k w_{n/2}
// (the last term if n is even: w counts x_{n/2} twice). If n is even the first is the transform of the points
// between n/2 intervals, and the second the backward one of n/2 cells. That is repeated until n is odd or small.
// Then either the sums are done as they stand, with n^2 / 2 multiplications, or the odd extension to a period of 2n points is
// transformed, twice the work of the even case. All factors are at most 2; the well-known
// transform by one FFT of period n and a running sum (Numerical Recipes, section 12.4) amplifies round-off near the
// walls, as n / j.
#include "elliptic/fft/line_transform.h"

#include <array>
#include <cmath>
#include <numbers>

#include "elliptic/fft/lanes.h"

namespace vesiflow::fluid {
namespace {

int without_factors_up_to_13(int n) {
  for (const int prime : {2, 3, 5, 7, 11, 13}) {
    while (n % prime == 0) n /= prime;
  }
  return n;
}

// How the points between n intervals are transformed. Up to 128, sums are faster than FFTs with larger prime factors.
enum class PointsMethod { sum, extend, halve };

PointsMethod points_method(int n) {
  if (n <= 16) return PointsMethod::sum;
  if (n % 2 == 0) return PointsMethod::halve;
  return n <= 128 && without_factors_up_to_13(n) > 1 ? PointsMethod::sum : PointsMethod::extend;
}

// Rows become c S - i s D and s S + i c D of their sum S and difference D.
void combine(double* low, double* high, double c, double s) {
  for (int l = 0; l < lanes; l += 4) {
    const Vector4 sum = load4(low + l) + load4(high + l);
    const Vector4 difference = times_i(load4(low + l) - load4(high + l));
    store4(low + l, c * sum - s * difference);
    store4(high + l, s * sum + c * difference);
  }
}

}  // namespace

LineTransform::LineTransform(int length, Basis basis, Direction direction)
    : length_(length),
      intervals_(basis == Basis::sine_points ? length + 1 : length),
      basis_(basis),
      direction_(direction),
      input_(length),
      output_(length) {
  if (basis == Basis::sine_points) {
    plan_points();
  } else if (basis == Basis::mixed_cells) {
    plan_mixed_cells();
  } else {
    plan_cells();
  }
}

LineTransform::~LineTransform() = default;

void LineTransform::plan_cells() {
  const int n = length_;
  const bool forward = direction_ == Direction::forward;
  fft_ = std::make_unique<BlockFft>(n, direction_);
  if (basis_ == Basis::fourier) {
    for (int i = 0; i < n; ++i) {
      input_[i].offset = lanes * i;
      output_[i].offset = fft_->row(i);
    }
    return;
  }
  for (int k = 0; k <= n / 2; ++k) {
    cosine_.push_back(std::cos(0.5 * std::numbers::pi * k / n));
    sine_.push_back(std::sin(0.5 * std::numbers::pi * k / n));
  }
  auto& space = forward ? input_ : output_;
  auto& modes = forward ? output_ : input_;
  for (int i = 0; i < n; ++i) {
    space[i].offset = lanes * (i % 2 == 0 ? i / 2 : n - 1 - i / 2);
    modes[i].offset = lanes * (basis_ == Basis::sine_cells ? n - 1 - i : i);
    output_[i].offset = fft_->row(static_cast<int>(output_[i].offset / lanes));
    if (basis_ == Basis::sine_cells && i % 2 == 1) space[i].sign = -1.0;
  }
}

void LineTransform::plan_mixed_cells() {
  const int n = length_;
  fft_ = std::make_unique<BlockFft>(n, Direction::forward);
  for (int i = 0; i < n; ++i) {
    input_[i] = {lanes * (i % 2 == 0 ? i / 2 : n - 1 - i / 2), i % 2 == 0 ? 1.0 : -1.0};
    output_[i].offset = fft_->row(i);
    cosine_.push_back(std::cos(0.25 * std::numbers::pi * (2 * i + 1) / n));
    sine_.push_back(std::sin(0.25 * std::numbers::pi * (2 * i + 1) / n));
    wave_cosine_.push_back(std::cos(std::numbers::pi * i / n));
    wave_sine_.push_back(std::sin(std::numbers::pi * i / n));
  }
}

void LineTransform::plan_points() {
  const int n = intervals_;
  for (int i = 0; i < length_; ++i) input_[i].offset = lanes * (i + 1);
  output_ = input_;
  switch (points_method(n)) {
    case PointsMethod::sum:
      for (int m = 0; m < 2 * n; ++m) sine_.push_back(2.0 * std::sin(std::numbers::pi * m / n));
      break;
    case PointsMethod::extend:
      fft_ = std::make_unique<BlockFft>(2 * n, Direction::forward);
      for (int i = 0; i < length_; ++i) output_[i].offset = fft_->row(i + 1);
      break;
    case PointsMethod::halve:
      odd_modes_ = std::make_unique<LineTransform>(n / 2, Basis::sine_cells, Direction::backward);
      even_modes_ = std::make_unique<LineTransform>(n / 2 - 1, Basis::sine_points, direction_);
      for (int i = 0; i < length_; ++i) {  // mode i + 1
        const LineTransform& half = i % 2 == 0 ? *odd_modes_ : *even_modes_;
        output_[i] = half.output()[i / 2];
        if (i % 2 == 0) output_[i].offset += static_cast<std::ptrdiff_t>(even_modes_->block_size());
      }
  }
}

std::size_t LineTransform::block_size(Basis basis, int length) {
  std::size_t rows = length;
  if (basis == Basis::sine_points) {
    rows = 0;
    int n = length + 1;
    for (; points_method(n) == PointsMethod::halve; n /= 2) rows += n / 2;
    rows += points_method(n) == PointsMethod::extend ? 2 * n : n;
  }
  return lanes * rows;
}

double LineTransform::pair_factor(Basis basis, int length) {
  return basis == Basis::fourier ? length : 2.0 * (basis == Basis::sine_points ? length + 1 : length);
}

void LineTransform::execute(double* block, double* result) const {
  const bool forward = direction_ == Direction::forward;
  switch (basis_) {
    case Basis::sine_points:
      transform_points(block, result);
      break;
    case Basis::fourier:
      if (!forward) prepare_waves(block);
      fft_->execute(block, result);
      if (forward) finish_waves(result);
      break;
    case Basis::mixed_cells:
      prepare_mixed_cells(block);
      fft_->execute(block, result);
      finish_mixed_cells(result);
      break;
    default:
      if (!forward) prepare_cells(block);
      fft_->execute(block, result);
      if (forward) finish_cells(result);
  }
}

void LineTransform::transform_points(double* block, double* result) const {
  if (fft_) {
    extend_points(block);
    fft_->execute(block, result);
    return;
  }
  fold_points(block);
  if (odd_modes_) {
    odd_modes_->execute(block + lanes * (intervals_ / 2), result + even_modes_->block_size());
    even_modes_->execute(block, result);
  } else {
    sum_points(block, result);
  }
}

// The transform of an odd real line is -i times what is wanted: so the extension is made of i times the lines.
void LineTransform::extend_points(double* block) const {
  const int n = intervals_;
  for (int l = 0; l < lanes; l += 4) {
    store4(block + l, Vector4{});
    store4(block + lanes * n + l, Vector4{});
  }
  for (int j = 1; j < n; ++j) {
    for (int l = 0; l < lanes; l += 4) {
      const Vector4 x = times_i(load4(block + lanes * j + l));
      store4(block + lanes * j + l, x);
      store4(block + lanes * (2 * n - j) + l, -x);
    }
  }
}

// u_j into row j and w_j into row n - j, which is where the transform of n/2 cells wants it.
void LineTransform::fold_points(double* block) const {
  for (int j = 1; j <= intervals_ - j; ++j) {
    double* low = block + lanes * j;
    double* high = block + lanes * (intervals_ - j);
    for (int l = 0; l < lanes; l += 4) {
      const Vector4 sum = load4(low + l) + load4(high + l);
      store4(low + l, load4(low + l) - load4(high + l));
      store4(high + l, sum);
    }
  }
}

// The sums for four modes at a time, to have enough that are independent: those of one parity from
// first = 1, 2, 9, 10, 17, ...
void LineTransform::sum_points(const double* block, double* result) const {
  const int n = intervals_;
  for (int first = 1; first < n; first += first % 2 == 1 ? 1 : 7) {
    const bool odd = first % 2 == 1;
    std::array<std::array<Vector4, lanes / 4>, 4> sum{};
    std::array<int, 4> phase{};  // j k modulo 2n
    for (int j = 1; odd ? 2 * j <= n : 2 * j < n; ++j) {
      const double* row = block + lanes * (odd ? n - j : j);
      const double weight = 2 * j == n ? 0.5 : 1.0;
      for (int m = 0; m < 4; ++m) {
        phase[m] += first + 2 * m;
        while (phase[m] >= 2 * n) phase[m] -= 2 * n;
        const double factor = weight * sine_[phase[m]];
        for (int l = 0; l < lanes / 4; ++l) sum[m][l] += factor * load4(row + 4 * l);
      }
    }
    for (int m = 0; m < 4 && first + 2 * m < n; ++m) {
      for (int l = 0; l < lanes / 4; ++l) store4(result + lanes * (first + 2 * m) + 4 * l, sum[m][l]);
    }
  }
}

void LineTransform::prepare_cells(double* block) const {
  for (int k = 1; k <= intervals_ - k; ++k) {
    double* low = block + lanes * k;
    double* high = block + lanes * (intervals_ - k);
    const double c = cosine_[k];
    const double s = sine_[k];
    for (int l = 0; l < lanes; l += 4) {
      const Vector4 y_low = load4(low + l);
      const Vector4 y_high = load4(high + l);
      const Vector4 sum = c * y_low + s * y_high;
      const Vector4 difference = times_i(s * y_low - c * y_high);
      store4(low + l, sum + difference);
      store4(high + l, sum - difference);
    }
  }
}

void LineTransform::finish_cells(double* block) const {
  for (int l = 0; l < lanes; l += 4) store4(block + l, 2.0 * load4(block + l));
  for (int k = 1; k <= intervals_ - k; ++k) {
    combine(block + fft_->row(k), block + fft_->row(intervals_ - k), cosine_[k], sine_[k]);
  }
}

void LineTransform::prepare_mixed_cells(double* block) const {
  for (int j = 1; j < length_; ++j) {
    const double c = wave_cosine_[j];
    const double s = wave_sine_[j];
    for (int at = lanes * j; at < lanes * (j + 1); at += 4) {
      const Vector4 v = load4(block + at);
      store4(block + at, c * v - s * times_i(v));
    }
  }
}

void LineTransform::finish_mixed_cells(double* block) const {
  for (int k = 0; k <= length_ - 1 - k; ++k) {
    combine(block + fft_->row(k), block + fft_->row(length_ - 1 - k), cosine_[k], sine_[k]);
  }
}

void LineTransform::prepare_waves(double* block) const {
  for (int k = 1; k < intervals_ - k; ++k) {
    double* low = block + lanes * k;
    double* high = block + lanes * (intervals_ - k);
    for (int l = 0; l < lanes; l += 4) {
      const Vector4 real = load4(low + l);
      const Vector4 imaginary = times_i(load4(high + l));
      store4(low + l, real + imaginary);
      store4(high + l, real - imaginary);
    }
  }
}

void LineTransform::finish_waves(double* block) const {
  for (int k = 1; k < intervals_ - k; ++k) {
    double* low = block + fft_->row(k);
    double* high = block + fft_->row(intervals_ - k);
    for (int l = 0; l < lanes; l += 4) {
      const Vector4 z_low = 0.5 * load4(low + l);
      const Vector4 z_high = 0.5 * load4(high + l);
      store4(low + l, z_low + z_high);
      store4(high + l, times_i(z_high - z_low));
    }
  }
}

}  // namespace vesiflow::fluid
