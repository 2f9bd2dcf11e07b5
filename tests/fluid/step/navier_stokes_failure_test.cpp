// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What is left after a refusal: everything, or a clear error again; never a wrong state.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "fluid/operators.h"
#include "manufactured_flow.h"

namespace vesiflow::fluid::navier_stokes_failure_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Grid grid({-1, -1, -1}, {1, 1, 1}, {8, 9, 10});
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Vector3 no_slip(const Vector3&, double) {
  return {};
}

void push(NavierStokes& fluid) {
  test::sample_faces(fluid.force(), [](const Vector3& r) {
    return Vector3{std::sin(2 * r[1]), std::cos(3 * r[2]), r[0]};
  });
}

TEST(AfterAFailure, WallsThatWereRefusedAreRefusedAgainAndTheFlowGoesOn) {
  bool leaky = false;
  const auto walls = [&](const Vector3& r, double t) { return Vector3{leaky ? r[0] : 0.0, std::sin(t) * r[2], 0.0}; };
  NavierStokes fluid(grid, {}, walls, WallMotion::unsteady);
  NavierStokes other(grid, {}, walls, WallMotion::unsteady);
  for (NavierStokes* one : {&fluid, &other}) {
    push(*one);
    one->step(0.1);
  }
  leaky = true;
  for (int attempt = 0; attempt < 2; ++attempt) {
    EXPECT_THAT([&] { fluid.step(0.1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("net outward flux")));
  }
  leaky = false;
  fluid.step(0.1);
  other.step(0.1);
  EXPECT_TRUE(test::same_bits(fluid.velocity(), other.velocity()));
}

TEST(AfterAFailure, AVelocityThatIsNotFiniteIsRefusedWithItsPlaceAndTheFlowGoesOn) {
  NavierStokes fluid(grid, {}, no_slip);
  NavierStokes other(grid, {}, no_slip);
  for (NavierStokes* one : {&fluid, &other}) {
    push(*one);
    for (int k = 0; k < 2; ++k) one->step(0.1);
  }
  EXPECT_THAT([&] { fluid.set_velocity([](const Vector3& r) {
                      return Vector3{0.0, r[2] > 0.5 ? nan : 1.0, 0.0};
                    }); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("nan"), HasSubstr("component 1"))));
  FaceVector broken = fluid.velocity().clone();
  broken.z(3, 4, 5) = nan;
  EXPECT_THAT([&] { fluid.restore(broken, fluid.previous_velocity(), fluid.pressure(), fluid.clock()); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("not finite")));
  for (const double step : {1e-320, 0.05, -0.1, nan}) {
    FluidClock clock = fluid.clock();
    clock.time_step = step;
    EXPECT_THAT([&] { fluid.restore(fluid.velocity(), fluid.previous_velocity(), fluid.pressure(), clock); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("the time between")));
  }
  fluid.step(0.1);
  other.step(0.1);
  EXPECT_TRUE(test::same_bits(fluid.velocity(), other.velocity()));
}

TEST(AfterAFailure, ABlownUpFlowCanBeStartedAnew) {
  NavierStokes fluid(grid, {}, no_slip);
  push(fluid);
  fluid.step(0.1);
  fluid.force().x.fill(1e300);
  EXPECT_THROW(
      {
        for (int k = 0; k < 5; ++k) fluid.step(0.1);
      },
      std::runtime_error);
  push(fluid);
  fluid.set_velocity([](const Vector3&) { return Vector3{}; });
  fluid.step(0.1);
  NavierStokes fresh(grid, {}, no_slip);
  push(fresh);
  fresh.step(0.1);
  EXPECT_TRUE(test::same_bits(fluid.velocity(), fresh.velocity()));
}

TEST(AfterAFailure, NumbersThatAreNotFiniteHaveInfiniteDivergenceAndResidual) {
  FaceVector u(grid);
  u.y(2, 3, 4) = nan;
  EXPECT_EQ(max_divergence(u), std::numeric_limits<double>::infinity());
  const EllipticProblem problem(grid, Centring::cell, BoundaryCondition::dirichlet, 1.0, 1.0);
  Field<Cell> rhs(grid), x(grid);
  rhs.fill(1.0);
  x.fill(nan);
  EXPECT_EQ(relative_residual(problem, rhs.points(), x.points()), std::numeric_limits<double>::infinity());
}

TEST(AfterAFailure, ASolverWhoseUpdateFailedSaysSoUntilItIsUpdatedAgain) {
  const EllipticProblem problem = EllipticProblem::velocity(grid, EllipticForm::laplacian, 1.0, 1.0);
  const auto solver = make_elliptic_solver(problem, FftOptions{});
  FaceVector rhs(grid), x(grid);
  rhs.fill(1.0);
  solver->solve(rhs.unknowns(), x.unknowns());
  EXPECT_THROW(solver->update(EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, 1.0)), std::invalid_argument);
  EXPECT_THAT([&] { solver->solve(rhs.unknowns(), x.unknowns()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("last update failed")));
  solver->update(problem);
  FaceVector y(grid);
  solver->solve(rhs.unknowns(), y.unknowns());
  EXPECT_TRUE(test::same_bits(x, y));
}

// With nothing that drives it, flow without inertia stops at once, whatever it was before.
TEST(WithoutADrive, StokesFlowStops) {
  for (const bool variable : {false, true}) {
    FluidParameters parameters;
    parameters.inertia = Inertia::none;
    if (variable) parameters.viscosity = sample_viscosity(grid, [](const Vector3& r) { return 2.0 + r[0]; });
    NavierStokes fluid(grid, parameters, no_slip);
    push(fluid);
    for (int k = 0; k < 2; ++k) fluid.step(0.1);
    EXPECT_GT(test::max_abs(fluid.velocity().x.points()), 1e-4);
    fluid.force().fill(0.0);
    fluid.step(0.1);
    EXPECT_EQ(test::max_abs(fluid.velocity().x.points()), 0.0);
    EXPECT_EQ(test::max_abs(fluid.pressure().points()), 0.0);
  }
}

TEST(WithoutADrive, ConjugateGradientsAnswerZeroWhateverTheStart) {
  const auto mu = sample_viscosity(grid, [](const Vector3& r) { return 2.0 + r[0]; });
  const EllipticProblem problem = EllipticProblem::velocity(grid, EllipticForm::stress, 0.0, mu);
  FaceVector rhs(grid), x(grid);
  x.fill(1.0);
  const SolveReport report = make_elliptic_solver(problem, PcgOptions{})->solve(rhs.unknowns(), x.unknowns());
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
  for (const View& component : x.unknowns()) EXPECT_EQ(test::max_abs(component), 0.0);
}

TEST(Grid, ThatIsTooLargeIsRefusedBeforeAnythingIsAllocated) {
  EXPECT_THAT(
      [] {
        Grid({0, 0, 0}, {1, 1, 1}, {8, 2000000000, 8});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("2000000000 cells along axis 1")));
  const Grid large({0, 0, 0}, {1, 1, 1}, {20000, 20000, 20000});
  EXPECT_THAT([&] { NavierStokes(large, {}, no_slip); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("20000 x 20000"), HasSubstr("GB"))));
}

}  // namespace
}  // namespace vesiflow::fluid::navier_stokes_failure_test
