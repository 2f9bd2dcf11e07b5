// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/delta_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace vesiflow::coupling::delta_kernel_test {
namespace {

constexpr Direction directions[] = {Direction::normal, Direction::tangential};

std::vector<double> weights_of(DeltaKernel kernel, double t, Direction direction = Direction::normal) {
  std::vector<double> weights(static_cast<std::size_t>(support_width(kernel, direction)));
  delta_weights(kernel, t, weights, direction);
  return weights;
}

// Signed distance, marker minus point, of weight j.
double distance(int width, double t, std::size_t j) {
  return 0.5 * width - 1.0 + t - static_cast<double>(j);
}

// sum_j w_j r_j^power
double moment(const std::vector<double>& weights, double t, int power) {
  double sum = 0.0;
  for (std::size_t j = 0; j < weights.size(); ++j)
    sum += weights[j] * std::pow(distance(static_cast<int>(weights.size()), t, j), power);
  return sum;
}

// Positions of the marker: the ends and many between.
std::vector<double> positions() {
  std::vector<double> t{0.0, 1e-12, 0.5, 1.0 - 1e-12};
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) t.push_back(unit(generator));
  return t;
}

template <class Check>
void for_each_function(const Check& check) {
  for (const DeltaKernel kernel : delta_kernels)
    for (const Direction direction : directions) {
      SCOPED_TRACE(std::string(name(kernel)) + (direction == Direction::normal ? ", normal" : ", tangential"));
      check(kernel, direction);
    }
}

// Order of the B-spline of a composite kernel; 0 for others.
int spline_order(DeltaKernel kernel, Direction direction) {
  return interpolation(kernel) == Interpolation::plain ? 0 : support_width(kernel, direction);
}

TEST(DeltaKernel, NamesAreFoundAndOthersRefused) {
  for (const DeltaKernel kernel : delta_kernels) EXPECT_EQ(delta_kernel(name(kernel)), kernel);
  EXPECT_EQ(delta_kernel("smoothed4"), DeltaKernel::smoothed_four_point);
  EXPECT_EQ(delta_kernel("bspline54"), DeltaKernel::composite_bspline_54);
  try {
    delta_kernel("cosine");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "delta kernel \"cosine\": must be one of \"roma3\" \"peskin4\" \"smoothed4\" \"bao6\" \"bspline32\" "
                 "\"bspline43\" \"bspline54\"");
  }
}

TEST(DeltaKernel, WidthsAndWallDistances) {
  const auto check = [](DeltaKernel kernel, int normal, int tangential, double distance_from_wall, Interpolation kind) {
    EXPECT_EQ(support_width(kernel), normal);
    EXPECT_EQ(support_width(kernel, Direction::tangential), tangential);
    EXPECT_EQ(wall_clearance(kernel), distance_from_wall);
    EXPECT_EQ(interpolation(kernel), kind);
  };
  check(DeltaKernel::three_point, 3, 3, 1.0, Interpolation::plain);
  check(DeltaKernel::four_point, 4, 4, 1.5, Interpolation::plain);
  check(DeltaKernel::smoothed_four_point, 4, 4, 1.5, Interpolation::plain);
  check(DeltaKernel::six_point, 6, 6, 2.5, Interpolation::plain);
  check(DeltaKernel::composite_bspline_32, 3, 2, 0.5, Interpolation::divergence_preserving);
  check(DeltaKernel::composite_bspline_43, 4, 3, 1.0, Interpolation::divergence_preserving);
  check(DeltaKernel::composite_bspline_54, 5, 4, 1.5, Interpolation::divergence_preserving);
}

TEST(DeltaKernel, WeightsNeedTheirRoom) {
  std::vector<double> five(5);
  EXPECT_THROW(delta_weights(DeltaKernel::smoothed_four_point, 0.5, five), std::invalid_argument);
}

// Independent of the formulas in use: the 3- and 4-point functions as their papers write them, B-splines as truncated
// powers, the smoothed function by a 40-digit convolution of the 3-point one over a cell.
double roma(double r) {
  r = std::abs(r);
  if (r > 1.5) return 0.0;
  return r <= 0.5 ? (1.0 + std::sqrt(1.0 - 3.0 * r * r)) / 3.0
                  : (5.0 - 3.0 * r - std::sqrt(1.0 - 3.0 * (1.0 - r) * (1.0 - r))) / 6.0;
}
double peskin(double r) {
  r = std::abs(r);
  if (r > 2.0) return 0.0;
  return r <= 1.0 ? (3.0 - 2.0 * r + std::sqrt(1.0 + 4.0 * r - 4.0 * r * r)) / 8.0
                  : (5.0 - 2.0 * r - std::sqrt(-7.0 + 12.0 * r - 4.0 * r * r)) / 8.0;
}
double bspline(int order, double r) {
  double sum = 0.0, binomial = 1.0, factorial = 1.0;
  for (int k = 2; k < order; ++k) factorial *= k;
  for (int k = 0; k <= order; ++k) {
    sum += (k % 2 ? -binomial : binomial) * std::pow(std::max(0.0, r + 0.5 * order - k), order - 1);
    binomial *= static_cast<double>(order - k) / (k + 1);
  }
  return sum / factorial;
}

