// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/point_evaluation.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "support.h"

namespace vesiflow::vesicle::point_evaluation_test {
namespace {

using testing::random_coefficients;

VectorField directions_of(const SphereGrid& grid) {
  return sphere(grid);
}

/// Every degree and order against the transforms, which have their own tables; fields beyond three take another path.
TEST(PointEvaluation, AgreesWithSynthesisAtTheNodes) {
  for (const auto& [degrees, fields] : {std::pair{16, 1}, {17, 3}, {32, 5}, {64, 3}}) {
    const SphereGrid grid(degrees);
    const Coefficients coefficients = random_coefficients(degrees, fields, 11);
    Eigen::ArrayXXd expected(grid.size(), fields), found(grid.size(), fields);
    SphericalHarmonics(degrees, grid).synthesis(coefficients, expected);
    PointEvaluation(degrees).values_at(coefficients, directions_of(grid), found);
    // Each value sums degrees^2 terms of size about one; directions carry one rounding, which derivatives amplify.
    EXPECT_LT((found - expected).abs().maxCoeff(), 1e-15 * degrees * degrees * degrees) << degrees;
  }
}

/// The standard library takes sin(theta) from its cosine, and so is no reference next to the poles: those are below.
TEST(PointEvaluation, AgreesWithTheStandardLibraryAtAnyPoint) {
  constexpr int degrees = 24;
  const Coefficients coefficients = random_coefficients(degrees, 1, 12);
  const std::array<std::array<double, 2>, 5> angles{{{0.05, 2}, {0.3, 5}, {1.5707, 0.1}, {2.5, 4}, {3.1, 1}}};
  VectorField directions(5, 3);
  for (int k = 0; k < 5; ++k) {
    const auto [theta, phi] = angles[k];
    directions.row(k) << std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta);
  }
  Eigen::ArrayXXd values(5, 1);
  PointEvaluation(degrees).values_at(coefficients, directions, values);
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(values(k, 0), testing::point_value(coefficients, angles[k][0], angles[k][1]), 1e-11) << k;
}

/// At the poles only m = 0 is left, with P_n^0(+-1) = (+-1)^n sqrt((2n + 1)/(4 pi)).
TEST(PointEvaluation, IsExactAtThePoles) {
  constexpr int degrees = 40;
  const Coefficients coefficients = random_coefficients(degrees, 1, 13);
  VectorField poles = VectorField::Zero(2, 3);
  poles(0, 2) = 1;
  poles(1, 2) = -1;
  Eigen::ArrayXXd values(2, 1);
  PointEvaluation(degrees).values_at(coefficients, poles, values);
  double north = 0, south = 0;
  for (int n = 0; n < degrees; ++n) {
    const double term = coefficients(0, n, 0).real() * std::sqrt((2 * n + 1) / (4 * std::numbers::pi));
    north += term;
    south += n % 2 ? -term : term;
  }
  EXPECT_NEAR(values(0, 0), north, 1e-12);
  EXPECT_NEAR(values(1, 0), south, 1e-12);
}

/// Fewer degrees than the evaluation was made for read the same tables.
TEST(PointEvaluation, TakesExpansionsOfFewerDegrees) {
  const SphereGrid grid(12);
  const Coefficients coefficients = random_coefficients(9, 2, 14);
  Eigen::ArrayXXd few(grid.size(), 2), many(grid.size(), 2);
  PointEvaluation(9).values_at(coefficients, directions_of(grid), few);
  PointEvaluation(31).values_at(coefficients, directions_of(grid), many);
  EXPECT_TRUE((few == many).all());
}

/// High degrees: the addition theorem sum_m |Y_n^m|^2 = (2n + 1)/(4 pi), near the pole where (x + i y)^m underflows and at
/// the equator.
TEST(PointEvaluation, HighDegreesObeyTheAdditionTheorem) {
  constexpr int n = 511;
  Coefficients zonal(n + 1, 1);
  zonal.set_zero();
  zonal(0, n, n) = 1;
  VectorField directions(3, 3);
  directions.row(0) << 1, 0, 0;
  directions.row(1) << std::sin(1e-3), 0, std::cos(1e-3);
  directions.row(2) << std::sin(1.2), 0, std::cos(1.2);
  const PointEvaluation evaluation(n + 1);
  Eigen::ArrayXXd value(3, 1);
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(3);
  for (int m = 0; m <= n; ++m) {
    zonal.set_zero();
    zonal(0, n, m) = 1;
    evaluation.values_at(zonal, directions, value);
    sum += (m == 0 ? 1.0 : 0.5) * value.col(0).square();  // |2 Re Y|^2 = 4 |Y|^2 at longitude 0, orders m and -m
  }
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k] * 4 * std::numbers::pi / (2 * n + 1), 1, 1e-10) << k;
}

TEST(PointEvaluation, RefusesBadArguments) {
  EXPECT_THROW(PointEvaluation(0), std::invalid_argument);
  EXPECT_THROW(PointEvaluation(513), std::invalid_argument);
  const PointEvaluation evaluation(8);
  VectorField directions = VectorField::Zero(2, 3);
  directions.col(0) = 1;
  Eigen::ArrayXXd values(2, 1), wrong(3, 1);
  EXPECT_NO_THROW(evaluation.values_at(random_coefficients(8, 1, 15), directions, values));
  EXPECT_THROW(evaluation.values_at(random_coefficients(9, 1, 15), directions, values), std::invalid_argument);
  EXPECT_THROW(evaluation.values_at(random_coefficients(8, 1, 15), directions, wrong), std::invalid_argument);
  EXPECT_THROW(evaluation.values_at(random_coefficients(8, 2, 15), directions, values), std::invalid_argument);
  directions(1, 0) = 1.001;
  EXPECT_THROW(evaluation.values_at(random_coefficients(8, 1, 15), directions, values), std::invalid_argument);
}

/// Largest elements of arrays may pass over a NaN.
TEST(PointEvaluation, RefusesDirectionsThatAreNotANumber) {
  const PointEvaluation evaluation(4);
  VectorField directions = VectorField::Zero(40, 3);
  directions.col(0) = 1;
  directions(17, 1) = std::numeric_limits<double>::quiet_NaN();
  Eigen::ArrayXXd values(40, 1);
  EXPECT_THROW(evaluation.values_at(testing::random_coefficients(4, 1, 1), directions, values), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::vesicle::point_evaluation_test
