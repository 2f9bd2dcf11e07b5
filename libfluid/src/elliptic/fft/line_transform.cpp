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
template <class Scalar>
void combine(Scalar* low, Scalar* high, Scalar c, Scalar s) {
  for (int l = 0; l < lanes<Scalar>; l += pack<Scalar>) {
    const Pack<Scalar> sum = load_pack(low + l) + load_pack(high + l);
    const Pack<Scalar> difference = times_i(load_pack(low + l) - load_pack(high + l));
    store_pack(low + l, c * sum - s * difference);
    store_pack(high + l, s * sum + c * difference);
  }
}

}  // namespace

template <class Scalar>
LineTransform<Scalar>::LineTransform(int length, Basis basis, Direction direction)
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

template <class Scalar>
LineTransform<Scalar>::~LineTransform() = default;

template <class Scalar>
void LineTransform<Scalar>::plan_cells() {
  const int n = length_;
  const bool forward = direction_ == Direction::forward;
  fft_ = std::make_unique<Fft>(n, direction_);
  if (basis_ == Basis::fourier) {
    for (int i = 0; i < n; ++i) {
      input_[i].offset = lanes<Scalar> * i;
      output_[i].offset = fft_->row(i);
    }
    return;
  }
  for (int k = 0; k <= n / 2; ++k) {
    cosine_.push_back(static_cast<Scalar>(std::cos(0.5 * std::numbers::pi * k / n)));
    sine_.push_back(static_cast<Scalar>(std::sin(0.5 * std::numbers::pi * k / n)));
  }
  auto& space = forward ? input_ : output_;
  auto& modes = forward ? output_ : input_;
  for (int i = 0; i < n; ++i) {
    space[i].offset = lanes<Scalar> * (i % 2 == 0 ? i / 2 : n - 1 - i / 2);
    modes[i].offset = lanes<Scalar> * (basis_ == Basis::sine_cells ? n - 1 - i : i);
    output_[i].offset = fft_->row(static_cast<int>(output_[i].offset / lanes<Scalar>));
    if (basis_ == Basis::sine_cells && i % 2 == 1) space[i].sign = -1;
  }
}

template <class Scalar>
void LineTransform<Scalar>::plan_mixed_cells() {
  const int n = length_;
  fft_ = std::make_unique<Fft>(n, Direction::forward);
  for (int i = 0; i < n; ++i) {
    input_[i] = {lanes<Scalar> * (i % 2 == 0 ? i / 2 : n - 1 - i / 2), i % 2 == 0 ? Scalar(1) : Scalar(-1)};
    output_[i].offset = fft_->row(i);
    cosine_.push_back(static_cast<Scalar>(std::cos(0.25 * std::numbers::pi * (2 * i + 1) / n)));
    sine_.push_back(static_cast<Scalar>(std::sin(0.25 * std::numbers::pi * (2 * i + 1) / n)));
    wave_cosine_.push_back(static_cast<Scalar>(std::cos(std::numbers::pi * i / n)));
    wave_sine_.push_back(static_cast<Scalar>(std::sin(std::numbers::pi * i / n)));
  }
}

template <class Scalar>
void LineTransform<Scalar>::plan_points() {
  const int n = intervals_;
  for (int i = 0; i < length_; ++i) input_[i].offset = lanes<Scalar> * (i + 1);
  output_ = input_;
  switch (points_method(n)) {
    case PointsMethod::sum:
      for (int m = 0; m < 2 * n; ++m) sine_.push_back(static_cast<Scalar>(2.0 * std::sin(std::numbers::pi * m / n)));
      break;
    case PointsMethod::extend:
      fft_ = std::make_unique<Fft>(2 * n, Direction::forward);
      for (int i = 0; i < length_; ++i) output_[i].offset = fft_->row(i + 1);
      break;
    case PointsMethod::halve:
      odd_modes_ = std::make_unique<LineTransform<Scalar>>(n / 2, Basis::sine_cells, Direction::backward);
      even_modes_ = std::make_unique<LineTransform<Scalar>>(n / 2 - 1, Basis::sine_points, direction_);
      for (int i = 0; i < length_; ++i) {  // mode i + 1
        const LineTransform<Scalar>& half = i % 2 == 0 ? *odd_modes_ : *even_modes_;
        output_[i] = half.output()[i / 2];
        if (i % 2 == 0) output_[i].offset += static_cast<std::ptrdiff_t>(even_modes_->block_size());
      }
  }
}

