// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Stokes flow with a divergence that is given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "flow_with_divergence.h"
#include "fluid/elliptic_problem.h"
#include "fluid/operators.h"
#include "fluid/stokes.h"
#include "manufactured_flow.h"
#include "support/allocation_counter.h"
#include "thread_count.h"

namespace vesiflow::fluid::stokes_divergence_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr AxisEnds channel{.periodic = {true, true, false}};
constexpr AxisEnds all_periodic{.periodic = {true, true, true}};
constexpr AxisEnds all_ends[] = {{}, channel, {.periodic = {false, true, false}}, all_periodic};

Grid unequal(const AxisEnds& ends) {
  return {{-1, 0, 0}, {1, 3, 1}, {11, 8, 13}, ends};
}

WallVelocity resting_walls(const Grid& grid) {
  return {grid, [](const Vector3&, double) { return Vector3{}; }};
}

Viscosity wavy(const Grid& grid) {
  return {sample_viscosity(grid, [](const Vector3& r) { return 1.5 + std::sin(2 * r[0] + r[1] - r[2]); })};
}

double mean(ConstView a) {
  double sum = 0.0;
  test::for_each_point(a.extent, [&](int i, int j, int k) { sum += a(i, j, k); });
  return sum / (static_cast<double>(a.extent[0]) * a.extent[1] * a.extent[2]);
}

void subtract_mean(Field<Cell>& field) {
  const double whole = mean(field.points());
  test::for_each_point(field.extent(), [&](int i, int j, int k) { field(i, j, k) -= whole; });
}

Field<Cell> random_source(const Grid& grid, unsigned seed) {
  Field<Cell> source(grid);
  test::fill_random(source.points(), seed);
  subtract_mean(source);
  return source;
}

struct Solution {
  explicit Solution(const Grid& grid) : u(grid), p(grid) {}
  FaceVector u;
  Field<Cell> p;
  StokesReport report;
};

Solution solve(const Viscosity& mu, const FaceVector& force, const WallVelocity& walls, const Field<Cell>* source,
               double tolerance = 1e-8) {
  const Grid& grid = force.grid();
  StokesSolver solver(grid, {.tolerance = tolerance});
  solver.update(mu);
  Solution solution(grid);
  solution.report = solver.solve(force, walls, solution.u, solution.p, {}, source);
  return solution;
}

// Independently of the solver's own report, with the public operators, for walls at rest and the roughest source there is.
// Of a number the viscous term is the Laplacian, of a field the stress: with a divergence the two differ.
TEST(StokesDivergence, SolutionSatisfiesTheDiscreteEquations) {
  for (const AxisEnds& ends : all_ends) {
    const Grid grid = unequal(ends);
    const Field<Cell> source = random_source(grid, 3);
    const FaceVector force = test::random_velocity(grid, 5);
    for (const Viscosity& mu : {Viscosity(0.7), wavy(grid)}) {
      const Solution solution = solve(mu, force, resting_walls(grid), &source, 1e-10);
      EXPECT_TRUE(solution.report.converged);
      EXPECT_LT(max_divergence(solution.u, &source), 2e-13);
      EXPECT_GT(max_divergence(solution.u), 0.9);  // the source itself
      EXPECT_EQ(solution.report.divergence, max_divergence(solution.u, &source));

      const EllipticForm form = mu.is_constant() ? EllipticForm::laplacian : EllipticForm::stress;
      FaceVector viscous(grid), slope(grid);
      apply(EllipticProblem::velocity(grid, form, 0.0, mu), solution.u.unknowns(), viscous.unknowns());
      Field<Cell> p = solution.p.clone();
      extend_to_ghosts(p);
      gradient(p, slope);
      double residual = 0.0, size = 0.0;
      for (int c = 0; c < 3; ++c) {
        const ConstView f = force.unknowns()[c];
        const double removed = grid.has_walls() ? 0.0 : mean(f);
        test::for_each_point(f.extent, [&](int i, int j, int k) {
          residual += std::pow(f(i, j, k) - removed - viscous.unknowns()[c](i, j, k) - slope.unknowns()[c](i, j, k), 2);
          size += std::pow(f(i, j, k) - removed, 2);
        });
      }
      EXPECT_LT(std::sqrt(residual / size), 1e-7);
      EXPECT_NEAR(mean(solution.p.points()), 0.0, 1e-13);
    }
  }
}

