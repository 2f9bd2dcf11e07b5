// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Public functions that take fields or vectors of unknowns look at their shapes, and name the argument, what was found and what is wanted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

#include "fluid/navier_stokes.h"
#include "fluid/operators.h"
#include "fluid/resampling.h"

namespace vesiflow::fluid::argument_shapes_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct Case {
  const char* what;
  std::function<void()> call;
  const char* argument;
};

const Grid grid({0, 0, 0}, {1, 1, 1}, {6, 6, 6});

FaceVector mixed(const Grid& x, const Grid& y, const Grid& z) {
  return {Field<FaceX>(x), Field<FaceY>(y), Field<FaceZ>(z)};
}

Vector3 no_motion(const Vector3&, double) {
  return {};
}

std::shared_ptr<Field<Cell>> viscosity_on(const Grid& g) {
  return sample_viscosity(g, [](const Vector3&) { return 2.0; });
}

// Fields on another grid, whichever way it is another one, and of the three components each alone.
TEST(ArgumentShapes, OfFields) {
  struct Other {
    Grid grid;
    const char* found;
  };
  const Other others[] = {
      {Grid({0, 0, 0}, {1, 1, 1}, {6, 6, 7}), "6 x 6 x 7 cells from (0, 0, 0) to (1, 1, 1); must be 6 x 6 x 6 cells"},
      {Grid({0, 0, 0}, {1, 1, 1}, {5, 6, 6}), "5 x 6 x 6 cells from (0, 0, 0) to (1, 1, 1); must be 6 x 6 x 6 cells"},
      {Grid({0, 0, 0}, {1, 2, 1}, {6, 6, 6}),
       "from (0, 0, 0) to (1, 2, 1); must be 6 x 6 x 6 cells from (0, 0, 0) to (1, 1, 1)"},
      {Grid({0, 0, 0}, {1, 1, 1}, {6, 6, 6}, {.periodic = {false, true, false}}), "axis 1 periodic; must be 6 x 6 x 6"},
      {Grid({0, 0, 0}, {1, 1, 1}, {6, 6, 6}, {.mirror = {false, false, true}}),
       "axis 2 with a mirror; must be 6 x 6 x 6"}};
  const WallVelocity walls(grid, no_motion);
  NavierStokes flow(grid, {}, no_motion);
  StokesSolver stokes(grid);
  Field<Cell> p(grid);
  FaceVector u(grid);
  for (const auto& [other, found] : others) {
    Field<Cell> wrong_p(other);
    for (int which = 0; which < 3; ++which) {
      FaceVector wrong_u = mixed(which == 0 ? other : grid, which == 1 ? other : grid, which == 2 ? other : grid);
      const WallVelocity other_walls(other, no_motion);
      std::vector<Case> cases{
          {"gradient", [&] { gradient(p, wrong_u); }, "gradient: g "},
          {"divergence", [&] { divergence(wrong_u, p); }, "divergence: u "},
          {"convection", [&] { convection(u, wrong_u); }, "convection: n "},
          {"walls", [&] { walls.set_normal_faces(wrong_u); }, "boundary: u "},
          {"walls", [&] { walls.fill_ghosts(wrong_u); }, "boundary: u "},
          {"walls", [&] { walls.add_diffusion(1.0, wrong_u); }, "boundary: rhs "},
          {"stokes", [&] { stokes.solve(wrong_u, walls, u, p); }, "stokes: the force "},
          {"stokes", [&] { stokes.solve(u, walls, wrong_u, p); }, "stokes: the velocity "},
          {"stokes", [&] { stokes.solve(u, walls, u, wrong_p); }, "stokes: the pressure "},
          {"stokes", [&] { stokes.update(viscosity_on(other)); }, "stokes: the viscosity "},
          {"problem",
           [&] { EllipticProblem(grid, Centring::cell, BoundaryCondition::neumann, 0, viscosity_on(other)); },
           "elliptic problem: the field mu "},
          {"construction", [&] { NavierStokes(grid, {.viscosity = viscosity_on(other)}, no_motion); },
           "fluid: the field of viscosity "},
          {"start_from", [&] { flow.start_from(wrong_u, p); }, "fluid: the velocity to start from "},
          {"start_from", [&] { flow.start_from(u, wrong_p); }, "fluid: the pressure to start from "},
          {"restore", [&] { flow.restore(wrong_u, u, p, {}); }, "fluid: the velocity to restore "},
          {"restore", [&] { flow.restore(u, wrong_u, p, {}); }, "fluid: the previous velocity to restore "},
          {"restore", [&] { flow.restore(u, u, wrong_p, {}); }, "fluid: the pressure to restore "},
          {"step",
           [&] {
             NavierStokes with_another_force(grid, {}, no_motion);
             with_another_force.force() = wrong_u.clone();
             with_another_force.step(0.1);
           },
           "fluid: the force "},
      };
      if (which > 0) {  // of a triple by itself, that of x is the one wanted
        cases.push_back({"max_divergence", [&] { max_divergence(wrong_u); }, "max_divergence: u "});
        cases.push_back({"convection", [&] { convection(wrong_u, u); }, "convection: u "});
        cases.push_back({"resample", [&] { resample(wrong_u, u); }, "resample: from "});
        cases.push_back({"resample", [&] { resample(u, wrong_u); }, "resample: to "});
      }
      for (const Case& c : cases) {
        SCOPED_TRACE(c.what);
        EXPECT_THAT(c.call, ThrowsMessage<std::invalid_argument>(
                                AllOf(HasSubstr(c.argument), HasSubstr("another grid"), HasSubstr(found))));
      }
      EXPECT_THAT([&] { stokes.solve(u, other_walls, u, p); },
                  ThrowsMessage<std::invalid_argument>(HasSubstr("another grid")));
    }
  }
}

