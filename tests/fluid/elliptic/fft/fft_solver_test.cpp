// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The "fft" backend: every combination of walls, periodic axes and mirrors, both kinds of transforms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <tuple>
#include <vector>

#include "fluid/elliptic_solver.h"
#include "support/allocation_counter.h"
#include "test_problems.h"
#include "thread_count.h"

namespace vesiflow::fluid::fft_solver_test {
namespace {

using Transforms = FftOptions::Transforms;

struct Unknowns {
  Centring centring;
  BoundaryCondition boundary;
};

const Unknowns all_unknowns[] = {{Centring::cell, BoundaryCondition::neumann},
                                 {Centring::cell, BoundaryCondition::dirichlet},
                                 {Centring::face_x, BoundaryCondition::dirichlet},
                                 {Centring::face_y, BoundaryCondition::dirichlet},
                                 {Centring::face_z, BoundaryCondition::dirichlet}};

// Smallest, even, odd, prime and unequal, with unequal mesh widths and flat boxes.
const Grid shapes[] = {Grid({0, 0, 0}, {1, 1, 1}, {4, 4, 4}),     Grid({0, 0, 0}, {1, 2, 1}, {5, 4, 5}),
                       Grid({-1, 0, 0}, {1, 3, 1}, {16, 12, 16}), Grid({0, 0, 0}, {1, 2, 3}, {7, 13, 11}),
                       Grid({0, 0, -1}, {4, 1, 1}, {24, 5, 4}),   Grid({0, 0, 0}, {1, 1, 2}, {9, 15, 23}),
                       Grid({0, 0, 0}, {50, 40, 0.5}, {8, 6, 10})};

// Numbers of one block, without padding.
struct Numbers {
  explicit Numbers(const EllipticProblem& problem, unsigned seed = 0) : values(problem.unknowns()) {
    const auto n = problem.extent();
    view = {values.data(), n, n[0], static_cast<std::ptrdiff_t>(n[0]) * n[1]};
    if (seed > 0) test::fill_random(view, seed);
  }
  void subtract_mean() {
    double sum = 0.0;
    for (const double v : values) sum += v;
    for (double& v : values) v -= sum / static_cast<double>(values.size());
  }
  std::vector<double> values;
  View view;
};

using Case = std::tuple<test::Topology, Unknowns, double>;  // unknowns, alpha

class FftSolverOf : public testing::TestWithParam<Case> {
 protected:
  static constexpr double mu = 0.75;
  EllipticProblem problem(const Grid& shape) const {
    const auto& [topology, unknowns, alpha] = GetParam();
    const Grid grid = test::with_topology(shape, topology);
    return {grid, unknowns.centring, unknowns.boundary, alpha, mu};
  }
  // Bound of the largest eigenvalue: that times the rounding of x is what a residual must be allowed.
  static double norm(const EllipticProblem& problem) {
    double sum = problem.alpha;
    for (int axis = 0; axis < 3; ++axis) sum += 4.0 * mu / std::pow(problem.grid.spacing(axis), 2);
    return sum;
  }
};

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST_P(FftSolverOf, RandomRightHandSideHasAResidualOfRoundOff) {
  for (const Transforms transforms : {Transforms::pairs_of_lines, Transforms::fftw_r2r}) {
    for (const Grid& shape : shapes) {
      const EllipticProblem p = problem(shape);
      const auto solver = make_elliptic_solver(p, FftOptions{transforms});
      const Numbers rhs(p, 21);
      const Numbers x(p);
      solver->solve(rhs.view, x.view);
      const double bound = epsilon * (norm(p) * test::max_abs(x.view) / test::max_abs(rhs.view) + 10.0);
      EXPECT_LT(relative_residual(p, rhs.view, x.view), 4.0 * bound) << p.grid.cells[0] << " x " << p.grid.cells[1];
    }
  }
}

TEST_P(FftSolverOf, AgreesWithFftwsTransforms) {
  for (const Grid& shape : shapes) {
    const EllipticProblem p = problem(shape);
    const Numbers rhs(p, 22);
    const Numbers x(p);
    const Numbers y(p);
    const double mean = make_elliptic_solver(p, FftOptions{})->solve(rhs.view, x.view).removed_mean[0];
    const double reference_mean =
        make_elliptic_solver(p, FftOptions{Transforms::fftw_r2r})->solve(rhs.view, y.view).removed_mean[0];
    EXPECT_NEAR(mean, reference_mean, 4 * epsilon);
    EXPECT_EQ(p.has_nullspace(), mean != 0.0);
    EXPECT_LT(test::max_difference(x.view, y.view), 100 * epsilon * test::max_abs(y.view)) << p.grid.cells[0];
  }
}

// Whether x is even at the lower and odd at the upper end.
bool has_mixed_ends(const EllipticProblem& p, int axis) {
  return p.grid.mirror[axis] && p.boundary == BoundaryCondition::dirichlet && !is_face_normal(p.centring(), axis);
}

// Of wave number m along the axis. Between walls sines and cosines of half waves, on periodic axes of whole ones; between
// a mirror and a wall an odd number of quarters.
double eigenvector(const EllipticProblem& p, int axis, int index, int m) {
  const double position = (is_face_normal(p.centring(), axis) ? index + 1.0 : index + 0.5) / p.grid.cells[axis];
  if (p.grid.periodic[axis]) return std::cos(2 * std::numbers::pi * m * position + 0.3);
  if (has_mixed_ends(p, axis)) return std::cos(std::numbers::pi * (m - 0.5) * position);
  return p.boundary == BoundaryCondition::neumann ? std::cos(std::numbers::pi * m * position)
                                                  : std::sin(std::numbers::pi * m * position);
}

double eigenvalue(const EllipticProblem& p, int axis, int m) {
  const double waves = p.grid.periodic[axis] ? m : has_mixed_ends(p, axis) ? 0.5 * (m - 0.5) : 0.5 * m;
  const double half = std::numbers::pi * waves / p.grid.cells[axis];
  return std::pow(2 * std::sin(half) / p.grid.spacing(axis), 2);
}

// The smallest that is not zero.
double smallest_eigenvalue(const EllipticProblem& p) {
  double all = p.alpha;
  double next = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double first = p.mu.value() * eigenvalue(p, axis, 1);
    const bool constant = p.grid.periodic[axis] || p.boundary == BoundaryCondition::neumann;
    all += constant ? 0.0 : first;
    next = std::min(next, first);
  }
  return all > 0.0 ? all : next;
}

TEST_P(FftSolverOf, EigenvectorsAreDividedByTheirEigenvalues) {
  for (const Grid& shape : shapes) {
    const EllipticProblem p = problem(shape);
    const auto solver = make_elliptic_solver(p, FftOptions{});
    for (const auto& m : {std::array{1, 1, 1}, {2, 1, 2}, {1, 2, 1}}) {
      const Numbers vector(p);
      const Numbers x(p);
      test::for_each_point(p.extent(), [&](int i, int j, int k) {
        vector.view(i, j, k) = eigenvector(p, 0, i, m[0]) * eigenvector(p, 1, j, m[1]) * eigenvector(p, 2, k, m[2]);
      });
      solver->solve(vector.view, x.view);
      const double lambda = p.alpha + mu * (eigenvalue(p, 0, m[0]) + eigenvalue(p, 1, m[1]) + eigenvalue(p, 2, m[2]));
      test::for_each_point(p.extent(), [&](int i, int j, int k) { x.view(i, j, k) *= lambda; });
      // Rounding of the vector has a part in the smoothest mode.
      const double bound = 20 * epsilon * (1.0 + lambda / smallest_eigenvalue(p));
      EXPECT_LT(test::max_difference(x.view, vector.view), bound) << p.grid.cells[0];
    }
  }
}

TEST_P(FftSolverOf, NullspaceIsOfConstantsAlone) {
  for (const Grid& shape : shapes) {
    const EllipticProblem p = problem(shape);
    if (!p.has_nullspace()) continue;
    for (const Transforms transforms : {Transforms::pairs_of_lines, Transforms::fftw_r2r}) {
      const auto solver = make_elliptic_solver(p, FftOptions{transforms});
      Numbers exact(p, 23);
      exact.subtract_mean();
      const Numbers rhs(p);
      apply(p, exact.view, rhs.view);
      test::for_each_point(p.extent(), [&](int i, int j, int k) { rhs.view(i, j, k) += 3.0; });
      const double scale = test::max_abs(rhs.view);
      const SolveReport report = solver->solve(rhs.view, rhs.view);
      EXPECT_NEAR(report.removed_mean[0], 3.0, 10 * epsilon * scale);
      const double condition = norm(p) / smallest_eigenvalue(p);
      EXPECT_LT(test::max_difference(rhs.view, exact.view), 4 * epsilon * condition);
    }
  }
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  const auto& [topology, unknowns, alpha] = info.param;
  std::ostringstream out;
  for (int axis = 0; axis < 3; ++axis) {
    out << (test::axes_of(topology.periodic)[axis] ? 'P' : test::axes_of(topology.mirror)[axis] ? 'M' : 'W');
  }
  out << '_' << name(unknowns.centring) << '_' << name(unknowns.boundary) << (alpha > 0 ? "_helmholtz" : "_poisson");
  return out.str();
}

INSTANTIATE_TEST_SUITE_P(All, FftSolverOf,
                         testing::Combine(testing::ValuesIn(test::all_topologies()), testing::ValuesIn(all_unknowns),
                                          testing::Values(0.0, 2.5)),
                         case_name);

TEST(FftSolver, RemovesTheMeanOfEachComponentIfAllAxesArePeriodic) {
  const Grid grid({0, 0, 0}, {1, 2, 1}, {8, 9, 10}, {.periodic = {true, true, true}});
  const EllipticProblem p = EllipticProblem::velocity(grid, EllipticForm::laplacian, 0.0, 2.0);
  for (const Transforms transforms : {Transforms::pairs_of_lines, Transforms::fftw_r2r}) {
    FaceVector rhs(grid);
    FaceVector x(grid);
    for (int c = 0; c < 3; ++c) {
      const View b = rhs.unknowns()[c];
      test::fill_random(b, 30 + c);
      double sum = 0.0;
      test::for_each_point(b.extent, [&](int i, int j, int k) { sum += b(i, j, k); });
      const double shift = c + 1.0 - sum / static_cast<double>(p.unknowns(c));
      test::for_each_point(b.extent, [&](int i, int j, int k) { b(i, j, k) += shift; });
    }
    const SolveReport report = make_elliptic_solver(p, FftOptions{transforms})->solve(rhs.unknowns(), x.unknowns());
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(report.removed_mean[c], c + 1.0, 1e-14);
    EXPECT_LT(relative_residual(p, rhs.unknowns(), x.unknowns()), 1e-14);
  }
}

TEST(FftSolver, HasTheSameBitsForAnyNumberOfThreads) {
  for (const test::Topology& topology : test::all_topologies()) {
    const Grid grid = test::with_topology(Grid({0, 0, 0}, {1, 2, 1}, {40, 23, 27}), topology);
    const auto boundary = topology.mirror == 0 ? BoundaryCondition::neumann : BoundaryCondition::dirichlet;
    const EllipticProblem p(grid, Centring::cell, boundary, 0.0, 1.0);
    const Numbers rhs(p, 24);
    const Numbers reference(p);
    {
      const test::ThreadCount one(1);
      make_elliptic_solver(p, FftOptions{})->solve(rhs.view, reference.view);
    }
    for (const int threads : {2, 3, 5}) {
      const test::ThreadCount several(threads);
      const Numbers x(p);
      make_elliptic_solver(p, FftOptions{})->solve(rhs.view, x.view);
      EXPECT_EQ(x.values, reference.values) << threads << " threads, " << topology;
    }
  }
}

TEST(FftSolver, DoesNotAllocateInASolve) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const test::ThreadCount two(2);  // with one the OpenMP library itself allocates a team for every loop
  for (const test::Topology& topology : test::all_topologies()) {
    const Grid grid = test::with_topology(Grid({0, 0, 0}, {1, 2, 1}, {150, 22, 15}), topology);
    for (const Unknowns& unknowns : all_unknowns) {
      const EllipticProblem p(grid, unknowns.centring, unknowns.boundary, 0.0, 1.0);
      const auto solver = make_elliptic_solver(p, FftOptions{});
      const Numbers x(p, 25);
      solver->solve(x.view, x.view);
      const long before = vesiflow::test::allocation_count();
      solver->solve(x.view, x.view);
      EXPECT_EQ(vesiflow::test::allocation_count() - before, 0) << topology;
    }
  }
}

// Waves along x and y hardly vary over a cell of z here: r of column_solver.cpp is almost 1, or 1 itself. The walls keep
// the problem well conditioned.
TEST(FftSolver, IsAccurateIfOnlyWallsInZHoldTheSolution) {
  for (const double alpha : {0.0, 1e-14, 1e-9, 1e-4}) {
    for (const Centring centring : {Centring::cell, Centring::face_z}) {
      for (const double length : {1.0, 30.0, 1e3}) {
        const Grid grid({0, 0, 0}, {length, length, 1}, {6, 6, 64}, {.periodic = {true, true, false}});
        const EllipticProblem p(grid, centring, BoundaryCondition::dirichlet, alpha, 1.0);
        const auto solver = make_elliptic_solver(p, FftOptions{});
        const Numbers exact(p, 26);
        const Numbers rhs(p);
        apply(p, exact.view, rhs.view);
        solver->solve(rhs.view, rhs.view);
        EXPECT_LT(test::max_difference(rhs.view, exact.view), 1e-13) << "length " << length;
      }
    }
  }
}

}  // namespace
}  // namespace vesiflow::fluid::fft_solver_test