TEST(DeltaKernel, ValuesAreThoseOfThePapers) {
  for (double r = -3.4; r < 3.4; r += 0.0317) {
    EXPECT_NEAR(delta(DeltaKernel::three_point, r), roma(r), 2e-15) << r;
    EXPECT_NEAR(delta(DeltaKernel::four_point, r), peskin(r), 2e-15) << r;
  }
  // Truncated powers cancel: their own round-off is some 1e-13.
  for_each_function([](DeltaKernel kernel, Direction direction) {
    const int order = spline_order(kernel, direction);
    for (double r = -3.4; order > 0 && r < 3.4; r += 0.0317)
      EXPECT_NEAR(delta(kernel, r, direction), bspline(order, r), 2e-13) << r;
  });
  constexpr std::pair<double, double> smoothed[] = {
      {0.0, 0.6181999293593575},  {0.1, 0.609635946412666},   {0.5, 0.4670499823398394},  {0.9, 0.24446401826701272},
      {1.0, 0.19090003532032124}, {1.3, 0.07696256417875148}, {1.5, 0.03295001766016062}, {1.9, 0.000478672351102834},
  };
  for (const auto& [r, value] : smoothed) EXPECT_NEAR(delta(DeltaKernel::smoothed_four_point, r), value, 2e-15) << r;
  // At whole distances the conditions of Bao et al. alone give the 6-point function: phi(1) = 1/4, phi(0) + 2 phi(2) = 1/2.
  const double K = 59.0 / 60.0 - std::sqrt(29.0) / 20.0;
  EXPECT_NEAR(delta(DeltaKernel::six_point, 0.0), 0.5 - (K - 0.5) / 4.0, 1e-15);
  EXPECT_NEAR(delta(DeltaKernel::six_point, 1.0), 0.25, 1e-15);
  EXPECT_NEAR(delta(DeltaKernel::six_point, 2.0), (K - 0.5) / 8.0, 1e-15);
}

TEST(DeltaKernel, IsEvenNotNegativeAndZeroOutsideItsSupport) {
  for_each_function([](DeltaKernel kernel, Direction direction) {
    const double half = 0.5 * support_width(kernel, direction);
    for (double r = 0.0; r < half; r += 0.00731) {
      EXPECT_NEAR(delta(kernel, -r, direction), delta(kernel, r, direction), 2e-15) << r;
      EXPECT_GT(delta(kernel, r, direction), -1e-16) << r;
    }
    for (const double r : {half, half + 1e-9, 5.0, 1e300, std::nan("")}) {
      EXPECT_NEAR(delta(kernel, r, direction), 0.0, 1e-16) << r;
      EXPECT_NEAR(delta(kernel, -r, direction), 0.0, 1e-16) << r;
    }
  });
}

TEST(DeltaKernel, WeightsAreTheValuesAtTheGridPoints) {
  for_each_function([](DeltaKernel kernel, Direction direction) {
    for (const double t : positions()) {
      const auto w = weights_of(kernel, t, direction);
      for (std::size_t j = 0; j < w.size(); ++j)
        EXPECT_NEAR(w[j], delta(kernel, distance(static_cast<int>(w.size()), t, j), direction), 3e-15) << t;
    }
  });
}

TEST(DeltaKernel, KeepsConstantAndLinearFieldsForEveryPosition) {
  for_each_function([](DeltaKernel kernel, Direction direction) {
    for (const double t : positions()) {
      const auto w = weights_of(kernel, t, direction);
      EXPECT_NEAR(moment(w, t, 0), 1.0, 5e-15);
      EXPECT_NEAR(moment(w, t, 1), 0.0, 5e-15);
    }
  });
}

