// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What every EllipticSolver must do, for every backend in the build and every kind of problem.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>

#include "fluid/elliptic_solver.h"
#include "test_problems.h"
#include "thread_count.h"

namespace vesiflow::fluid::elliptic_conformance_test {
namespace {

using test::Kind;
using test::Numbers;
using testing::HasSubstr;
using testing::ThrowsMessage;

struct Backend {
  const char* name;
  SolverOptions options;
  bool any_problem;        // else only the laplacian form with a number mu
  double tolerance;        // of the residual, relative, in 2-norms
  int iterations;          // at most, for a ratio of viscosities of 20
  double round_off = 1.0;  // of means, over that of double precision
};

// Of direct solvers: round-off times what the grounding of singular problems and ratios of viscosities cost.
constexpr double direct = 1e-13;
constexpr double iterative = 1e-10;
// Round-off of single precision, times the ratio of the largest eigenvalue to what the right-hand side consists of.
constexpr double single = 1e-5;
constexpr FftOptions single_fft{.arithmetic = FftOptions::Arithmetic::single};

PcgOptions pcg_with(const decltype(PcgOptions::preconditioner)& preconditioner) {
  PcgOptions options;
  options.preconditioner = preconditioner;
  return options;
}

[[maybe_unused]] CholmodOptions lagged() {
  CholmodOptions options;
  options.refactor = {.every = 5, .change = 0.1};
  return options;
}

// 75 is the bound of conjugate gradients from x = 0 for the ratio 20 if the fast solver is not scaled, in the stress form,
// whose condition number is then at most 2 * 20: sqrt(40) / 2 * log(2 / 1e-10). How many there are for a smooth sphere, see
// pcg_solver_test.cpp.
const Backend backends[] = {
    {"fft", FftOptions{}, false, direct, 0},
    {"fft_single", single_fft, false, single, 0, 0x1p29},
    {"pcg_fft_single", pcg_with(single_fft), true, iterative, 75},
    {"fftw_r2r", FftOptions{FftOptions::Transforms::fftw_r2r}, false, direct, 0},
    {"pcg_fft", pcg_with(FftOptions{}), true, iterative, 75},
    {"pcg_fftw_r2r", pcg_with(FftOptions{FftOptions::Transforms::fftw_r2r}), true, iterative, 75},
    {"auto", AutoOptions{}, true, iterative, 75},
#ifdef VESIFLOW_WITH_CHOLMOD
    {"cholmod", CholmodOptions{}, true, direct, 0},
    {"cholmod_lagged", lagged(), true, iterative, 2},
    {"pcg_cholmod_lagged", pcg_with(lagged()), true, iterative, 2},
#endif
};

// Walls and periodic axes in all mixes, mirrors in most.
std::vector<test::Topology> many_topologies() {
  std::vector<test::Topology> topologies;
  for (int periodic = 0; periodic < 8; ++periodic) topologies.push_back({.periodic = periodic});
  for (const int mirror : {1, 2, 4, 3, 6, 7}) topologies.push_back({.mirror = mirror});
  for (const auto& [periodic, mirror] : {std::pair(1, 2), {2, 5}, {4, 3}}) topologies.push_back({periodic, mirror});
  return topologies;
}

// Power of two, odd, prime, flat, with unequal mesh widths.
const std::pair<Grid, std::vector<test::Topology>> grids[] = {
    {Grid({0, 0, 0}, {1, 1, 1}, {8, 8, 8}), {{}, {.periodic = 7}, {.mirror = 6}}},
    {Grid({-1, 0, 0}, {1, 3, 1}, {9, 5, 7}), {{}, {.periodic = 1}, {.mirror = 1}}},
    {Grid({0, 0, 0}, {1, 2, 3}, {7, 11, 5}), {{}, {.periodic = 6}, {.mirror = 2}, {.mirror = 6}}},
    {Grid({0, 0, -1}, {4, 1, 1}, {16, 5, 4}), {{}, {.periodic = 3}, {.mirror = 3}, {.periodic = 3, .mirror = 4}}},
    {Grid({0, 0, 0}, {1, 0.8, 1.3}, {6, 5, 7}), many_topologies()}};

const Grid one_grid({0, 0, 0}, {1, 2, 3}, {9, 6, 8});

enum class Coefficient { number, field };

Viscosity viscosity(const Grid& grid, Coefficient coefficient) {
  return coefficient == Coefficient::number ? Viscosity(0.75) : Viscosity(test::wavy_viscosity(grid, 20.0));
}

void PrintTo(const Backend& backend, std::ostream* out) {
  *out << backend.name;
}

bool is_refused(const Backend& backend, const EllipticProblem& problem) {
  return !backend.any_problem && (problem.form == EllipticForm::stress || !problem.mu.is_constant());
}

// A lower bound of the smallest eigenvalue but the nullspace's. Of -Lap along one axis it is (2/h sin(pi h / 2L))^2, at
// least 0.94 (pi / L)^2 for 4 cells, where walls hold the solution, and that of twice the length if one of the ends is a
// mirror; elsewhere constants are free along the axis. The
// stress form has more energy than the laplacian for every x (discrete Korn inequality: the double of grad u's symmetric
// part is |grad u|^2 + (div u)^2), if mu is a number, and then mu >= mu_min.
double smallest_eigenvalue(const EllipticProblem& problem) {
  double held = 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double first = 0.94 * std::pow(std::numbers::pi / problem.grid.length(axis), 2);
    smallest = std::min(smallest, first);
    if (problem.boundary == BoundaryCondition::dirichlet && !problem.grid.periodic[axis]) {
      held += problem.grid.mirror[axis] ? first / 4 : first;
    }
  }
  const double mu = problem.mu.checked_range().min;
  return problem.alpha + mu * (problem.has_nullspace() ? smallest : held);
}

// max |r| <= |r|_2 <= tolerance |b|_2 <= tolerance sqrt(n) max |b|.
double allowed_residual(const Backend& backend, const EllipticProblem& problem) {
  return backend.tolerance * std::sqrt(static_cast<double>(problem.unknowns()));
}

void check_report(const Backend& backend, const SolveReport& report) {
  EXPECT_TRUE(report.converged);
  EXPECT_GT(report.seconds, 0.0);
  EXPECT_LE(report.iterations, backend.iterations);
  if (report.iterations > 0) {
    ASSERT_TRUE(report.residual.has_value());
    EXPECT_LE(*report.residual, backend.tolerance);
  }
}

void check_solution(const Backend& backend, EllipticSolver& solver, unsigned seed) {
  const EllipticProblem& problem = solver.problem();
  const Numbers rhs(problem, seed);
  const Numbers x(problem);
  const SolveReport report = solver.solve(rhs, x);
  EXPECT_TRUE(report.converged);
  EXPECT_LT(relative_residual(problem, rhs, x), allowed_residual(backend, problem));
  EXPECT_TRUE(x.padding_is_intact());
}

// The problems are small: more threads would take longer.
class ForEachKind : public testing::TestWithParam<std::tuple<Backend, Kind, Coefficient>> {
  const test::ThreadCount one_thread_{1};
};

TEST_P(ForEachKind, SolvesTheDiscreteEquationsOrRefusesThem) {
  const auto& [backend, kind, coefficient] = GetParam();
  for (const auto& [shape, topologies] : grids) {
    for (const test::Topology& topology : topologies) {
      for (const double alpha : {0.0, 7.0}) {
        const Grid grid = test::with_topology(shape, topology);
        const EllipticProblem p = kind.problem(grid, alpha, viscosity(grid, coefficient));
        SCOPED_TRACE(testing::Message() << grid.cells[0] << 'x' << grid.cells[1] << 'x' << grid.cells[2] << ", "
                                        << topology << ", alpha " << alpha);
        if (is_refused(backend, p)) {
          const char* what = p.form == EllipticForm::stress ? "stress" : "variable";
          EXPECT_THAT(([&p, &options = backend.options] { make_elliptic_solver(p, options); }),
                      ThrowsMessage<std::invalid_argument>(
                          AllOf(HasSubstr("fft"), HasSubstr(what), HasSubstr("pcg"), HasSubstr("cholmod"))));
          continue;
        }
        const auto solver = make_elliptic_solver(p, backend.options);
        check_solution(backend, *solver, 11);

        Numbers exact(p, 12);
        if (p.has_nullspace()) exact.subtract_means();
        const Numbers x(p);
        apply(p, exact, x);
        const double allowed = backend.tolerance * x.norm() / smallest_eigenvalue(p);
        const SolveReport report = solver->solve(x, x);  // in place
        check_report(backend, report);
        EXPECT_LT(x.max_difference(exact), allowed);
        EXPECT_TRUE(x.padding_is_intact());
        // Sums of divergences cancel but for the rounding of their terms, about |A| |x| = 1e4 here.
        for (const double mean : report.removed_mean) EXPECT_NEAR(mean, 0.0, 1e-11 * backend.round_off);
      }
    }
  }
}

class EllipticConformance : public testing::TestWithParam<Backend> {
 protected:
  static const Backend& backend() { return GetParam(); }

