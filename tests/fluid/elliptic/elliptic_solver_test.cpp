// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What belongs to one backend, to the factory or to the problem.
#include "fluid/elliptic_solver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <limits>
#include <numbers>
#include <stdexcept>

#include "test_fields.h"
#include "thread_count.h"

namespace vesiflow::fluid::elliptic_solver_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Grid grid({0, 0, 0}, {1, 2, 3}, {12, 9, 15});

TEST(EllipticProblem, RefusesWhatMakesNoSenseAndSaysWhy) {
  EXPECT_THAT([] { EllipticProblem(grid, Centring::face_y, BoundaryCondition::neumann, 1.0, 1.0); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("neumann"), HasSubstr("face_y"))));
  EXPECT_THAT([] { EllipticProblem(grid, Centring::cell, BoundaryCondition::neumann, -0.5, 1.0); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("alpha is -0.5")));
  EXPECT_THAT([] { EllipticProblem(grid, Centring::cell, BoundaryCondition::neumann, 0.0, 0.0); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("mu is 0")));
}

// cos(pi m (i + 1/2) / N) in each direction is an eigenvector of the discrete operator, with sum (2 sin(pi m
// / 2N)/h)^2.
TEST(EllipticProblem, CosinesAreDiscreteEigenvectorsOfTheNeumannOperator) {
  const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0);
  const std::array<int, 3> mode{5, 2, 11};
  Field<Cell> x(grid);
  Field<Cell> y(grid);
  double eigenvalue = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double root = 2.0 * std::sin(0.5 * std::numbers::pi * mode[axis] / grid.cells[axis]) / grid.spacing(axis);
    eigenvalue += root * root;
  }
  test::for_each_point(x.extent(), [&](int i, int j, int k) {
    const std::array<int, 3> index{i, j, k};
    x(i, j, k) = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      x(i, j, k) *= std::cos(std::numbers::pi * mode[axis] * (index[axis] + 0.5) / grid.cells[axis]);
    }
  });
  apply(problem, x.points(), y.points());
  test::for_each_point(x.extent(),
                       [&](int i, int j, int k) { EXPECT_NEAR(y(i, j, k), eigenvalue * x(i, j, k), 1e-11); });
}

TEST(EllipticProblem, ResidualOfAWrongSolutionIsNotSmall) {
  const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::dirichlet, 1.0, 1.0);
  Field<Cell> rhs(grid);
  rhs.fill(2.0);
  const Field<Cell> zero(grid);
  EXPECT_DOUBLE_EQ(relative_residual(problem, rhs.points(), zero.points()), 1.0);
}

TEST(FftSolver, KeepsItsPlansWhenTheThreadCountIsRaised) {
  const Grid large({0, 0, 0}, {1, 2, 3}, {31, 27, 23});
  const EllipticProblem problem(large, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0);
  Field<Cell> rhs(large);
  test::fill_random(rhs.points(), 22);
  Field<Cell> x(large);
  std::unique_ptr<EllipticSolver> solver;
  {
    const test::ThreadCount one(1);
    solver = make_elliptic_solver(problem, FftOptions{});
  }
  const test::ThreadCount four(4);
  solver->solve(rhs.points(), x.points());
  EXPECT_LT(relative_residual(problem, rhs.points(), x.points()), 1e-13);
}

TEST(SolverNames, AreThoseOfTheirDefaultOptions) {
  EXPECT_EQ(name(default_options(SolverKind::automatic)), "auto");
  EXPECT_EQ(name(default_options(SolverKind::fft)), "fft");
  EXPECT_EQ(name(default_options(SolverKind::cholmod)), "cholmod");
  EXPECT_EQ(name(default_options(SolverKind::pcg)), "pcg+fft");
  EXPECT_EQ(name(PcgOptions{.preconditioner = CholmodOptions{}}), "pcg+cholmod");
  for (const SolverKind kind : {SolverKind::automatic, SolverKind::fft, SolverKind::cholmod, SolverKind::pcg})
    EXPECT_EQ(name(default_options(kind)).find(name(kind)), 0U) << name(kind);
}

#ifndef VESIFLOW_WITH_CHOLMOD
TEST(CholmodSolver, IsRefusedByABuildWithoutItNamingTheOption) {
  const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0);
  EXPECT_THAT([&] { make_elliptic_solver(problem, CholmodOptions{}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("VESIFLOW_WITH_CHOLMOD")));
}
#endif

Viscosity sphere(double ratio) {
  return Viscosity(sample_viscosity(grid, [ratio](const Vector3& r) { return r[2] < 1.0 ? ratio : 1.0; }));
}

TEST(ChooseSolver, TakesFastTransformsWhereTheyAreExact) {
  for (const EllipticProblem& problem : {EllipticProblem(grid, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0),
                                         EllipticProblem::velocity(grid, EllipticForm::laplacian, 1.0, 2.0)}) {
    const ChosenSolver choice = choose_solver(problem, {});
    EXPECT_TRUE(std::holds_alternative<FftOptions>(choice.options));
    EXPECT_THAT(choice.reason, HasSubstr("constant coefficients"));
    EXPECT_EQ(make_elliptic_solver(problem, AutoOptions{})->name(), "fft");
  }
}

TEST(ChooseSolver, TakesConjugateGradientsForModerateRatiosWithTheToleranceGiven) {
  const auto problem = EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, sphere(20.0));
  const ChosenSolver choice = choose_solver(problem, {.tolerance = 1e-6});
  const auto* pcg = std::get_if<PcgOptions>(&choice.options);
  ASSERT_NE(pcg, nullptr);
  EXPECT_EQ(pcg->tolerance, 1e-6);
  EXPECT_TRUE(std::holds_alternative<FftOptions>(pcg->preconditioner));
  EXPECT_THAT(choice.reason, AllOf(HasSubstr("4437 unknowns"), HasSubstr("ratio of viscosities 20"),
                                   HasSubstr("about 37 iterations")));
  EXPECT_EQ(estimate_solver_memory(problem, AutoOptions{}), estimate_solver_memory(problem, *pcg));
}

// A factorisation costs the same for every ratio; iterations do not.
TEST(ChooseSolver, TakesAFactorisationForAHugeRatioIfThisBuildHasItAndMemoryAllows) {
  const auto problem = EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, sphere(1e8));
  const bool factors = std::holds_alternative<CholmodOptions>(choose_solver(problem, {}).options);
  AutoOptions little_memory;
  little_memory.memory_limit = 1e5;
#ifdef VESIFLOW_WITH_CHOLMOD
  EXPECT_TRUE(factors);
#else
  EXPECT_FALSE(factors);
#endif
  EXPECT_TRUE(std::holds_alternative<PcgOptions>(choose_solver(problem, little_memory).options));
}

TEST(ChooseSolver, RefusesAFieldThatIsNotPositive) {
  const auto problem = EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, sphere(-1.0));
  EXPECT_THAT([&] { choose_solver(problem, {}); }, ThrowsMessage<std::invalid_argument>(HasSubstr("cell (0, 0, 0)")));
}

}  // namespace
}  // namespace vesiflow::fluid::elliptic_solver_test