// Range over positions of a sum.
template <class Sum>
std::pair<double, double> range_of(DeltaKernel kernel, Direction direction, const Sum& sum) {
  double low = 1e300, high = -1e300;
  for (const double t : positions()) {
    const double value = sum(weights_of(kernel, t, direction), t);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return {low, high};
}

TEST(DeltaKernel, SecondMomentsAreConstantWhereTheConstructionSays) {
  const auto range = [](DeltaKernel kernel, Direction direction) {
    return range_of(kernel, direction, [](const auto& w, double t) { return moment(w, t, 2); });
  };
  const auto expect_constant = [&](DeltaKernel kernel, Direction direction, double value) {
    const auto [low, high] = range(kernel, direction);
    EXPECT_NEAR(low, value, 1e-14) << name(kernel);
    EXPECT_NEAR(high, value, 1e-14) << name(kernel);
  };
  expect_constant(DeltaKernel::smoothed_four_point, Direction::normal, 0.3818000706406425);
  expect_constant(DeltaKernel::six_point, Direction::normal, 59.0 / 60.0 - std::sqrt(29.0) / 20.0);
  for_each_function([&](DeltaKernel kernel, Direction direction) {
    // A B-spline is the density of a sum of `order` uniform numbers, each of variance 1/12; from order 3 on the grid's
    // sum is the integral.
    const int order = spline_order(kernel, direction);
    if (order >= 3) expect_constant(kernel, direction, order / 12.0);
  });
  const auto expect_range = [&](DeltaKernel kernel, Direction direction, double low, double high) {
    const auto found = range(kernel, direction);
    EXPECT_NEAR(found.first, low, 1e-4) << name(kernel);
    EXPECT_NEAR(found.second, high, 1e-4) << name(kernel);
  };
  expect_range(DeltaKernel::three_point, Direction::normal, 0.25, 1.0 / 3.0);
  expect_range(DeltaKernel::four_point, Direction::normal, 0.5, 0.542893);
  expect_range(DeltaKernel::composite_bspline_32, Direction::tangential, 0.0, 0.25);
}

TEST(DeltaKernel, ThirdMomentsVanishWhereTheConstructionSays) {
  for_each_function([](DeltaKernel kernel, Direction direction) {
    const auto [low, high] = range_of(kernel, direction, [](const auto& w, double t) { return moment(w, t, 3); });
    if (kernel == DeltaKernel::six_point || spline_order(kernel, direction) >= 4) {
      EXPECT_NEAR(low, 0.0, 2e-14);
      EXPECT_NEAR(high, 0.0, 2e-14);
    } else {
      EXPECT_LT(low, -1e-3);
      EXPECT_GT(high, 1e-3);
    }
  });
}

TEST(DeltaKernel, EvenAndOddPointsSumToHalfWhereTheConstructionSays) {
  for_each_function([](DeltaKernel kernel, Direction direction) {
    const auto [low, high] = range_of(kernel, direction, [](const auto& w, double) {
      double even = 0.0;
      for (std::size_t j = 0; j < w.size(); j += 2) even += w[j];
      return even;
    });
    const double spread = std::max(0.5 - low, high - 0.5);
    if (kernel == DeltaKernel::four_point || kernel == DeltaKernel::six_point) {
      EXPECT_LT(spread, 5e-15);
    } else {
      EXPECT_GT(spread, 1e-3);
    }
  });
}

TEST(DeltaKernel, SumsOfSquaresAreConstantWhereTheConstructionSays) {
  for_each_function([](DeltaKernel kernel, Direction direction) {
    const auto [low, high] = range_of(kernel, direction, [](const auto& w, double) {
      double sum = 0.0;
      for (const double value : w) sum += value * value;
      return sum;
    });
    const auto expect = [&, l = low, h = high](double value) {
      EXPECT_NEAR(l, value, 2e-15);
      EXPECT_NEAR(h, value, 2e-15);
    };
    switch (kernel) {
      case DeltaKernel::three_point:
        return expect(0.5);
      case DeltaKernel::four_point:
        return expect(0.375);
      case DeltaKernel::six_point:
        return expect(0.3257776153901864);
      default:
        EXPECT_GT(high - low, 1e-2);
    }
  });
}

// Jump of a derivative at r by differences of the fourth order from either side.
double jump_of_derivative(DeltaKernel kernel, Direction direction, double r, int derivative) {
  const double e = 4e-3;
  const auto one_sided = [&](double side) {
    // Forward differences sum_k (-1)^(k+1)/k D^k, raised to the derivative: the first terms.
    const auto difference = [&](int k) {
      double sum = 0.0, binomial = 1.0;
      for (int i = 0; i <= k; ++i) {
        sum += ((k - i) % 2 ? -binomial : binomial) * delta(kernel, r + side * (i + 1e-9) * e, direction);
        binomial *= static_cast<double>(k - i) / (i + 1);
      }
      return sum;
    };
    const double n = derivative;
    const double value = difference(derivative) - n / 2.0 * difference(derivative + 1) +
                         n * (3.0 * n + 5.0) / 24.0 * difference(derivative + 2);
    return value / std::pow(side * e, derivative);
  };
  return one_sided(1.0) - one_sided(-1.0);
}

// The largest jump over all places where pieces of the function meet.
double largest_jump(DeltaKernel kernel, Direction direction, int derivative) {
  double largest = 0.0;
  const double half = 0.5 * support_width(kernel, direction);
  for (double joint = -half; joint <= half; joint += 0.5)
    largest = std::max(largest, std::abs(jump_of_derivative(kernel, direction, joint, derivative)));
  return largest;
}

TEST(DeltaKernel, HasAsManyContinuousDerivativesAsItsConstructionSays) {
  for_each_function([](DeltaKernel kernel, Direction direction) {
    int continuous = 1;  // 3- and 4-point functions
    if (kernel == DeltaKernel::smoothed_four_point) continuous = 2;
    if (kernel == DeltaKernel::six_point) continuous = 3;
    if (const int order = spline_order(kernel, direction)) continuous = order - 2;
    for (int d = 0; d <= continuous; ++d) EXPECT_LT(largest_jump(kernel, direction, d), 0.02) << "derivative " << d;
    EXPECT_GT(largest_jump(kernel, direction, continuous + 1), 0.2);
  });
}

// Translation error: the velocity that a force at one marker induces at another should depend on the distance of the two
// alone. With delta functions only: sum_x delta(x - X) delta(x - Y) over positions of the pair against the grid, in one
// dimension, over its largest value (Bao et al. 2016, section 3).
double translation_error(DeltaKernel kernel, double separation) {
  double low = 1e300, high = -1e300;
  for (double shift = 0.0; shift < 1.0; shift += 0.01) {
    double sum = 0.0;
    for (int i = -8; i <= 8; ++i) sum += delta(kernel, i - shift) * delta(kernel, i - shift - separation);
    low = std::min(low, sum);
    high = std::max(high, sum);
  }
  return high - low;
}

double worst_translation_error(DeltaKernel kernel) {
  double at_zero = 0.0, worst = 0.0;
  for (int i = 0; i < 17; ++i) at_zero += std::pow(delta(kernel, i - 8.0), 2);
  for (double separation = 0.0; separation <= 4.0; separation += 0.05)
    worst = std::max(worst, translation_error(kernel, separation));
  return worst / at_zero;
}

// Constant sums of squares (the construction of the first, second and fourth) bound it; smoothness alone helps slowly: the
// smoothed 4-point function is no better in this measure than the one that it smooths.
TEST(DeltaKernel, TranslationErrorsAreOrderedAsTheConstructionsSay) {
  const double peskin4 = worst_translation_error(DeltaKernel::four_point);
  EXPECT_GT(worst_translation_error(DeltaKernel::three_point), 2.0 * peskin4);
  EXPECT_NEAR(worst_translation_error(DeltaKernel::smoothed_four_point), peskin4, 0.1 * peskin4);
  EXPECT_LT(worst_translation_error(DeltaKernel::six_point), 0.05 * peskin4);
  const double cubic = worst_translation_error(DeltaKernel::composite_bspline_43);
  EXPECT_GT(worst_translation_error(DeltaKernel::composite_bspline_32), 2.0 * cubic);
  EXPECT_LT(worst_translation_error(DeltaKernel::composite_bspline_54), 0.5 * cubic);
}

// E|r - r'| by the midpoint rule in both variables; its error is of second order and below 1e-6 at this width.
TEST(DeltaKernel, ThickeningIsTheMeanDistanceOfTwoPointsUnderTheTangentialFunction) {
  for (const DeltaKernel kernel : delta_kernels) {
    constexpr int points = 1200;
    const double width = support_width(kernel, Direction::tangential), step = width / points;
    std::vector<double> value(points);
    for (int i = 0; i < points; ++i)
      value[static_cast<std::size_t>(i)] = step * delta(kernel, -0.5 * width + (i + 0.5) * step, Direction::tangential);
    double mean = 0.0;
    for (int i = 0; i < points; ++i)
      for (int j = 0; j < i; ++j)
        mean += 2.0 * (i - j) * step * value[static_cast<std::size_t>(i)] * value[static_cast<std::size_t>(j)];
    EXPECT_NEAR(thickening(kernel), 0.5 * mean, 5e-6) << name(kernel);
  }
}

}  // namespace
}  // namespace vesiflow::coupling::delta_kernel_test
