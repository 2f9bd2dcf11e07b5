// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The "pcg" backend: numbers of iterations, reports, starting vectors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "fluid/elliptic_solver.h"
#include "support/allocation_counter.h"
#include "test_problems.h"
#include "thread_count.h"

namespace vesiflow::fluid::pcg_solver_test {
namespace {

using test::Numbers;
using testing::HasSubstr;
using testing::ThrowsMessage;

Grid box(int cells) {
  return {{-3, -3, -3}, {3, 3, 3}, {cells, cells, cells}};
}

int iterations(const EllipticProblem& problem, const PcgOptions& options = {}) {
  const auto solver = make_elliptic_solver(problem, options);
  const Numbers rhs(problem, 61);
  const Numbers x(problem);
  const SolveReport report = solver->solve(rhs, x);
  EXPECT_TRUE(report.converged);
  return report.iterations;
}

// With u = 0 on all walls the energies of the stress form are between once and twice those of the laplacian form, and so
// is the spectrum. Half of it is at 1 exactly (divergence-free u), and the rest near 2: a dozen iterations.
TEST(PcgSolver, TakesADozenIterationsForTheStressFormOfAConstantViscosity) {
  for (const int cells : {16, 32}) {
    EXPECT_LE(iterations(EllipticProblem::velocity(box(cells), EllipticForm::stress, 0.0, 2.0)), 13) << cells;
  }
}

TEST(PcgSolver, TakesOneIterationWhereThePreconditionerIsExact) {
  EXPECT_EQ(iterations(EllipticProblem::velocity(box(12), EllipticForm::laplacian, 2.0, 3.0)), 1);
}

// A smooth sphere with an interface two cells or one cell thick: the number of iterations does not depend on the number of
// cells, and grows less than the square root of the ratio. Measured 16 25 41 and 25 40 63 (laplacian, stress).
struct Pin {
  double ratio;
  int laplacian, stress;
};
class PcgIterations : public testing::TestWithParam<Pin> {};

TEST_P(PcgIterations, DependOnTheRatioOfViscositiesAndNotOnTheGrid) {
  const auto& [ratio, laplacian, stress] = GetParam();
  for (const double interface : {2.0, 1.0}) {
    for (const EllipticForm form : {EllipticForm::laplacian, EllipticForm::stress}) {
      const int most = form == EllipticForm::stress ? stress : laplacian;
      for (const int cells : {16, 32, 48}) {
        if (cells == 48 && (interface == 2.0 || form == EllipticForm::laplacian)) continue;
        for (const double alpha : {0.0, 1000.0}) {
          if (cells == 48 && alpha > 0.0) continue;
          const Viscosity mu(test::sphere_viscosity(box(cells), ratio, interface));
          EXPECT_LE(iterations(EllipticProblem::velocity(box(cells), form, alpha, mu)), most)
              << name(form) << ' ' << cells << " cells, interface " << interface << ", alpha " << alpha;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ratios, PcgIterations, testing::Values(Pin{5, 17, 27}, Pin{20, 27, 43}, Pin{100, 44, 68}),
                         [](const auto& pin) { return std::to_string(static_cast<int>(pin.param.ratio)); });

TEST(PcgSolver, ReportsThatItHasNotConverged) {
  const EllipticProblem problem(box(12), Centring::cell, BoundaryCondition::dirichlet, 0.0,
                                Viscosity(test::sphere_viscosity(box(12), 20.0, 1.0)));
  PcgOptions options;
  options.max_iterations = 3;
  const Numbers rhs(problem, 62);
  const Numbers x(problem);
  const SolveReport report = make_elliptic_solver(problem, options)->solve(rhs, x);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 3);
  EXPECT_GT(*report.residual, options.tolerance);
}

// |b - A x| / |b|, from the solution itself.
TEST(PcgSolver, ReportsTheResidualOfTheSolution) {
  const EllipticProblem problem(box(12), Centring::face_y, BoundaryCondition::dirichlet, 1.0,
                                Viscosity(test::sphere_viscosity(box(12), 20.0, 1.0)));
  PcgOptions options;
  options.tolerance = 1e-4;
  const Numbers rhs(problem, 63);
  const Numbers x(problem);
  const Numbers ax(problem);
  const SolveReport report = make_elliptic_solver(problem, options)->solve(rhs, x);
  apply(problem, x, ax);
  double sum = 0.0;
  test::for_each_point(problem.extent(),
                       [&](int i, int j, int k) { sum += std::pow(rhs.block(0)(i, j, k) - ax.block(0)(i, j, k), 2); });
  EXPECT_NEAR(*report.residual, std::sqrt(sum) / rhs.norm(), 1e-12);
  EXPECT_LE(*report.residual, 1e-4);
}

TEST(PcgSolver, AGoodStartSavesIterations) {
  const EllipticProblem problem = EllipticProblem::velocity(box(16), EllipticForm::stress, 1.0,
                                                            Viscosity(test::sphere_viscosity(box(16), 20.0, 1.0)));
  const auto solver = make_elliptic_solver(problem, PcgOptions{});
  const Numbers rhs(problem, 64);
  const Numbers x(problem);
  const int from_zero = solver->solve(rhs, x).iterations;
  const Numbers change(problem, 65);
  for (int block = 0; block < 3; ++block) {
    test::for_each_point(problem.extent(block), [&](int i, int j, int k) {
      rhs.block(block)(i, j, k) += 1e-6 * change.block(block)(i, j, k);
    });
  }
  EXPECT_LT(solver->solve(rhs, x).iterations, from_zero / 2);
}

TEST(PcgSolver, ZeroRightHandSideHasTheSolutionZero) {
  const EllipticProblem problem(box(8), Centring::cell, BoundaryCondition::neumann, 0.0,
                                Viscosity(test::sphere_viscosity(box(8), 5.0, 1.0)));
  const Numbers x(problem);
  const SolveReport report = make_elliptic_solver(problem, PcgOptions{})->solve(x, x);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(x.norm(), 0.0);
}

TEST(PcgSolver, DoesNotAllocateInASolve) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const test::ThreadCount two(2);  // with one the OpenMP library itself allocates a team for every loop
  const EllipticProblem problem = EllipticProblem::velocity(box(12), EllipticForm::stress, 1.0,
                                                            Viscosity(test::sphere_viscosity(box(12), 20.0, 1.0)));
  const auto solver = make_elliptic_solver(problem, PcgOptions{});
  const Numbers rhs(problem, 66);
  const Numbers x(problem);
  solver->solve(rhs, rhs);
  const long before = vesiflow::test::allocation_count();
  solver->solve(rhs, x);
  EXPECT_EQ(vesiflow::test::allocation_count() - before, 0);
}

TEST(PcgSolver, RefusesOptionsOutOfRange) {
  const EllipticProblem problem(box(8), Centring::cell, BoundaryCondition::neumann, 0.0, 1.0);
  const auto refused = [&](auto&& change, const char* what) {
    PcgOptions options;
    change(options);
    EXPECT_THAT([&] { make_elliptic_solver(problem, options); }, ThrowsMessage<std::invalid_argument>(HasSubstr(what)));
  };
  refused([](PcgOptions& o) { o.tolerance = 0.0; }, "tolerance of 'pcg' is 0");
  refused([](PcgOptions& o) { o.tolerance = 1.0; }, "tolerance of 'pcg' is 1");
  refused([](PcgOptions& o) { o.max_iterations = 0; }, "max_iterations of 'pcg' is 0");
  refused([](PcgOptions& o) { o.reference_viscosity = -1.0; }, "reference_viscosity of 'pcg' is -1");
}

}  // namespace
}  // namespace vesiflow::fluid::pcg_solver_test