TEST(ArgumentShapes, OfVectorsOfUnknowns) {
  const auto scalar = EllipticProblem(grid, Centring::cell, BoundaryCondition::neumann, 1.0, 1.0);
  const auto velocity = EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, 1.0);
  const auto solver = make_elliptic_solver(scalar, FftOptions{});
  Field<Cell> p(grid), wrong_p(Grid({0, 0, 0}, {1, 1, 1}, {6, 7, 6}));
  FaceVector u(grid), wrong_u = mixed(grid, grid, wrong_p.grid());
  const char* const found = " is 6 x 7 x 6, the problem has 6 x 6 x 6 unknowns";
  const char* const of_last_block = " is 6 x 7 x 5, the problem has 6 x 6 x 5 unknowns";
  const struct {
    std::function<void()> call;
    const char *argument, *found;
  } cases[] = {
      {[&] { apply(scalar, wrong_p.unknowns(), p.unknowns()); }, "apply: x", found},
      {[&] { apply(scalar, p.unknowns(), wrong_p.unknowns()); }, "apply: y", found},
      {[&] { apply(scalar, u.unknowns(), p.unknowns()); }, "apply: x", " has 3 arrays, the problem has 1"},
      {[&] { apply(velocity, u.unknowns(), p.unknowns()); }, "apply: y", " has 1 arrays, the problem has 3"},
      {[&] { apply(velocity, wrong_u.unknowns(), u.unknowns()); }, "apply: x", of_last_block},
      {[&] { relative_residual(scalar, wrong_p.unknowns(), p.unknowns()); }, "relative_residual: the right-hand side",
       found},
      {[&] { relative_residual(scalar, p.unknowns(), wrong_p.unknowns()); }, "relative_residual: x", found},
      {[&] { relative_residual(velocity, wrong_u.unknowns(), u.unknowns()); }, "relative_residual: the right-hand side",
       of_last_block},
      {[&] { solver->solve(wrong_p.unknowns(), p.unknowns()); }, "elliptic solver: the right-hand side", found},
      {[&] { solver->solve(p.unknowns(), wrong_p.unknowns()); }, "elliptic solver: the solution", found},
  };
  for (const auto& c : cases)
    EXPECT_THAT(c.call, ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(c.argument), HasSubstr(c.found))));
}

}  // namespace
}  // namespace vesiflow::fluid::argument_shapes_test
