// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/spherical_harmonics.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support.h"

namespace vesiflow::vesicle::spherical_harmonics_test {
namespace {

using testing::point_value;
using testing::random_coefficients;

double max_difference(const Coefficients& a, const Coefficients& b) {
  double largest = 0;
  for (int field = 0; field < a.fields(); ++field)
    for (int n = 0; n < std::min(a.degrees(), b.degrees()); ++n)
      for (int m = 0; m <= n; ++m) largest = std::max(largest, std::abs(a(field, n, m) - b(field, n, m)));
  return largest;
}

void expect_round_trip(int degrees, const SphereGrid& grid, int fields, double tolerance) {
  const SphericalHarmonics harmonics(degrees, grid);
  const Coefficients given = random_coefficients(degrees, fields, 1);
  Eigen::ArrayXXd values(grid.size(), fields);
  harmonics.synthesis(given, values);
  Coefficients found;
  harmonics.analysis(values, found);
  EXPECT_LT(max_difference(given, found), tolerance)
      << degrees << ' ' << grid.latitudes() << ' ' << grid.longitudes() << ' ' << fields;
}

TEST(SphericalHarmonics, RoundTripForAnyNumberOfFieldsAndLatitudes) {
  for (int latitudes : {2, 3, 4, 5, 7, 8, 16, 31, 32, 33, 64})
    for (int fields : {1, 2, 3, 6}) expect_round_trip(latitudes, SphereGrid(latitudes), fields, 5e-14);
  expect_round_trip(127, SphereGrid(127), 1, 2e-13);
}

TEST(SphericalHarmonics, RoundTripWithMoreLongitudesOrFewerDegrees) {
  for (int longitudes : {10, 12, 14, 30}) expect_round_trip(5, SphereGrid(5, longitudes), 2, 2e-14);
  expect_round_trip(20, SphereGrid(32, 90), 3, 5e-14);
}

TEST(SphericalHarmonics, RoundTripOfFewDegreesAtMostLatitudes) {
  expect_round_trip(24, SphereGrid(512), 1, 2e-13);
}

/// Of the highest orders on many latitudes most of the table is negligible: energies and the derivatives' identity
/// int |grad f|^2 = n (n + 1) int f^2 hold nevertheless.
TEST(SphericalHarmonics, GradientHasTheEigenvalueOfTheLaplacian) {
  for (int latitudes : {3, 4, 5, 7, 8, 31, 32, 33, 64, 127}) {
    const SphereGrid grid(latitudes);
    const SphericalHarmonics harmonics(latitudes, grid);
    const int n = latitudes - 1;
    for (int m : {0, 1, n / 2, n - 1, n}) {
      Coefficients c(latitudes, 1);
      c.set_zero();
      c(0, n, m) = m == 0 ? 1 : std::sqrt(0.5);
      ScalarField t(grid.size()), p(grid.size());
      harmonics.gradient(c, t, p);
      double integral = 0;
      for (int j = 0; j < latitudes; ++j) {
        const Eigen::Index ring = grid.index(0, j), count = grid.longitudes();
        const double s = grid.sin_colatitude()[j];
        integral += grid.weight()[j] * grid.longitude_spacing() *
                    (t.segment(ring, count).square() + (p.segment(ring, count) / s).square()).sum();
      }
      EXPECT_NEAR(integral / (n * (n + 1)), 1, 1e-13) << latitudes << ' ' << m;
    }
  }
}

TEST(SphericalHarmonics, SynthesisMatchesDirectSummation) {
  for (int latitudes : {8, 9}) {
    const SphereGrid grid(latitudes);
    const Coefficients c = random_coefficients(latitudes, 1, 2);
    ScalarField values(grid.size());
    SphericalHarmonics(latitudes, grid).synthesis(c, values);
    for (int j = 0; j < latitudes; ++j)
      for (int i = 0; i < grid.longitudes(); ++i)
        EXPECT_NEAR(values[grid.index(i, j)], point_value(c, grid.colatitude()[j], grid.longitude(i)), 1e-13);
  }
}

/// More degrees than the grid resolves: still the exact values at the nodes, up to several windings of the
/// orders.
TEST(SphericalHarmonics, FoldedOrdersArePointValues) {
  for (int latitudes : {5, 8})
    for (int degrees : {latitudes + 1, 2 * latitudes, 5 * latitudes + 3}) {
      const SphereGrid grid(latitudes);
      const Coefficients c = random_coefficients(degrees, 1, 3);
      ScalarField values(grid.size());
      SphericalHarmonics(degrees, grid).synthesis(c, values);
      for (int j = 0; j < latitudes; ++j)
        for (int i = 0; i < grid.longitudes(); ++i)
          EXPECT_NEAR(values[grid.index(i, j)], point_value(c, grid.colatitude()[j], grid.longitude(i)), 1e-11);
    }
}

/// The derivatives of one harmonic by formulas other than the library's: a recurrence in degree and
/// Legendre's equation.
TEST(SphericalHarmonics, DerivativesOfKnownHarmonics) {
  constexpr int latitudes = 12;
  const SphereGrid grid(latitudes);
  for (int degrees : {12, 24}) {
    const SphericalHarmonics harmonics(degrees, grid);
    ScalarField t(grid.size()), p(grid.size()), tt(grid.size()), tp(grid.size()), pp(grid.size());
    for (int n = 0; n < degrees; n += 3)
      for (int m = 0; m <= n; m += 2) {
        Coefficients c(degrees, 1);
        c.set_zero();
        c(0, n, m) = m == 0 ? 1 : 0.5;
        harmonics.gradient(c, t, p);
        harmonics.second_derivatives(c, tt, tp, pp);
        for (int j = 0; j < latitudes; ++j) {
          const double theta = grid.colatitude()[j];
          const double s = std::sin(theta);
          const double cot = std::cos(theta) / s;
          const double value = std::sph_legendre(unsigned(n), unsigned(m), theta);
          const double below = n > m ? std::sph_legendre(unsigned(n - 1), unsigned(m), theta) : 0;
          const double first =
              n * cot * value - (n > m ? std::sqrt((2 * n + 1.0) / (2 * n - 1) * (n * n - m * m)) * below / s : 0);
          const double second = -cot * first + (m * m / (s * s) - n * (n + 1)) * value;
          for (int i : {0, 1, 7}) {
            const double phi = grid.longitude(i);
            const Eigen::Index k = grid.index(i, j);
            const double tolerance = 1e-12 * (1 + n * n);
            EXPECT_NEAR(t[k], first * std::cos(m * phi), tolerance);
            EXPECT_NEAR(p[k], -m * value * std::sin(m * phi), tolerance);
            EXPECT_NEAR(tt[k], second * std::cos(m * phi), tolerance);
            EXPECT_NEAR(tp[k], -m * first * std::sin(m * phi), tolerance);
            EXPECT_NEAR(pp[k], -m * m * value * std::cos(m * phi), tolerance);
          }
        }
      }
  }
}

/// sum_nodes w f (S c) = <A f, c>, with the inner product of real fields, for any nodal f.
TEST(SphericalHarmonics, AnalysisIsTheAdjointOfSynthesis) {
  for (int latitudes : {9, 24})
    for (int degrees : {latitudes, latitudes / 2}) {
      const SphereGrid grid(latitudes);
      const SphericalHarmonics harmonics(degrees, grid);
      std::mt19937 generator(4);
      std::uniform_real_distribution<double> uniform(-1, 1);
      const ScalarField f = ScalarField::NullaryExpr(grid.size(), [&] { return uniform(generator); });
      const Coefficients c = random_coefficients(degrees, 1, 5);
      ScalarField synthesised(grid.size());
      harmonics.synthesis(c, synthesised);
      Coefficients analysed;
      harmonics.analysis(f, analysed);
      double nodes = 0;
      for (int j = 0; j < latitudes; ++j)
        for (int i = 0; i < grid.longitudes(); ++i)
          nodes += grid.weight()[j] * grid.longitude_spacing() * f[grid.index(i, j)] * synthesised[grid.index(i, j)];
      double modes = 0;
      for (int n = 0; n < degrees; ++n)
        for (int m = 0; m <= n; ++m) modes += (m == 0 ? 1 : 2) * std::real(analysed(0, n, m) * std::conj(c(0, n, m)));
      EXPECT_NEAR(nodes, modes, 1e-13);
    }
}

TEST(SphericalHarmonics, FewerDegreesThanTheCoefficientsIsTheSharpFilter) {
  const SphereGrid grid(16);
  Coefficients c = random_coefficients(16, 3, 6);
  VectorField low(grid.size(), 3), truncated(grid.size(), 3);
  SphericalHarmonics(7, grid).synthesis(c, low);
  c.truncate(7);
  SphericalHarmonics(16, grid).synthesis(c, truncated);
  EXPECT_LT((low - truncated).abs().maxCoeff(), 1e-14);
  EXPECT_EQ(c.energy(7, 16), 0);
}

TEST(SphericalHarmonics, EnergyIsTheSquaredNorm) {
  const SphereGrid grid(20);
  const Coefficients c = random_coefficients(10, 1, 7);
  ScalarField values(grid.size());
  SphericalHarmonics(10, grid).synthesis(c, values);
  double norm = 0;
  for (int j = 0; j < 20; ++j)
    norm += grid.weight()[j] * grid.longitude_spacing() *
            values.segment(grid.index(0, j), grid.longitudes()).square().sum();
  EXPECT_NEAR(c.energy(0, 10), norm, 1e-12 * norm);
}

TEST(SphericalHarmonics, NoOverflowAtHighDegree) {
  const SphereGrid grid(16);
  Coefficients c(512, 1);
  c.set_zero();
  c(0, 511, 511) = 1;
  c(0, 511, 0) = 1;
  ScalarField values(grid.size());
  SphericalHarmonics(512, grid).synthesis(c, values);
  EXPECT_TRUE(values.isFinite().all());
  EXPECT_LT(values.abs().maxCoeff(), 20);
}

TEST(SphericalHarmonics, RefusesBadArguments) {
  const SphereGrid grid(8);
  EXPECT_THROW(SphericalHarmonics(0, grid), std::invalid_argument);
  const SphericalHarmonics harmonics(8, grid), fine(16, grid);
  Coefficients c;
  ScalarField wrong(7), right(grid.size());
  EXPECT_THROW(harmonics.analysis(wrong, c), std::invalid_argument);
  EXPECT_THROW(fine.analysis(right, c), std::logic_error);
  harmonics.analysis(right.setZero(), c);
  EXPECT_THROW(harmonics.synthesis(c, wrong), std::invalid_argument);
  EXPECT_THROW(fine.synthesis(c, right), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::vesicle::spherical_harmonics_test
