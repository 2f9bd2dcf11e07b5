// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Self-sorting passes (Stockham's, in Van Loan, Computational Frameworks for the Fast Fourier Transform, 1992, section
// 1.7): with n = r m numbers in hand that stand s rows apart, w = exp(-+ 2 pi i / n), 0 <= p < m and 0 <= q < s,
//   y_{q + s (r p + k)} = w^{p k} sum_{j<r} exp(-+ 2 pi i j k / r) x_{q + s (p + m j)},
// which leaves s r rows of m numbers each. In the last pass m is one: it has no factors w, and every sum takes the places
// of its own numbers, so that input and output may be the same.
#include "elliptic/fft/single_fft.h"

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "elliptic/fft/lanes.h"

namespace vesiflow::fluid {
namespace {

constexpr std::ptrdiff_t row_size = lanes<float>;
// A row: eight complex numbers.
using Row = float __attribute__((vector_size(row_size * sizeof(float))));

Row load_row(const float* from) {
  Row v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

void store_row(float* to, const Row& v) {
  std::memcpy(to, &v, sizeof v);
}

// Real and imaginary parts exchanged.
Row swapped(const Row& v) {
  return __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14);
}

// Swapped numbers times this are the numbers times i times a factor.
Row alternating(float factor) {
  return factor * Row{-1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1};
}

// exp(sign 2 pi i j k / r) summed, for the radix of the array; `i` is alternating(sign).
void sum(std::array<Row, 2>& v, const Row&) {
  const Row a = v[0];
  v[0] = a + v[1];
  v[1] = a - v[1];
}

void sum(std::array<Row, 3>& v, const Row& i) {
  constexpr float root = 0.5F * std::numbers::sqrt3_v<float>;
  const Row both = v[1] + v[2];
  const Row turned = swapped(v[1] - v[2]) * (root * i);
  const Row rest = v[0] - 0.5F * both;
  v = {v[0] + both, rest + turned, rest - turned};
}

void sum(std::array<Row, 4>& v, const Row& i) {
  const Row even = v[0] + v[2], odd = v[0] - v[2];
  const Row both = v[1] + v[3], turned = swapped(v[1] - v[3]) * i;
  v = {even + both, odd + turned, even - both, odd - turned};
}

void sum(std::array<Row, 5>& v, const Row& i) {
  constexpr float c1 = 0.309016994374947424F, c2 = -0.809016994374947424F;  // cos of 2 pi / 5 and 4 pi / 5
  constexpr float s1 = 0.951056516295153572F, s2 = 0.587785252292473129F;   // and sin
  const Row near = v[1] + v[4], far = v[2] + v[3];
  const Row near_turned = swapped(v[1] - v[4]) * i, far_turned = swapped(v[2] - v[3]) * i;
  const Row first = v[0] + c1 * near + c2 * far, second = v[0] + c2 * near + c1 * far;
  const Row first_turned = s1 * near_turned + s2 * far_turned, second_turned = s2 * near_turned - s1 * far_turned;
  v = {v[0] + near + far, first + first_turned, second + second_turned, second - second_turned, first - first_turned};
}

constexpr int largest_short_radix = 5;

// Four as often as it goes: the fewest passes. Primes above five come first, as they cannot be summed in place.
std::vector<int> factors(int n) {
  std::vector<int> few, others;
  for (const int radix : {4, 2, 3, 5}) {
    for (; n % radix == 0; n /= radix) few.push_back(radix);
  }
  for (int radix = 7; n > 1; radix += 2) {
    for (; n % radix == 0; n /= radix) others.push_back(radix);
  }
  others.insert(others.end(), few.begin(), few.end());
  return others;
}

}  // namespace

SingleFft::SingleFft(int n, Direction direction) : sign_(direction == Direction::forward ? -1.0F : 1.0F), rows_(n) {
  for (int k = 0; k < n; ++k) rows_[k] = row_size * k;
  int stride = 1;
  for (const int radix : factors(n)) {
    const int parts = n / stride / radix;
    const auto add_root = [&](double numerator, double denominator) {
      const double angle = 2.0 * std::numbers::pi * numerator / denominator;
      cosine_.push_back(static_cast<float>(std::cos(angle)));
      sine_.push_back(sign_ * static_cast<float>(std::sin(angle)));
    };
    Pass pass{radix, parts, stride, cosine_.size(), 0};
    for (int p = 0; p < parts; ++p) {
      for (int k = 1; k < radix; ++k) add_root(p * k, radix * parts);
    }
    pass.roots = cosine_.size();
    for (int j = 0; radix > largest_short_radix && j < radix; ++j) add_root(j, radix);
    passes_.push_back(pass);
    stride *= radix;
  }
}

void SingleFft::execute(float* block, float* result) const {
  if (passes_.empty()) {
    std::memcpy(result, block, sizeof(float) * row_size);
    return;
  }
  // To and fro, so that the last pass ends in the result: within it, if the number of passes is even.
  float* from = block;
  float* to = result;
  for (std::size_t p = 0; p + 1 < passes_.size(); ++p) {
    run(passes_[p], from, to);
    std::swap(from, to);
  }
  const Pass& last = passes_.back();
  if (from == result && last.radix > largest_short_radix) {
    run(last, from, to);
    std::memcpy(result, to, sizeof(float) * row_size * rows_.size());
  } else {
    run(last, from, result);
  }
}

void SingleFft::run(const Pass& pass, const float* in, float* out) const {
  switch (pass.radix) {
    case 2:
      return run<2>(pass, in, out);
    case 3:
      return run<3>(pass, in, out);
    case 4:
      return run<4>(pass, in, out);
    case 5:
      return run<5>(pass, in, out);
    default:
      return run_any(pass, in, out);
  }
}

template <int radix>
void SingleFft::run(const Pass& pass, const float* in, float* out) const {
  const std::ptrdiff_t stride = pass.stride * row_size;
  const std::ptrdiff_t apart = pass.parts * stride;
  const Row i = alternating(sign_);
  for (int p = 0; p < pass.parts; ++p) {
    const float* from = in + p * stride;
    float* to = out + p * radix * stride;
    std::array<float, radix> cosine, sine;
    for (int k = 1; k < radix; ++k) {
      cosine[k] = cosine_[pass.factors + static_cast<std::size_t>(p * (radix - 1) + k - 1)];
      sine[k] = sine_[pass.factors + static_cast<std::size_t>(p * (radix - 1) + k - 1)];
    }
    for (std::ptrdiff_t q = 0; q < stride; q += row_size) {
      std::array<Row, radix> v;
      for (int j = 0; j < radix; ++j) v[j] = load_row(from + q + j * apart);
      sum(v, i);
      store_row(to + q, v[0]);
      for (int k = 1; k < radix; ++k) {
        const Row factored = p == 0 ? v[k] : cosine[k] * v[k] + alternating(sine[k]) * swapped(v[k]);
        store_row(to + q + k * stride, factored);
      }
    }
  }
}

// The sums as they stand, with radix^2 products.
void SingleFft::run_any(const Pass& pass, const float* in, float* out) const {
  const int radix = pass.radix;
  const std::ptrdiff_t stride = pass.stride * row_size;
  const std::ptrdiff_t apart = pass.parts * stride;
  const auto product = [&](std::size_t root, const Row& v) {
    return cosine_[root] * v + alternating(sine_[root]) * swapped(v);
  };
  for (int p = 0; p < pass.parts; ++p) {
    for (std::ptrdiff_t q = 0; q < stride; q += row_size) {
      const float* from = in + p * stride + q;
      float* to = out + p * radix * stride + q;
      for (int k = 0; k < radix; ++k) {
        Row sum = load_row(from);
        for (int j = 1, root = k; j < radix; ++j) {
          sum += product(pass.roots + static_cast<std::size_t>(root), load_row(from + j * apart));
          root = root + k < radix ? root + k : root + k - radix;
        }
        if (k > 0) sum = product(pass.factors + static_cast<std::size_t>(p * (radix - 1) + k - 1), sum);
        store_row(to + k * stride, sum);
      }
    }
  }
}

}  // namespace vesiflow::fluid
