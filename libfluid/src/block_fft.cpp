// With n = 3 m:  Z_{3k+s} = sum_{j<m} exp(-2 pi i j k / m) [exp(-2 pi i j s / n) sum_{q<3} exp(-2 pi i q s / 3) z_{j+qm}].
#include "block_fft.h"

#include <cmath>
#include <numbers>

#include "aligned_array.h"
#include "lanes.h"

namespace vesiflow::fluid {
namespace {

fftw_complex* as_complex(double* block) {
  return reinterpret_cast<fftw_complex*>(block);
}

bool is_split(int n) {
  return n % 3 == 0 && n >= 192;
}

fftw_plan make_plan(int n, int sign) {
  const AlignedArray in = allocate_aligned(static_cast<std::size_t>(lanes) * n);
  const AlignedArray out = allocate_aligned(static_cast<std::size_t>(lanes) * n);
  return fftw_plan_many_dft(1, &n, lanes / 2, as_complex(in.get()), nullptr, lanes / 2, 1, as_complex(out.get()),
                            nullptr, lanes / 2, 1, sign, FFTW_ESTIMATE);
}

Vector4 multiply(const Vector4& z, double real, double imaginary) {
  return real * z + imaginary * times_i(z);
}

}  // namespace

BlockFft::BlockFft(int n, Direction direction)
    : third_(is_split(n) ? n / 3 : n),
      rows_(n),
      plan_([&] { return make_plan(third_, direction == Direction::forward ? FFTW_FORWARD : FFTW_BACKWARD); }) {
  const int parts = n / third_;
  for (int k = 0; k < n; ++k) rows_[k] = lanes * (k % parts * third_ + k / parts);
  const double sign = direction == Direction::forward ? -1.0 : 1.0;
  root_ = 0.5 * sign * std::numbers::sqrt3;
  for (int j = 0; parts > 1 && j < third_; ++j) {
    for (int s = 1; s <= 2; ++s) {
      const double angle = 2.0 * std::numbers::pi * (j * s) / n;
      cosine_.push_back(std::cos(angle));
      sine_.push_back(sign * std::sin(angle));
    }
  }
}

void BlockFft::execute(double* block, double* result) const {
  if (!cosine_.empty()) split(block);
  for (int first = 0; first < static_cast<int>(rows_.size()); first += third_) {
    fftw_execute_dft(plan_.get(), as_complex(block + lanes * first), as_complex(result + lanes * first));
  }
}

void BlockFft::split(double* block) const {
  const std::ptrdiff_t step = static_cast<std::ptrdiff_t>(lanes) * third_;
  for (int j = 0; j < third_; ++j) {
    double* row = block + lanes * j;
    for (int l = 0; l < lanes; l += 4) {
      const Vector4 z = load4(row + l);
      const Vector4 sum = load4(row + step + l) + load4(row + 2 * step + l);
      const Vector4 difference = root_ * times_i(load4(row + step + l) - load4(row + 2 * step + l));
      const Vector4 rest = z - 0.5 * sum;
      store4(row + l, z + sum);
      store4(row + step + l, multiply(rest + difference, cosine_[2 * j], sine_[2 * j]));
      store4(row + 2 * step + l, multiply(rest - difference, cosine_[2 * j + 1], sine_[2 * j + 1]));
    }
  }
}

}  // namespace vesiflow::fluid
