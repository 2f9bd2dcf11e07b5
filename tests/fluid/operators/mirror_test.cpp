// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Walls, ghosts, operators and solvers on a part of a box between mirrors: what they give on the whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "fluid/boundary.h"
#include "fluid/elliptic_solver.h"
#include "fluid/operators.h"
#include "fluid/stokes.h"
#include "mirror_fields.h"
#include "operators/stencil.h"
#include "operators/step_passes.h"
#include "thread_count.h"

namespace vesiflow::fluid::mirror_test {
namespace {

using test::part_of_box;
using test::SymmetricFunctions;
using test::unfolded;
using test::whole_box;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// All masks of mirrors.
class Mirrors : public testing::TestWithParam<int> {
 protected:
  const test::ThreadCount one_thread_{1};
  const Grid grid = part_of_box(GetParam());
  const SymmetricFunctions functions{grid};
  const BoundaryVelocity wall_velocity = [this](const Vector3& r, double t) { return functions.wall_velocity(r, t); };
  const WallVelocity walls{grid, wall_velocity};

  // Random inside. (What is on walls and mirrors does not stay.)
  FaceVector velocity(unsigned seed) const {
    FaceVector u(grid);
    for (const View& component : u.points()) test::fill_random(component, seed++);
    walls.set_normal_faces(u);
    walls.fill_ghosts(u);
    return u;
  }
  Field<Cell> scalar(unsigned seed) const {
    Field<Cell> p(grid);
    test::fill_random(p.points(), seed);
    extend_to_ghosts(p);
    return p;
  }
};

// The whole box has its own walls, which know of no mirror.
TEST_P(Mirrors, WallsAndGhostsAreThoseOfTheWholeBox) {
  const WallVelocity whole_walls(whole_box(grid), wall_velocity);
  const FaceVector u = velocity(1);
  FaceVector whole = unfolded(u);
  whole_walls.set_normal_faces(whole);
  whole_walls.fill_ghosts(whole);
  EXPECT_LT(test::difference_everywhere(u, whole), 100 * epsilon);
  for (int axis = 0; axis < 3; ++axis) {
    ConstView plane = u.points()[axis];
    plane.extent[axis] = 1;
    EXPECT_EQ(test::max_abs(plane) == 0.0, grid.mirror[axis]);
  }
  double share = 1.0;
  for (const bool mirror : grid.mirror) share *= mirror ? 0.5 : 1.0;
  EXPECT_NEAR(walls.net_flux(), share * whole_walls.net_flux(), 1e-14);

  FaceVector diffusion(grid);
  FaceVector whole_diffusion(whole_box(grid));
  walls.add_diffusion(1.75, diffusion);
  whole_walls.add_diffusion(1.75, whole_diffusion);
  EXPECT_LT(test::difference_inside(diffusion, whole_diffusion), 1e-12);  // 2 mu / h^2 is about 50
}

TEST_P(Mirrors, OfACoefficientHaveItsGhosts) {
  const Field<Cell> p = scalar(2);
  Field<Cell> whole = unfolded(p);
  extend_to_ghosts(whole);
  EXPECT_EQ(test::difference_everywhere(p, whole), 0.0);
}

TEST_P(Mirrors, ExplicitOperatorsGiveWhatTheyDoOnTheWholeBox) {
  const FaceVector u = velocity(3);
  const FaceVector whole_u = unfolded(u);
  const Field<Cell> p = scalar(4);
  const Field<Cell> whole_p = unfolded(p);
  FaceVector result(grid);
  FaceVector whole_result(whole_box(grid));

  gradient(p, result);
  gradient(whole_p, whole_result);
  EXPECT_LT(test::difference_inside(result, whole_result), 100 * epsilon);

  convection(u, result);
  convection(whole_u, whole_result);
  EXPECT_LT(test::difference_inside(result, whole_result), 100 * epsilon);

  const auto mu = test::symmetric_viscosity(grid, 5.0);
  const auto whole_mu = unfolded(mu);
  result.fill(0.0);
  whole_result.fill(0.0);
  add_stress(u, mu->points(), 5.0, result);
  add_stress(whole_u, whole_mu->points(), 5.0, whole_result);
  EXPECT_LT(test::difference_inside(result, whole_result), 1e4 * epsilon);  // mu / h^2 is up to 100

  Field<Cell> d(grid);
  Field<Cell> whole_d(whole_box(grid));
  divergence(u, d);
  divergence(whole_u, whole_d);
  EXPECT_LT(test::difference_inside(d, whole_d), 100 * epsilon);
  EXPECT_NEAR(max_divergence(u), max_divergence(whole_u), 100 * epsilon);

  FaceVector corrected = u.clone();
  FaceVector whole_corrected = whole_u.clone();
  Field<Cell> chi = scalar(5);
  Field<Cell> whole_chi = unfolded(chi);
  Field<Cell> pressure = p.clone();
  Field<Cell> whole_pressure = whole_p.clone();
  correct_velocity_and_pressure(chi, 3.0, mu->points(), 1.0, corrected, pressure);
  correct_velocity_and_pressure(whole_chi, 3.0, whole_mu->points(), 1.0, whole_corrected, whole_pressure);
  EXPECT_LT(test::difference_inside(corrected, whole_corrected), 100 * epsilon);
  EXPECT_LT(test::difference_inside(pressure, whole_pressure), 1e4 * epsilon);
}

// The homogeneous operators, and the solutions of direct solvers.
TEST_P(Mirrors, EllipticProblemsAreThoseOfTheWholeBox) {
  const auto mu = test::symmetric_viscosity(grid, 5.0);
  const auto whole_mu = unfolded(mu);
  for (const test::Kind& kind : test::all_kinds) {
    for (const bool constant : {true, false}) {
      SCOPED_TRACE(testing::Message() << kind.name << (constant ? ", number" : ", field"));
      const EllipticProblem problem = kind.problem(grid, 2.0, constant ? Viscosity(1.3) : Viscosity(mu));
      const EllipticProblem whole = kind.problem(whole_box(grid), 2.0, constant ? Viscosity(1.3) : Viscosity(whole_mu));
      GhostedBlocks x(problem), y(problem), whole_x(whole), whole_y(whole);
      const auto unfold_x = [&] {
        x.set_ghosts();
        for (int block = 0; block < problem.blocks(); ++block) {
          test::unfold(grid, problem.centring(block), x.points()[block], whole_x.points()[block]);
        }
      };
      const auto difference = [&](int block) {
        const Centring centring = problem.centring(block);
        const ConstView inside = test::part_of(grid, centring, whole_y.points()[block]);
        return test::max_difference(y.unknowns()[block], test::without_walls(grid, centring, inside));
      };
      for (int block = 0; block < problem.blocks(); ++block) test::fill_random(x.unknowns()[block], 6 + block);
      unfold_x();
      apply(problem, x.unknowns(), y.unknowns());
      apply(whole, whole_x.unknowns(), whole_y.unknowns());
      for (int block = 0; block < problem.blocks(); ++block) EXPECT_LT(difference(block), 1e4 * epsilon);

      if (problem.form == EllipticForm::stress || !constant) continue;
      make_elliptic_solver(problem, FftOptions{})->solve(x.unknowns(), y.unknowns());
      make_elliptic_solver(whole, FftOptions{})->solve(whole_x.unknowns(), whole_y.unknowns());
      for (int block = 0; block < problem.blocks(); ++block) EXPECT_LT(difference(block), 100 * epsilon);
    }
  }
}

TEST_P(Mirrors, ConditionsAreNeumannForEvenAndDirichletForOddComponents) {
  const auto velocity = EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, 1.0);
  const EllipticProblem pressure(grid, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (int block = 0; block < 3; ++block) {
      const bool even = grid.mirror[axis] && block != axis;
      EXPECT_EQ(velocity.condition(block, axis, 0), even ? BoundaryCondition::neumann : BoundaryCondition::dirichlet);
      EXPECT_EQ(velocity.condition(block, axis, 1), BoundaryCondition::dirichlet);
    }
    EXPECT_EQ(pressure.condition(0, axis, 0), BoundaryCondition::neumann);
    EXPECT_EQ(pressure.condition(0, axis, 1), BoundaryCondition::neumann);
  }
  EXPECT_FALSE(EllipticProblem::velocity(grid, EllipticForm::stress, 0.0, 1.0).has_nullspace());
  EXPECT_TRUE(pressure.has_nullspace());
}

TEST_P(Mirrors, GradientAndDivergenceAreAdjointAndConvectionDoesNoWork) {
  const WallVelocity at_rest(grid, [](const Vector3&, double) { return Vector3{}; });
  FaceVector u = test::random_velocity(grid, 7);
  at_rest.set_normal_faces(u);
  at_rest.fill_ghosts(u);
  const Field<Cell> p = scalar(8);
  FaceVector g(grid);
  gradient(p, g);
  Field<Cell> d(grid);
  divergence(u, d);
  EXPECT_NEAR(test::dot(g, u), -test::dot(p.points(), d.points()), 1e-12);
  convection(u, g);
  EXPECT_NEAR(test::dot(g, u), 0.0, 1e-12);
}

TEST_P(Mirrors, StokesFlowIsThatOfTheWholeBox) {
  FaceVector force(grid);
  FaceVector whole_force(whole_box(grid));
  for (auto* f : {&force, &whole_force}) {
    for (int c = 0; c < 3; ++c) {
      const View view = f->points()[c];
      test::for_each_point(view.extent, [&](int i, int j, int k) {
        view(i, j, k) = 3.0 * functions.vector(point_position(f->grid(), face_centrings[c], i, j, k), 1.0)[c];
      });
    }
  }
  const WallVelocity whole_walls(whole_box(grid), wall_velocity);
  const auto mu = test::symmetric_viscosity(grid, 5.0);
  for (const bool constant : {true, false}) {
    constexpr double tolerance = 1e-11;
    StokesSolver solver(grid, {.tolerance = tolerance});
    StokesSolver whole_solver(whole_box(grid), {.tolerance = tolerance});
    solver.update(constant ? Viscosity(1.3) : Viscosity(mu));
    whole_solver.update(constant ? Viscosity(1.3) : Viscosity(unfolded(mu)));
    FaceVector u(grid), whole_u(whole_box(grid));
    Field<Cell> p(grid), whole_p(whole_box(grid));
    const StokesReport report = solver.solve(force, walls, u, p);
    const StokesReport whole_report = whole_solver.solve(whole_force, whole_walls, whole_u, whole_p);
    EXPECT_TRUE(report.converged && whole_report.converged);
    // Mirrors are no obstacle to the iteration.
    EXPECT_LE(report.iterations, whole_report.iterations + 10);
    EXPECT_LT(report.divergence, 1e-13);
    // |r| <= tolerance |b|, where |b| is about 50, and the last projection adds fourfold.
    EXPECT_LT(test::difference_inside(u, whole_u), 1e-9);
    EXPECT_LT(test::difference_inside(p, whole_p), 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(AllMasks, Mirrors, testing::Range(1, 8));

TEST(MirrorOfWalls, RefusesAVelocityThroughThePlane) {
  EXPECT_THAT([] { WallVelocity(part_of_box(2), [](const Vector3&, double) {
                     return Vector3{0, 0.25, 0};
                   }); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("velocity component 1 of the walls is 0.25"), HasSubstr("on the mirror of axis 1"))));
}

TEST(MirrorOfWalls, TakesRoundOffOnThePlaneForZero) {
  const Grid grid = part_of_box(2);
  const WallVelocity walls(grid, [](const Vector3& r, double) { return Vector3{1, 1e-15 * r[2], 0}; });
  FaceVector u(grid);
  walls.set_normal_faces(u);
  walls.fill_ghosts(u);
  EXPECT_EQ(u.y(2, 0, -1), 0.0);
  EXPECT_NE(u.y(2, 1, -1), 0.0);
}

TEST(MirrorOfWalls, CountsTheFluxThroughWallsAlone) {
  // Out through the upper wall of x, where the lower end is a mirror.
  EXPECT_THAT([] { WallVelocity(part_of_box(1), [](const Vector3& r, double) {
                     return Vector3{r[0], 0, 0};
                   }); },
              // 1.2 x 1.7 x 1.7
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("net outward flux"), HasSubstr("3.468"))));
}

}  // namespace
}  // namespace vesiflow::fluid::mirror_test