  // visit(problem maker (grid, alpha)) for every kind and coefficient that the backend solves.
  template <class Visit>
  static void for_each_kind(Visit&& visit) {
    for (const Kind& kind : test::all_kinds) {
      for (const Coefficient coefficient : {Coefficient::number, Coefficient::field}) {
        const auto problem = [&](const Grid& grid, double alpha) {
          return kind.problem(grid, alpha, viscosity(grid, coefficient));
        };
        if (is_refused(backend(), problem(one_grid, 1.0))) continue;
        SCOPED_TRACE(testing::Message() << kind.name << (coefficient == Coefficient::number ? ", number" : ", field"));
        visit(problem);
      }
    }
  }

 private:
  const test::ThreadCount one_thread_{1};
};

TEST_P(EllipticConformance, StartsFromAnyX) {
  for_each_kind([&](const auto& problem) {
    const EllipticProblem p = problem(one_grid, 2.0);
    const auto solver = make_elliptic_solver(p, backend().options);
    const Numbers rhs(p, 15);
    const Numbers x(p, 16);
    check_report(backend(), solver->solve(rhs, x));
    EXPECT_LT(relative_residual(p, rhs, x), allowed_residual(backend(), p));
    // Iterations notice that they are done.
    EXPECT_EQ(solver->solve(rhs, x).iterations, 0);
  });
}

TEST_P(EllipticConformance, UpdatedSolverSolvesTheNewProblem) {
  for_each_kind([&](const auto& problem) {
    const Grid grid = test::with_periodic_axes(one_grid, 7);
    const auto solver = make_elliptic_solver(problem(grid, 1.0), backend().options);
    // Another alpha; a nullspace, and none again; another structure.
    for (const double alpha : {0.5, 0.0, 2.0}) {
      SCOPED_TRACE(alpha);
      solver->update(problem(grid, alpha));
      EXPECT_EQ(solver->problem().alpha, alpha);
      const Numbers rhs(solver->problem(), 14);
      const Numbers x(solver->problem());
      EXPECT_TRUE(solver->solve(rhs, x).converged);
      EXPECT_LT(relative_residual(solver->problem(), rhs, x), allowed_residual(backend(), solver->problem()));
    }
    for (const Grid& other : {one_grid, test::with_topology(one_grid, {.mirror = 6})}) {
      solver->update(problem(other, 1.0));
      check_solution(backend(), *solver, 17);
    }
  });
}

TEST_P(EllipticConformance, NullspaceIsRemovedFromEachBlock) {
  for_each_kind([&](const auto& problem) {
    for (const int mask : {0, 7}) {
      const EllipticProblem p = problem(test::with_periodic_axes(one_grid, mask), 0.0);
      if (!p.has_nullspace()) continue;
      const auto solver = make_elliptic_solver(p, backend().options);
      const Numbers rhs(p, 13);
      Numbers shifted(p, 13);
      for (int block = 0; block < p.blocks(); ++block) shifted.add_to_block(block, 3.0 + block);
      const Numbers x(p);
      const Numbers y(p);
      const SolveReport report = solver->solve(rhs, x);
      const SolveReport report_shifted = solver->solve(shifted, y);
      for (int block = 0; block < p.blocks(); ++block) {
        EXPECT_NEAR(report.removed_mean[block], rhs.mean(block), 1e-14 * backend().round_off);
        EXPECT_NEAR(report_shifted.removed_mean[block], rhs.mean(block) + 3.0 + block, 1e-13 * backend().round_off);
        EXPECT_NEAR(x.mean(block), 0.0, 1e-13 * backend().round_off);
      }
      EXPECT_LT(x.max_difference(y), 2.0 * backend().tolerance * rhs.norm() / smallest_eigenvalue(p));
    }
  });
}

TEST_P(EllipticConformance, RefusesWrongShapesAndNonFiniteData) {
  for_each_kind([&](const auto& problem) {
    const EllipticProblem p = problem(one_grid, 1.0);
    const auto solver = make_elliptic_solver(p, backend().options);
    const Numbers rhs(p, 1);
    const Numbers x(p);
    std::array<View, 3> views{x.block(0), p.blocks() == 3 ? x.block(1) : x.block(0),
                              p.blocks() == 3 ? x.block(2) : x.block(0)};
    --views[p.blocks() - 1].extent[1];
    const Blocks small = p.blocks() == 3 ? Blocks(views) : Blocks(views[0]);
    const Blocks wrong_count = p.blocks() == 3 ? Blocks(x.block(0)) : Blocks(views);
    EXPECT_THAT([&] { solver->solve(small, x); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("the right-hand side is")));
    EXPECT_THAT([&] { solver->solve(rhs, small); }, ThrowsMessage<std::invalid_argument>(HasSubstr("the solution is")));
    EXPECT_THAT([&] { solver->solve(wrong_count, x); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("the right-hand side has")));
    EXPECT_THAT([&] { solver->solve(rhs, wrong_count); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("the solution has")));
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      for (int block = 0; block < p.blocks(); ++block) {
        const Numbers broken(p, 1);
        broken.block(block)(2, 3, 1) = bad;
        const Numbers y(p);
        EXPECT_THAT([&] { solver->solve(broken, y); }, ThrowsMessage<std::runtime_error>(HasSubstr("not finite")));
        // Direct solvers do not look at the x to start from.
        if (solver->name().starts_with("pcg")) {
          EXPECT_THAT([&] { solver->solve(rhs, broken); },
                      ThrowsMessage<std::runtime_error>(HasSubstr("start from is not finite")));
        }
      }
    }
    check_solution(backend(), *solver, 18);  // it is as good as before
  });
}