// The same velocity; the stress has mu grad div u beside the Laplacian, which a pressure that is higher by mu div u takes up.
TEST(StokesDivergence, ANumberAndAFieldOfViscosityAgree) {
  const Grid grid = unequal({.periodic = {false, false, true}});
  const WallVelocity walls(grid, [](const Vector3& r, double) { return Vector3{r[1], std::sin(2 * r[0]), 0}; });
  const FaceVector force = test::random_velocity(grid, 8);
  const Field<Cell> source = random_source(grid, 9);
  const Viscosity three(sample_viscosity(grid, [](const Vector3&) { return 3.0; }));
  const Solution number = solve(3.0, force, walls, &source, 1e-11), field = solve(three, force, walls, &source, 1e-11);
  EXPECT_LT(test::max_difference(number.u, field.u), 1e-9);
  double error = 0.0;
  test::for_each_point(source.extent(), [&](int i, int j, int k) {
    error = std::max(error, std::abs(field.p(i, j, k) - number.p(i, j, k) - 3.0 * source(i, j, k)));
  });
  EXPECT_LT(error, 1e-7);
}

// A flow along x alone, which the pressure balances whatever it is: the divergence says the velocity by itself.
TEST(StokesDivergence, LayersThatSwellAndShrinkPushWhatIsBetweenThem) {
  const Grid grid({-1, -1, -1}, {1, 1, 1}, {8, 9, 10}, {.periodic = {false, true, true}});
  const WallVelocity walls(grid, [](const Vector3&, double) { return Vector3{0.5, 0, 0}; });
  Field<Cell> source(grid);
  test::for_each_point(source.extent(), [&](int i, int j, int k) {
    source(i, j, k) = (i == 2 ? 0.3 : i == 4 ? -0.3 : 0.0) / grid.spacing(0);
  });
  const Solution solution = solve(2.0, FaceVector(grid), walls, &source, 1e-12);
  test::for_each_point(solution.u.x.extent(), [&](int i, int j, int k) {
    EXPECT_NEAR(solution.u.x(i, j, k), i == 3 || i == 4 ? 0.8 : 0.5, 1e-11);
  });
  EXPECT_LT(test::max_abs(solution.u.y.points()), 1e-11);
}

struct Errors {
  double velocity, pressure;
};

Errors manufactured_errors(const AxisEnds& ends, bool is_field, int cells) {
  const test::FlowWithDivergence flow;
  const Grid grid({-1, -1, -1}, {1, 1, 1}, {cells, cells, cells}, ends);
  constexpr double t = 0.2;
  const WallVelocity walls(grid, [&](const Vector3& r, double) { return flow.velocity(r, t); });
  FaceVector force(grid);
  test::sample_faces(force,
                     [&](const Vector3& r) { return is_field ? flow.stress_force(r, t) : flow.stokes_force(r, t); });
  const Field<Cell> source = test::sample_pressure(grid, [&](const Vector3& r) { return flow.divergence(r, t); });
  const Viscosity mu = is_field ? Viscosity(sample_viscosity(grid, [&](const Vector3& r) { return flow.viscosity(r); }))
                                : Viscosity(1.0);
  const Solution solution = solve(mu, force, walls, &source);
  EXPECT_TRUE(solution.report.converged);
  EXPECT_LT(max_divergence(solution.u, &source), 1e-11);
  const test::FlowErrors errors = test::flow_errors(solution.u, solution.p, flow, t);
  return {errors.velocity_l2, errors.pressure_l2};
}

TEST(StokesDivergence, AManufacturedFlowIsOfSecondOrder) {
  for (const AxisEnds& ends : {AxisEnds{}, channel, all_periodic})
    for (const bool is_field : {false, true}) {
      const Errors coarse = manufactured_errors(ends, is_field, 16), fine = manufactured_errors(ends, is_field, 24);
      EXPECT_NEAR(test::slope(coarse.velocity, 16, fine.velocity, 24), 2.0, 0.15) << is_field;
      EXPECT_GT(test::slope(coarse.pressure, 16, fine.pressure, 24), 1.5) << is_field;
    }
}

