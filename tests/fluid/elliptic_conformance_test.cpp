// What every EllipticSolver must do, for every backend in the build.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "fluid/elliptic_solver.h"
#include "test_fields.h"

namespace vesiflow::fluid {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct Case {
  Centring centring;
  BoundaryCondition boundary;
  double alpha;
};

const Case cases[] = {
    {Centring::cell, BoundaryCondition::neumann, 0.0},     {Centring::cell, BoundaryCondition::neumann, 2.5},
    {Centring::cell, BoundaryCondition::dirichlet, 0.0},   {Centring::cell, BoundaryCondition::dirichlet, 40.0},
    {Centring::face_x, BoundaryCondition::dirichlet, 0.0}, {Centring::face_x, BoundaryCondition::dirichlet, 7.0},
    {Centring::face_y, BoundaryCondition::dirichlet, 0.0}, {Centring::face_y, BoundaryCondition::dirichlet, 7.0},
    {Centring::face_z, BoundaryCondition::dirichlet, 0.0}, {Centring::face_z, BoundaryCondition::dirichlet, 7.0}};

// Powers of two, odd, prime and unequal, with unequal mesh widths.
const Grid grids[] = {Grid({0, 0, 0}, {1, 1, 1}, {16, 16, 16}), Grid({-1, 0, 0}, {1, 3, 1}, {15, 9, 21}),
                      Grid({0, 0, 0}, {1, 2, 3}, {7, 13, 11}), Grid({0, 0, -1}, {4, 1, 1}, {24, 5, 4})};

const SolverOptions backends[] = {
    FftOptions{},
#ifdef VESIFLOW_WITH_CHOLMOD
    CholmodOptions{},
#endif
};

class EllipticConformance : public testing::TestWithParam<std::tuple<SolverOptions, Case, Grid>> {
 protected:
  const SolverOptions& options() const { return std::get<0>(GetParam()); }
  EllipticProblem problem(double mu = 0.75) const {
    const Case& c = std::get<1>(GetParam());
    return {std::get<2>(GetParam()), c.centring, c.boundary, c.alpha, mu};
  }
};

// Unknowns with padding between rows and planes, filled with a value that must survive.
struct Padded {
  explicit Padded(const EllipticProblem& problem, double filling = 99.0) {
    const auto n = problem.extent();
    const std::ptrdiff_t row = n[0] + 3;
    const std::ptrdiff_t plane = row * (n[1] + 2);
    values.assign(static_cast<std::size_t>(plane * n[2]), filling);
    view = {values.data(), n, row, plane};
  }
  std::vector<double> values;
  View view;
};

TEST_P(EllipticConformance, SolutionSatisfiesTheDiscreteEquations) {
  const auto solver = make_elliptic_solver(problem(), options());
  const Padded rhs(problem());
  const Padded x(problem());
  test::fill_random(rhs.view, 11);
  const SolveReport report = solver->solve(rhs.view, x.view);
  EXPECT_TRUE(report.converged);
  // Round-off times the condition number, about the square of the cells: 1e-16 * 24^2, and room for
  // grounding.
  EXPECT_LT(relative_residual(problem(), rhs.view, x.view), 5e-12);
  EXPECT_EQ(x.view.row(0, 0)[x.view.extent[0]], 99.0);
}

TEST_P(EllipticConformance, RecoversWhatTheOperatorWasAppliedTo) {
  const auto solver = make_elliptic_solver(problem(), options());
  const Padded exact(problem());
  const Padded x(problem());
  test::fill_random(exact.view, 12);
  if (problem().has_nullspace()) {
    double sum = 0.0;
    test::for_each_point(exact.view.extent, [&](int i, int j, int k) { sum += exact.view(i, j, k); });
    const double mean = sum / static_cast<double>(problem().unknowns());
    test::for_each_point(exact.view.extent, [&](int i, int j, int k) { exact.view(i, j, k) -= mean; });
  }
  const Padded rhs(problem());
  apply(problem(), exact.view, rhs.view);
  const SolveReport report = solver->solve(rhs.view, rhs.view);  // in place
  EXPECT_LT(test::max_difference(rhs.view, exact.view), 1e-12);
  EXPECT_NEAR(report.removed_mean[0], 0.0, 1e-11);
}

TEST_P(EllipticConformance, UpdatedSolverEqualsANewOne) {
  const auto solver = make_elliptic_solver(problem(), options());
  EllipticProblem changed = problem(3.0);
  changed.alpha += 1.5;
  solver->update(changed);
  const auto fresh = make_elliptic_solver(changed, options());
  const Padded rhs(changed);
  const Padded x(changed);
  const Padded y(changed);
  test::fill_random(rhs.view, 14);
  solver->solve(rhs.view, x.view);
  fresh->solve(rhs.view, y.view);
  EXPECT_EQ(test::max_difference(x.view, y.view), 0.0);
}

TEST_P(EllipticConformance, RefusesWrongShapesAndNonFiniteData) {
  const auto solver = make_elliptic_solver(problem(), options());
  const Padded rhs(problem(), 1.0);
  View small = rhs.view;
  --small.extent[1];
  EXPECT_THAT([&] { solver->solve(small, rhs.view); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("the right-hand side is")));
  EXPECT_THAT([&] { solver->solve(rhs.view, small); }, ThrowsMessage<std::invalid_argument>(HasSubstr("the solution")));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Padded broken(problem(), 1.0);
    broken.view(2, 3, 1) = bad;
    EXPECT_THAT([&] { solver->solve(broken.view, broken.view); },
                ThrowsMessage<std::runtime_error>(HasSubstr("not finite")));
  }
}