TEST_P(EllipticConformance, GivesTheSameBitsForEveryNumberOfThreads) {
  // Large enough for threads (libfluid/src/grid/planes.h), but for factorisations, whose time would be seconds.
  const bool factors = std::string(backend().name).find("cholmod") != std::string::npos;
  const Grid shape = factors ? one_grid : Grid({0, 0, 0}, {1, 2, 3}, {31, 27, 23});
  const Grid grid = test::with_topology(shape, {.mirror = 2});
  for_each_kind([&](const auto& problem) {
    const EllipticProblem p = problem(grid, 0.0);
    const Numbers rhs(p, 21);
    const std::array<Numbers, 3> x{Numbers(p), Numbers(p), Numbers(p)};
    const std::array<int, 3> threads{1, 2, 5};
    for (int t = 0; t < 3; ++t) {
      const test::ThreadCount count(threads[t]);
      make_elliptic_solver(p, backend().options)->solve(rhs, x[t]);
    }
    EXPECT_TRUE(x[0].same_bits(x[1]));
    EXPECT_TRUE(x[0].same_bits(x[2]));
  });
}

const auto parameter_name = [](const auto& parameters) {
  const auto& [backend, kind, coefficient] = parameters.param;
  return std::string(backend.name) + "_" + kind.name + (coefficient == Coefficient::number ? "_number" : "_field");
};

