// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/duct_series.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace vesiflow::fluid::duct_series_test {
namespace {

struct Point {
  double y, z, u;
};

// Values of the series summed to i = 2999 in 30 digits, by an independent program.
constexpr std::array<Point, 6> square{{{1, 0, 0.9038279457844461},
                                       {1, 1, 0.8191233138535431},
                                       {1.5, 0.5, 0.7609848562873573},
                                       {2, 2, 0.3702925515862563},
                                       {2.5, 1, 0.31034575794652347},
                                       {2.9, 0, 0.07452041090432722}}};
constexpr std::array<Point, 3> rectangle{
    {{1, 0, 0.9108478338721038}, {0, 1, 0.8532382467215989}, {1, 1, 0.7801273418015148}}};

TEST(DuctSeries, AgreesWithIndependentSums) {
  // They stop at i = 2999. What that leaves differs by 6e-10 between their two forms at (2.9, 0), less elsewhere; in the
  // alternating sum on the axis it is less than the next term, 1 / 3001^3.
  const DuctSeries in_square(3, 3), in_rectangle(3, 2.5);
  for (const Point& p : square) EXPECT_NEAR(in_square.velocity(p.y, p.z), p.u, 1e-9) << p.y << ' ' << p.z;
  for (const Point& p : rectangle) EXPECT_NEAR(in_rectangle.velocity(p.y, p.z), p.u, 1e-9) << p.y << ' ' << p.z;
  EXPECT_NEAR(in_square.pressure_gradient(), 0.37704991888141093, 0.377 / 0.571 / std::pow(3001, 3));
}

TEST(DuctSeries, IsTheSameWithItsAxesExchangedAndHasItsSymmetries) {
  const DuctSeries series(3, 2.5), exchanged(2.5, 3);
  for (const Point& p : square) {
    const double z = 2.5 / 3 * p.z;
    EXPECT_NEAR(series.velocity(p.y, z), exchanged.velocity(z, p.y), 1e-14);
    EXPECT_EQ(series.velocity(p.y, z), series.velocity(-p.y, -z));
  }
  EXPECT_EQ(series.velocity(0, 0), 1);
  for (const double t : {-3.0, -1.0, 0.0, 2.0}) {
    EXPECT_EQ(series.velocity(3, t / 3 * 2.5), 0);
    EXPECT_EQ(series.velocity(t, -2.5), 0);
  }
}

// Fourth-order differences: an error of h^4 u^(6) / 90 and rounding of 1e-15 / h^2.
TEST(DuctSeries, SolvesThePoissonEquation) {
  const DuctSeries series(3, 2.5);
  const double h = 0.01;
  const auto second = [h](auto&& f) {
    return (-f(-2 * h) + 16 * f(-h) - 30 * f(0) + 16 * f(h) - f(2 * h)) / (12 * h * h);
  };
  for (const auto& point : {std::array{0.3, 0.2}, {2.0, -1.0}, {-1.0, 2.2}, {2.8, 2.3}}) {
    const double y = point[0], z = point[1];  // clang 14 captures no structured bindings
    const double laplacian = second([&](double t) { return series.velocity(y + t, z); }) +
                             second([&](double t) { return series.velocity(y, z + t); });
    EXPECT_NEAR(-laplacian / series.pressure_gradient(), 1, 1e-7) << y << ' ' << z;
  }
}

// A very flat duct is a plane channel: u = 1 - z^2 / e^2 and a pressure gradient of 2 / e^2.
TEST(DuctSeries, IsAParabolaInAFlatDuct) {
  const DuctSeries series(40, 1);
  for (const double z : {0.0, 0.3, 0.9}) EXPECT_NEAR(series.velocity(5, z), 1 - z * z, 1e-14);
  EXPECT_NEAR(series.pressure_gradient(), 2, 1e-14);
}

TEST(DuctSeries, RefusesImpossibleWidths) {
  EXPECT_THROW(DuctSeries(0, 1), std::invalid_argument);
  EXPECT_THROW(DuctSeries(1, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::fluid::duct_series_test
