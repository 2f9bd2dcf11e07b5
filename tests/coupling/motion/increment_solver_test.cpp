// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/increment_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "motion/constants.h"
#include "motion/flat_coefficients.h"
#include "support/allocation_counter.h"

namespace vesiflow::coupling::increment_solver_test {
namespace {

constexpr int degrees = 10, latitudes = 16, fields = 4;

class IncrementSolverTest : public testing::Test {
 protected:
  IncrementSolverTest() : grid(latitudes), harmonics(degrees, grid, fields), diagonal(degrees) {
    for (std::size_t n = 0; n < diagonal.size(); ++n)
      diagonal[n] = {1.5 + 0.3 * static_cast<double>(n * n), 1.5 + 2.0 * static_cast<double>(n),
                     0.1 * static_cast<double>(n)};
    slip.theta.resize(grid.size());
    slip.phi.resize(grid.size());
    for (int j = 0; j < latitudes; ++j)
      for (int i = 0; i < grid.longitudes(); ++i) {
        slip.theta(grid.index(i, j)) = 0.3 * grid.sin_colatitude()[j];
        slip.phi(grid.index(i, j)) = 0.8;
      }
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    vesicle::Coefficients c(degrees, fields);
    for (int f = 0; f < fields; ++f)
      for (int n = 0; n < degrees; ++n)
        for (int m = 0; m <= n; ++m) c(f, n, m) = {uniform(generator), m > 0 ? uniform(generator) : 0.0};
    right_side = as_vector(c);
  }

  /// A_n x + dt (D_n + w.grad) x, in another way than the solver's.
  IncrementSolver::Vector apply(const IncrementSolver::Vector& x, double dt) const {
    vesicle::Coefficients c(degrees, fields), result(degrees, fields);
    as_vector(c) = x;
    Eigen::ArrayXXd theta(grid.size(), fields), phi(grid.size(), fields);
    harmonics.gradient(c, theta, phi);
    for (int f = 0; f < fields; ++f) theta.col(f) = dt * (slip.theta * theta.col(f) + slip.phi * phi.col(f));
    harmonics.analysis(theta, result);
    for (int f = 0; f < fields; ++f)
      for (int n = 0; n < degrees; ++n)
        for (int m = 0; m <= n; ++m) {
          const auto& d = diagonal[static_cast<std::size_t>(n)];
          result(f, n, m) += ((f < 3 ? d.position : d.strain) + dt * d.damping) * c(f, n, m);
        }
    return as_vector(result);
  }

  vesicle::SphereGrid grid;
  vesicle::SphericalHarmonics harmonics;
  std::vector<IncrementSolver::Diagonal> diagonal;
  Slip slip;
  IncrementSolver::Vector right_side;
};

TEST_F(IncrementSolverTest, SolvesItsEquation) {
  IncrementSolver solver(harmonics, fields, 1.0);
  for (const double dt : {0.1, 0.5}) {
    const IncrementSolver::Vector x = solver.solve(diagonal, dt, slip, right_side);
    EXPECT_LT((apply(x, dt) - right_side).norm(), 30.0 * constants::slip_tolerance * right_side.norm()) << dt;
  }
}

TEST_F(IncrementSolverTest, WithoutSlipEachDegreeIsItsOwn) {
  IncrementSolver solver(harmonics, fields, 1.0);
  slip.theta.setZero();
  slip.phi.setZero();
  const IncrementSolver::Vector x = solver.solve(diagonal, 0.1, slip, right_side);
  EXPECT_LT((apply(x, 0.1) - right_side).cwiseAbs().maxCoeff(), 1e-13);
}

// Positions in another unit are the same ones.
TEST_F(IncrementSolverTest, DoesNotDependOnTheUnitOfLength) {
  const double unit = 64.0;
  vesicle::Coefficients factors(degrees, fields);
  for_each_coefficient(factors, [&](auto& value, int f, int) { value = {f < 3 ? unit : 1.0, f < 3 ? unit : 1.0}; });
  const IncrementSolver::Vector scale = as_vector(factors);
  IncrementSolver small(harmonics, fields, 1.0), large(harmonics, fields, unit);
  const IncrementSolver::Vector x = small.solve(diagonal, 0.3, slip, right_side);
  const IncrementSolver::Vector y = large.solve(diagonal, 0.3, slip, right_side.cwiseProduct(scale));
  EXPECT_TRUE((y.array() == x.cwiseProduct(scale).array()).all());
}

TEST_F(IncrementSolverTest, SaysWhereTheSlipIsTooMuch) {
  IncrementSolver solver(harmonics, fields, 1.0);
  for (auto& d : diagonal) d.damping = 0.0;
  EXPECT_THROW(solver.solve(diagonal, 1e4, slip, right_side), std::domain_error);
  EXPECT_NO_THROW(solver.solve(diagonal, 0.1, slip, right_side));
}

// A mesh that turns at the rate 1 sweeps order m by at i m. Where nothing is stiff, A = 3/2, GMRES has the spectrum 1 + i c, |c| <= 2/3 dt m, and its
// residual is (c/(1 + sqrt(1 + c^2)))^k after k iterations to a factor of two (motion/constants.h): a step that sweeps the shortest waves over one of
// their lengths, dt m = 2 pi, is solved to the tolerance, over two passably, over four not.
TEST(IncrementSolver, SolvesStepsThatSweepTheShortestWavesOverTheirLength) {
  constexpr int many = 48;
  const vesicle::SphereGrid grid(64);
  const vesicle::SphericalHarmonics harmonics(many, grid, 3);
  const std::vector<IncrementSolver::Diagonal> diagonal(many, {1.5, 1.5, 0.0});
  const Slip turning{vesicle::ScalarField::Zero(grid.size()), vesicle::ScalarField::Ones(grid.size())};
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  vesicle::Coefficients right(many, 3), result(many, 3);
  for_each_coefficient(right, [&](auto& value, int, int) { value = {uniform(generator), uniform(generator)}; });
  for (int f = 0; f < 3; ++f)
    for (int n = 0; n < many; ++n) right(f, n, 0) = right(f, n, 0).real();
  const IncrementSolver::Vector right_side = as_vector(right);
  IncrementSolver solver(harmonics, 3, 1.0);
  const auto residual = [&](double lengths) {
    const double dt = 2.0 * std::numbers::pi * lengths / (many - 1);
    as_vector(result) = solver.solve(diagonal, dt, turning, right_side);
    for (int f = 0; f < 3; ++f)
      for (int n = 0; n < many; ++n)
        for (int m = 0; m <= n; ++m) result(f, n, m) *= std::complex<double>(1.5, dt * m);
    return (as_vector(result) - right_side).norm() / right_side.norm();
  };
  EXPECT_LT(residual(0.1), constants::slip_tolerance);
  EXPECT_LT(residual(1.0), constants::slip_tolerance);
  EXPECT_LT(residual(2.0), constants::worst_slip_residual);
  EXPECT_THROW(residual(4.0), std::domain_error);
}

TEST_F(IncrementSolverTest, ASecondSolveAllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  IncrementSolver solver(harmonics, fields, 1.0);
  solver.solve(diagonal, 0.1, slip, right_side);
  const long before = test::allocation_count();
  solver.solve(diagonal, 0.2, slip, right_side);
  EXPECT_EQ(test::allocation_count() - before, 0);
}

}  // namespace
}  // namespace vesiflow::coupling::increment_solver_test