template <class Scalar>
std::size_t LineTransform<Scalar>::block_size(Basis basis, int length) {
  std::size_t rows = length;
  if (basis == Basis::sine_points) {
    rows = 0;
    int n = length + 1;
    for (; points_method(n) == PointsMethod::halve; n /= 2) rows += n / 2;
    rows += points_method(n) == PointsMethod::extend ? 2 * n : n;
  }
  return lanes<Scalar> * rows;
}

template <class Scalar>
double LineTransform<Scalar>::pair_factor(Basis basis, int length) {
  return basis == Basis::fourier ? length : 2.0 * (basis == Basis::sine_points ? length + 1 : length);
}

template <class Scalar>
void LineTransform<Scalar>::execute(Scalar* block, Scalar* result) const {
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

template <class Scalar>
void LineTransform<Scalar>::transform_points(Scalar* block, Scalar* result) const {
  if (fft_) {
    extend_points(block);
    fft_->execute(block, result);
    return;
  }
  fold_points(block);
  if (odd_modes_) {
    odd_modes_->execute(block + lanes<Scalar> * (intervals_ / 2), result + even_modes_->block_size());
    even_modes_->execute(block, result);
  } else {
    sum_points(block, result);
  }
}

// The transform of an odd real line is -i times what is wanted: so the extension is made of i times the lines.
template <class Scalar>
void LineTransform<Scalar>::extend_points(Scalar* block) const {
  const int n = intervals_;
  for (int l = 0; l < lanes<Scalar>; l += pack<Scalar>) {
    store_pack(block + l, Pack<Scalar>{});
    store_pack(block + lanes<Scalar> * n + l, Pack<Scalar>{});
  }
  for (int j = 1; j < n; ++j) {
    for (int l = 0; l < lanes<Scalar>; l += pack<Scalar>) {
      const Pack<Scalar> x = times_i(load_pack(block + lanes<Scalar> * j + l));
      store_pack(block + lanes<Scalar> * j + l, x);
      store_pack(block + lanes<Scalar> * (2 * n - j) + l, -x);
    }
  }
}

// u_j into row j and w_j into row n - j, which is where the transform of n/2 cells wants it.
template <class Scalar>
void LineTransform<Scalar>::fold_points(Scalar* block) const {
  for (int j = 1; j <= intervals_ - j; ++j) {
    Scalar* low = block + lanes<Scalar> * j;
    Scalar* high = block + lanes<Scalar> * (intervals_ - j);
    for (int l = 0; l < lanes<Scalar>; l += pack<Scalar>) {
      const Pack<Scalar> sum = load_pack(low + l) + load_pack(high + l);
      store_pack(low + l, load_pack(low + l) - load_pack(high + l));
      store_pack(high + l, sum);
    }
  }
}

// The sums for four modes at a time, to have enough that are independent: those of one parity from
// first = 1, 2, 9, 10, 17, ...
template <class Scalar>
void LineTransform<Scalar>::sum_points(const Scalar* block, Scalar* result) const {
  const int n = intervals_;
  for (int first = 1; first < n; first += first % 2 == 1 ? 1 : 7) {
    const bool odd = first % 2 == 1;
    std::array<std::array<Pack<Scalar>, lanes<Scalar> / pack<Scalar>>, 4> sum{};
    std::array<int, 4> phase{};  // j k modulo 2n
    for (int j = 1; odd ? 2 * j <= n : 2 * j < n; ++j) {
      const Scalar* row = block + lanes<Scalar> * (odd ? n - j : j);
      const Scalar weight = 2 * j == n ? Scalar(0.5) : Scalar(1);
      for (int m = 0; m < 4; ++m) {
        phase[m] += first + 2 * m;
        while (phase[m] >= 2 * n) phase[m] -= 2 * n;
        const Scalar factor = weight * sine_[phase[m]];
        for (int l = 0; l < lanes<Scalar> / pack<Scalar>; ++l) sum[m][l] += factor * load_pack(row + pack<Scalar> * l);
      }
    }
    for (int m = 0; m < 4 && first + 2 * m < n; ++m) {
      for (int l = 0; l < lanes<Scalar> / pack<Scalar>; ++l)
        store_pack(result + lanes<Scalar> * (first + 2 * m) + pack<Scalar> * l, sum[m][l]);
    }
  }
}

template <class Scalar>
void LineTransform<Scalar>::prepare_cells(Scalar* block) const {
  for (int k = 1; k <= intervals_ - k; ++k) {
    Scalar* low = block + lanes<Scalar> * k;
    Scalar* high = block + lanes<Scalar> * (intervals_ - k);
    const Scalar c = cosine_[k];
    const Scalar s = sine_[k];
    for (int l = 0; l < lanes<Scalar>; l += pack<Scalar>) {
      const Pack<Scalar> y_low = load_pack(low + l);
      const Pack<Scalar> y_high = load_pack(high + l);
      const Pack<Scalar> sum = c * y_low + s * y_high;
      const Pack<Scalar> difference = times_i(s * y_low - c * y_high);
      store_pack(low + l, sum + difference);
      store_pack(high + l, sum - difference);
    }
  }
}

template <class Scalar>
void LineTransform<Scalar>::finish_cells(Scalar* block) const {
  for (int l = 0; l < lanes<Scalar>; l += pack<Scalar>) store_pack(block + l, Scalar(2) * load_pack(block + l));
  for (int k = 1; k <= intervals_ - k; ++k) {
    combine(block + fft_->row(k), block + fft_->row(intervals_ - k), cosine_[k], sine_[k]);
  }
}

template <class Scalar>
void LineTransform<Scalar>::prepare_mixed_cells(Scalar* block) const {
  for (int j = 1; j < length_; ++j) {
    const Scalar c = wave_cosine_[j];
    const Scalar s = wave_sine_[j];
    for (int at = lanes<Scalar> * j; at < lanes<Scalar> * (j + 1); at += pack<Scalar>) {
      const Pack<Scalar> v = load_pack(block + at);
      store_pack(block + at, c * v - s * times_i(v));
    }
  }
}

template <class Scalar>
void LineTransform<Scalar>::finish_mixed_cells(Scalar* block) const {
  for (int k = 0; k <= length_ - 1 - k; ++k) {
    combine(block + fft_->row(k), block + fft_->row(length_ - 1 - k), cosine_[k], sine_[k]);
  }
}

template <class Scalar>
void LineTransform<Scalar>::prepare_waves(Scalar* block) const {
  for (int k = 1; k < intervals_ - k; ++k) {
    Scalar* low = block + lanes<Scalar> * k;
    Scalar* high = block + lanes<Scalar> * (intervals_ - k);
    for (int l = 0; l < lanes<Scalar>; l += pack<Scalar>) {
      const Pack<Scalar> real = load_pack(low + l);
      const Pack<Scalar> imaginary = times_i(load_pack(high + l));
      store_pack(low + l, real + imaginary);
      store_pack(high + l, real - imaginary);
    }
  }
}

template <class Scalar>
void LineTransform<Scalar>::finish_waves(Scalar* block) const {
  for (int k = 1; k < intervals_ - k; ++k) {
    Scalar* low = block + fft_->row(k);
    Scalar* high = block + fft_->row(intervals_ - k);
    for (int l = 0; l < lanes<Scalar>; l += pack<Scalar>) {
      const Pack<Scalar> z_low = Scalar(0.5) * load_pack(low + l);
      const Pack<Scalar> z_high = Scalar(0.5) * load_pack(high + l);
      store_pack(low + l, z_low + z_high);
      store_pack(high + l, times_i(z_high - z_low));
    }
  }
}

template class LineTransform<double>;
template class LineTransform<float>;

}  // namespace vesiflow::fluid