class SingularProblem : public testing::TestWithParam<std::tuple<SolverOptions, Grid>> {};

TEST_P(SingularProblem, LosesTheMeansOfBothSides) {
  const auto& [options, grid] = GetParam();
  const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::neumann, 0.0, 0.75);
  const auto solver = make_elliptic_solver(problem, options);
  const Padded rhs(problem);
  const Padded shifted(problem);
  test::fill_random(rhs.view, 13);
  test::for_each_point(rhs.view.extent, [&](int i, int j, int k) { shifted.view(i, j, k) = rhs.view(i, j, k) + 3.0; });
  const double mean = solver->solve(rhs.view, rhs.view).removed_mean[0];
  EXPECT_NEAR(solver->solve(shifted.view, shifted.view).removed_mean[0], mean + 3.0, 1e-13);
  EXPECT_LT(test::max_difference(rhs.view, shifted.view), 1e-12);
  double sum = 0.0;
  test::for_each_point(rhs.view.extent, [&](int i, int j, int k) { sum += rhs.view(i, j, k); });
  EXPECT_NEAR(sum / static_cast<double>(problem.unknowns()), 0.0, 1e-14);
}

void print(std::ostream& out, const SolverOptions& options) {
  out << (std::holds_alternative<FftOptions>(options) ? "fft" : "cholmod");
}

void print(std::ostream& out, const Grid& grid) {
  out << '_' << grid.cells[0] << 'x' << grid.cells[1] << 'x' << grid.cells[2];
}

void print(std::ostream& out, const Case& c) {
  out << '_' << name(c.centring) << '_' << name(c.boundary) << (c.alpha > 0 ? "_helmholtz" : "_poisson");
}

const auto parameter_name = [](const auto& info) {
  std::ostringstream out;
  std::apply([&](const auto&... parts) { (print(out, parts), ...); }, info.param);
  return out.str();
};

INSTANTIATE_TEST_SUITE_P(Backends, EllipticConformance,
                         testing::Combine(testing::ValuesIn(backends), testing::ValuesIn(cases),
                                          testing::ValuesIn(grids)),
                         parameter_name);

INSTANTIATE_TEST_SUITE_P(Backends, SingularProblem,
                         testing::Combine(testing::ValuesIn(backends), testing::ValuesIn(grids)), parameter_name);

}  // namespace
}  // namespace vesiflow::fluid
