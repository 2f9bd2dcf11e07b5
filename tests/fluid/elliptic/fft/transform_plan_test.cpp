// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The transforms of the fft solver against their definitions, summed in long double.
#include "elliptic/fft/transform_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "elliptic/fft/lanes.h"
#include "grid/aligned_array.h"

namespace vesiflow::fluid::transform_plan_test {
namespace {

using Real = long double;
using Case = std::tuple<Basis, Direction>;

constexpr Basis bases[] = {Basis::sine_points, Basis::sine_cells, Basis::cosine_cells, Basis::mixed_cells,
                           Basis::fourier};

// Row k, column j of the transform's matrix (line_transform.h).
Real matrix(Basis basis, Direction direction, int n, int k, int j) {
  const Real pi = std::numbers::pi_v<Real>;
  if (basis == Basis::sine_points) return 2 * std::sin(pi * ((j + 1) * (k + 1) % (2 * (n + 1))) / (n + 1));
  if (basis == Basis::mixed_cells) return 2 * std::cos(pi * ((2 * j + 1) * (2 * k + 1) % (8 * n)) / (4 * n));
  if (basis == Basis::fourier) {
    const int wave = direction == Direction::forward ? k : j;
    const Real angle = 2 * pi * (static_cast<long>(j) * k % n) / n;
    const Real value = 2 * wave <= n ? std::cos(angle) : std::sin(angle);
    return direction == Direction::backward && 2 * wave % n != 0 ? 2 * value : value;
  }
  const int space = direction == Direction::forward ? j : k;
  const int mode = (direction == Direction::forward ? k : j) + (basis == Basis::sine_cells ? 1 : 0);
  const Real angle = pi * ((2 * space + 1) * mode % (4 * n)) / (2 * n);
  const Real value = basis == Basis::sine_cells ? std::sin(angle) : std::cos(angle);
  const bool halved = direction == Direction::backward && mode == (basis == Basis::sine_cells ? n : 0);
  return halved ? value : 2 * value;
}

std::vector<double> random_numbers(std::size_t count) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> values(count);
  for (double& v : values) v = uniform(engine);
  return values;
}

// The relative error, in the maximum norm, of the transform of a block of random lines.
template <class Scalar>
double line_error(int n, Basis basis, Direction direction) {
  const LineTransform<Scalar> transform(n, basis, direction);
  const auto x = random_numbers(static_cast<std::size_t>(n) * lanes<Scalar>);
  const auto block = allocate_aligned<Scalar>(transform.block_size());
  const auto result = allocate_aligned<Scalar>(transform.block_size());
  for (int j = 0; j < n; ++j) {
    for (int l = 0; l < lanes<Scalar>; ++l) {
      block[transform.input()[j].offset + l] =
          transform.input()[j].sign * static_cast<Scalar>(x[j * lanes<Scalar> + l]);
    }
  }
  transform.execute(block.get(), result.get());
  Real error = 0;
  Real largest = 0;
  for (int k = 0; k < n; ++k) {
    std::vector<Real> exact(lanes<Scalar>);
    for (int j = 0; j < n; ++j) {
      const Real factor = matrix(basis, direction, n, k, j);
      for (int l = 0; l < lanes<Scalar>; ++l) exact[l] += factor * x[j * lanes<Scalar> + l];
    }
    for (int l = 0; l < lanes<Scalar>; ++l) {
      const Real y = transform.output()[k].sign * result[transform.output()[k].offset + l];
      error = std::max(error, std::abs(y - exact[l]));
      largest = std::max(largest, std::abs(exact[l]));
    }
  }
  return static_cast<double>(error / largest);
}

class Transform : public testing::TestWithParam<Case> {};

TEST_P(Transform, OfLinesAgreesWithTheDefinition) {
  const auto [basis, direction] = GetParam();
  std::vector<int> lengths{63, 64, 95, 96, 97, 127, 128};
  for (int n = 1; n <= 40; ++n) lengths.push_back(n);
  for (const int n : lengths) EXPECT_LT(line_error<double>(n, basis, direction), 2e-15) << "length " << n;
}

TEST_P(Transform, IsAccurateForLongLines) {
  const auto [basis, direction] = GetParam();
  for (const int n : {192, 254, 256, 384, 500, 509, 512})
    EXPECT_LT(line_error<double>(n, basis, direction), 5e-15) << "length " << n;
}

// As many units of round-off; the numbers themselves are rounded, too. All factors up to 5 in all orders of passes, and sums
// of larger primes as the first pass, as the last and as both.
TEST_P(Transform, OfLinesInSinglePrecisionIsAsAccurateAsThatIs) {
  const auto [basis, direction] = GetParam();
  std::vector<int> lengths{48, 49, 63, 64, 77, 80, 95, 96, 97, 98, 100, 127, 128, 144, 192, 256, 254, 384, 500, 512};
  for (int n = 1; n <= 40; ++n) lengths.push_back(n);
  for (const int n : lengths) EXPECT_LT(line_error<float>(n, basis, direction), 1e-6) << "length " << n;
}

TEST_P(Transform, OfPlanesTransformsBothAxesAndNothingElse) {
  const auto [basis, direction] = GetParam();
  for (const Basis other : bases) {
    for (const auto& [nx, ny] : {std::array{4, 5}, {8, 16}, {7, 13}, {17, 9}, {33, 1}, {1, 10}}) {
      const int stride = nx + 3;
      const auto x = random_numbers(static_cast<std::size_t>(stride) * ny);
      std::vector<double> y = x;
      const TransformPlan<double> plan({nx, ny}, {basis, other}, direction);
      const AlignedArray scratch = allocate_aligned(TransformPlan<double>::scratch_size({nx, ny}, {basis, other}));
      plan.execute<double, double>({y.data(), stride}, {y.data(), stride}, {}, scratch.get());
      for (int ky = 0; ky < ny; ++ky) {
        for (int kx = 0; kx < stride; ++kx) {
          if (kx >= nx) {
            EXPECT_EQ(y[ky * stride + kx], x[ky * stride + kx]);
            continue;
          }
          Real exact = 0;
          for (int jy = 0; jy < ny; ++jy) {
            for (int jx = 0; jx < nx; ++jx) {
              exact +=
                  matrix(basis, direction, nx, kx, jx) * matrix(other, direction, ny, ky, jy) * x[jy * stride + jx];
            }
          }
          EXPECT_NEAR(y[ky * stride + kx], static_cast<double>(exact), 4e-15 * nx * ny) << nx << " x " << ny;
        }
      }
    }
  }
}

TEST(TransformPlan, ForwardThenBackwardMultipliesByThePairFactor) {
  const std::array extent{37, 96};
  const auto x = random_numbers(static_cast<std::size_t>(extent[0]) * extent[1]);
  for (const Basis basis : bases) {
    const AlignedArray scratch = allocate_aligned(TransformPlan<double>::scratch_size(extent, {basis, basis}));
    const TransformPlan<double> forward(extent, {basis, basis}, Direction::forward);
    const TransformPlan<double> backward(extent, {basis, basis}, Direction::backward);
    std::vector<double> y(x.size());
    forward.execute<double, double>({x.data(), extent[0]}, {y.data(), extent[0]}, {}, scratch.get());
    backward.execute<double, double>({y.data(), extent[0]}, {y.data(), extent[0]}, {}, scratch.get());
    const double factor =
        LineTransform<double>::pair_factor(basis, extent[0]) * LineTransform<double>::pair_factor(basis, extent[1]);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(y[i] / factor, x[i], 4e-15) << static_cast<int>(basis);
  }
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  const char* names[] = {"sine_points", "sine_cells", "cosine_cells", "mixed_cells", "fourier"};
  return std::string(names[static_cast<int>(std::get<0>(info.param))]) +
         (std::get<1>(info.param) == Direction::forward ? "_forward" : "_backward");
}

INSTANTIATE_TEST_SUITE_P(All, Transform,
                         testing::Combine(testing::ValuesIn(bases),
                                          testing::Values(Direction::forward, Direction::backward)),
                         case_name);

}  // namespace
}  // namespace vesiflow::fluid::transform_plan_test
