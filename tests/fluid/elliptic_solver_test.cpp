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

namespace vesiflow::fluid {
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

TEST(FftSolver, GivesTheSameBitsForEveryNumberOfThreads) {
  const EllipticProblem problem(grid, Centring::face_x, BoundaryCondition::dirichlet, 3.0, 1.0);
  Field<FaceX> rhs(grid);
  test::fill_random(rhs.unknowns(), 21);
  std::vector<Field<FaceX>> solutions;
  for (const int threads : {1, 2, 5}) {
    const test::ThreadCount count(threads);
    const auto solver = make_elliptic_solver(problem, FftOptions{});
    solver->solve(rhs.unknowns(), solutions.emplace_back(grid).unknowns());
  }
  EXPECT_TRUE(test::same_bits(solutions[0], solutions[1]));
  EXPECT_TRUE(test::same_bits(solutions[0], solutions[2]));
}

TEST(FftSolver, KeepsItsPlansWhenTheThreadCountIsRaised) {
  const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0);
  Field<Cell> rhs(grid);
  test::fill_random(rhs.points(), 22);
  Field<Cell> x(grid);
  std::unique_ptr<EllipticSolver> solver;
  {
    const test::ThreadCount one(1);
    solver = make_elliptic_solver(problem, FftOptions{});
  }
  const test::ThreadCount four(4);
  solver->solve(rhs.points(), x.points());
  EXPECT_LT(relative_residual(problem, rhs.points(), x.points()), 1e-13);
}

#ifdef VESIFLOW_WITH_CHOLMOD
TEST(CholmodSolver, AgreesWithTheFastTransforms) {
  for (const double alpha : {0.0, 10.0}) {
    const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::neumann, alpha, 2.0);
    Field<Cell> rhs(grid);
    test::fill_random(rhs.points(), 31);
    Field<Cell> x(grid);
    Field<Cell> y(grid);
    const SolveReport fft = make_elliptic_solver(problem, FftOptions{})->solve(rhs.points(), x.points());
    const SolveReport cholmod = make_elliptic_solver(problem, CholmodOptions{})->solve(rhs.points(), y.points());
    EXPECT_LT(test::max_difference(x.points(), y.points()), 1e-14);
    EXPECT_NEAR(fft.removed_mean[0], cholmod.removed_mean[0], 1e-15);
  }
}

TEST(CholmodSolver, RefusesProblemsThatAreTooLargeAndNamesTheAlternative) {
  const Grid large({0, 0, 0}, {1, 1, 1}, {128, 128, 128});
  const EllipticProblem problem(large, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0);
  EXPECT_THAT([&] { make_elliptic_solver(problem, CholmodOptions{}); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("2097152 unknowns"), HasSubstr("memory_limit"), HasSubstr("'fft'"))));
}
#else
TEST(CholmodSolver, IsRefusedByABuildWithoutItNamingTheOption) {
  const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0);
  EXPECT_THAT([&] { make_elliptic_solver(problem, CholmodOptions{}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("VESIFLOW_WITH_CHOLMOD")));
}
#endif

}  // namespace
}  // namespace vesiflow::fluid