TEST(StokesDivergence, ASourceOfZerosIsNone) {
  for (const AxisEnds& ends : {AxisEnds{}, all_periodic}) {
    const Grid grid = unequal(ends);
    const Field<Cell> zeros(grid);
    const FaceVector force = test::random_velocity(grid, 5);
    for (const Viscosity& mu : {Viscosity(0.7), wavy(grid)}) {
      const Solution with = solve(mu, force, resting_walls(grid), &zeros);
      const Solution without = solve(mu, force, resting_walls(grid), nullptr);
      EXPECT_TRUE(test::same_bits(with.u, without.u));
      EXPECT_TRUE(test::same_bits(with.p, without.p));
    }
  }
}

// The flow of a source alone, on top of what force and walls make.
TEST(StokesDivergence, SolutionsSuperpose) {
  for (const AxisEnds& ends : {AxisEnds{}, all_periodic}) {
    const Grid grid = unequal(ends);
    const Field<Cell> source = random_source(grid, 3);
    const FaceVector force = test::random_velocity(grid, 5), nothing(grid);
    const Solution both = solve(0.7, force, resting_walls(grid), &source, 1e-11);
    const Solution driven = solve(0.7, force, resting_walls(grid), nullptr, 1e-11);
    Solution sum = solve(0.7, nothing, resting_walls(grid), &source, 1e-11);
    EXPECT_GT(test::max_abs(sum.u.x.points()), 0.01);
    for (int c = 0; c < 3; ++c) {
      const View u = sum.u.points()[c];
      test::for_each_point(u.extent, [&](int i, int j, int k) { u(i, j, k) += driven.u.points()[c](i, j, k); });
    }
    EXPECT_LT(test::max_difference(both.u, sum.u), 1e-9);
  }
}

TEST(StokesDivergence, SameBitsForAnyNumberOfThreads) {
  const Grid grid({0, 0, 0}, {1, 1, 1}, {27, 28, 29}, {.periodic = {false, true, false}});
  const FaceVector force = test::random_velocity(grid, 31);
  const Field<Cell> source = random_source(grid, 32);
  for (const Viscosity& mu : {Viscosity(2.0), wavy(grid)}) {
    std::vector<Solution> solutions;
    for (const int threads : {1, 3}) {
      const test::ThreadCount count(threads);
      solutions.push_back(solve(mu, force, resting_walls(grid), &source));
    }
    EXPECT_TRUE(test::same_bits(solutions[0].u, solutions[1].u));
    EXPECT_TRUE(test::same_bits(solutions[0].p, solutions[1].p));
  }
}

TEST(StokesDivergence, SolveAllocatesNothing) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const test::ThreadCount two(2);  // with one the OpenMP library itself allocates a team for every loop
  const Grid grid({0, 0, 0}, {1, 1, 1}, {12, 13, 14}, {.periodic = {false, true, false}});
  const FaceVector force = test::random_velocity(grid, 31);
  const Field<Cell> source = random_source(grid, 32);
  const WallVelocity walls = resting_walls(grid);
  for (const Viscosity& mu : {Viscosity(2.0), wavy(grid)}) {
    StokesSolver solver(grid);
    solver.update(mu);
    Solution solution(grid);
    solver.solve(force, walls, solution.u, solution.p);  // threads start
    const long before = vesiflow::test::allocation_count();
    solver.solve(force, walls, solution.u, solution.p, {}, &source);
    EXPECT_EQ(vesiflow::test::allocation_count() - before, 0);
  }
}

TEST(StokesDivergence, RefusesASourceThatCannotBe) {
  const Grid grid({0, 0, 0}, {1, 1, 1}, {8, 8, 8}), other({0, 0, 0}, {1, 1, 1}, {8, 8, 9});
  const WallVelocity walls = resting_walls(grid);
  StokesSolver solver(grid);
  Solution s(grid);
  const FaceVector force(grid);
  const Field<Cell> elsewhere(other);
  EXPECT_THAT([&] { solver.solve(force, walls, s.u, s.p, {}, &elsewhere); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("source"), HasSubstr("another grid"))));
  EXPECT_THAT([&] { max_divergence(s.u, &elsewhere); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("source"), HasSubstr("another grid"))));
  Field<Cell> broken(grid);
  broken(3, 3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(max_divergence(s.u, &broken), std::numeric_limits<double>::infinity());
  for (const Viscosity& mu : {Viscosity(1.0), wavy(grid)}) {
    solver.update(mu);
    EXPECT_THROW(solver.solve(force, walls, s.u, s.p, {}, &broken), std::runtime_error);
  }
}

}  // namespace
}  // namespace vesiflow::fluid::stokes_divergence_test