INSTANTIATE_TEST_SUITE_P(Backends, ForEachKind,
                         testing::Combine(testing::ValuesIn(backends), testing::ValuesIn(test::all_kinds),
                                          testing::Values(Coefficient::number, Coefficient::field)),
                         parameter_name);

INSTANTIATE_TEST_SUITE_P(Backends, EllipticConformance, testing::ValuesIn(backends),
                         [](const auto& backend) { return std::string(backend.param.name); });

class SharedField : public testing::TestWithParam<Backend> {
  const test::ThreadCount one_thread_{1};
};

TEST_P(SharedField, ChangedValuesTakeEffectAtUpdate) {
  if (!GetParam().any_problem) return;
  for (const Kind& kind : test::all_kinds) {
    SCOPED_TRACE(kind.name);
    const auto mu = test::wavy_viscosity(one_grid, 20.0);
    const EllipticProblem p = kind.problem(one_grid, 1.0, Viscosity(mu));
    const auto solver = make_elliptic_solver(p, GetParam().options);
    const auto other = test::wavy_viscosity(one_grid, 20.0, 1.1);
    std::copy_n(other->data(), other->size(), mu->data());
    solver->update(p);
    const Numbers rhs(p, 41);
    const Numbers x(p);
    EXPECT_TRUE(solver->solve(rhs, x).converged);
    EXPECT_LT(relative_residual(p, rhs, x), GetParam().tolerance * std::sqrt(static_cast<double>(p.unknowns())));
    (*mu)(3, 2, 1) = -1.0;
    EXPECT_THAT([&] { solver->update(p); }, ThrowsMessage<std::invalid_argument>(HasSubstr("cell (3, 2, 1) is -1")));
  }
}

TEST_P(SharedField, MayBecomeANumberAndBack) {
  if (!GetParam().any_problem) return;
  const auto problem = [](const Viscosity& mu) {
    return EllipticProblem::velocity(one_grid, EllipticForm::stress, 1.0, mu);
  };
  const auto solver = make_elliptic_solver(problem(3.0), GetParam().options);
  for (const Viscosity& mu : {Viscosity(test::wavy_viscosity(one_grid, 20.0)), Viscosity(0.5)}) {
    solver->update(problem(mu));
    const Numbers rhs(problem(mu), 42);
    const Numbers x(problem(mu));
    EXPECT_TRUE(solver->solve(rhs, x).converged);
    EXPECT_LT(relative_residual(problem(mu), rhs, x),
              GetParam().tolerance * std::sqrt(static_cast<double>(problem(mu).unknowns())));
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, SharedField, testing::ValuesIn(backends),
                         [](const auto& backend) { return std::string(backend.param.name); });

}  // namespace
}  // namespace vesiflow::fluid::elliptic_conformance_test
