// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Flows that are symmetric about planes, computed on the part of the box between them and on the whole.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <tuple>

#include "fluid/navier_stokes.h"
#include "fluid/operators.h"
#include "mirror_fields.h"
#include "support/allocation_counter.h"
#include "thread_count.h"

namespace vesiflow::fluid::navier_stokes_mirror_test {
namespace {

using test::part_of_box;
using test::SymmetricFunctions;
using test::unfolded;
using test::whole_box;

void set_force(const SymmetricFunctions& functions, double time, FaceVector& force) {
  for (int c = 0; c < 3; ++c) {
    const View view = force.points()[c];
    test::for_each_point(view.extent, [&](int i, int j, int k) {
      const Vector3 r = point_position(force.grid(), face_centrings[c], i, j, k);
      view(i, j, k) = 3.0 * functions.vector(r, 1.0)[c] * std::cos(time);
    });
  }
}

// Twenty steps, the last five shorter, of a flow driven by a force and by walls that swing, shear, blow and suck, from a
// velocity that is neither zero nor divergence-free.
void run(NavierStokes& flow, const SymmetricFunctions& functions) {
  flow.set_velocity([&](const Vector3& r) { return functions.vector(r, 0.1); });
  for (int step = 0; step < 20; ++step) {
    set_force(functions, flow.time(), flow.force());
    flow.step(step < 15 ? 0.02 : 0.01);
  }
}

BoundaryVelocity walls_of(const SymmetricFunctions& functions) {
  return [functions](const Vector3& r, double t) {
    Vector3 u = functions.wall_velocity(r, t);
    u[0] += 0.5 * r[2] * r[2] * (1.0 - 0.3 * r[1] * r[1]) * (1.0 + t) * r[0];
    u[2] -= (1.0 - 0.3 * r[1] * r[1]) * (1.0 + t) * r[2] * r[2] * r[2] / 6.0;
    return u;
  };
}

SolverOptions exact_solver(const FluidParameters& parameters) {
  const bool coupled =
      !parameters.viscosity.is_constant() && parameters.viscous_treatment == ViscousTreatment::implicit;
  if (!coupled) return FftOptions{};
#ifdef VESIFLOW_WITH_CHOLMOD
  return CholmodOptions{};
#else
  return PcgOptions{.tolerance = 1e-14};
#endif
}

struct Flow {
  const char* name;
  FluidParameters parameters;  // of a number mu
  bool variable;
};

const Flow flows[] = {
    {"number", {.reynolds_number = 2.0, .viscosity = 0.7}, false},
    {"number_unsteady", {.reynolds_number = 2.0, .viscosity = 0.7, .inertia = Inertia::unsteady}, false},
    {"explicit", {.reynolds_number = 2.0, .viscous_treatment = ViscousTreatment::explicit_}, true},
    {"extrapolated", {.reynolds_number = 2.0, .viscous_treatment = ViscousTreatment::extrapolated}, true},
    {"extrapolated_unsteady",
     {.reynolds_number = 2.0, .viscous_treatment = ViscousTreatment::extrapolated, .inertia = Inertia::unsteady},
     true},
    {"implicit", {.reynolds_number = 2.0, .viscous_treatment = ViscousTreatment::implicit}, true},
};

void PrintTo(const Flow& flow, std::ostream* out) {
  *out << flow.name;
}

// Of mirrors of y, of y and z, and of x, and cells of the part: odd, prime, even.
struct Part {
  int mirrors;
  std::array<int, 3> cells;
};
const Part parts[] = {{2, {6, 5, 9}}, {6, {8, 5, 7}}, {6, {7, 6, 4}}, {1, {5, 7, 6}}};

class MirroredFlow : public testing::TestWithParam<std::tuple<Flow, Part>> {
  const test::ThreadCount one_thread_{1};
};

TEST_P(MirroredFlow, IsThePartOfTheFlowInTheWholeBox) {
  const auto& [flow, part] = GetParam();
  const Grid grid = part_of_box(part.mirrors, part.cells);
  const SymmetricFunctions functions(grid);
  FluidParameters here = flow.parameters;
  FluidParameters there = flow.parameters;
  if (flow.variable) {
    const auto mu = test::symmetric_viscosity(grid, 5.0);
    here.viscosity = mu;
    there.viscosity = unfolded(mu);
  }
  here.velocity_solver = exact_solver(here);
  there.velocity_solver = exact_solver(there);
  NavierStokes in_part(grid, here, walls_of(functions), WallMotion::unsteady);
  NavierStokes in_whole(whole_box(grid), there, walls_of(functions), WallMotion::unsteady);
  run(in_part, functions);
  run(in_whole, functions);
  ASSERT_GT(test::max_abs(in_part.velocity().y.points()), 0.3);
  EXPECT_LT(max_divergence(in_part.velocity()), 1e-13);
  // Round-off of twenty steps: velocities are of order 1, pressures up to 70 and divided by dt.
  EXPECT_LT(test::difference_everywhere(in_part.velocity(), in_whole.velocity()), 5e-14);
  EXPECT_LT(test::difference_everywhere(in_part.previous_velocity(), in_whole.previous_velocity()), 5e-14);
  EXPECT_LT(test::difference_everywhere(in_part.pressure(), in_whole.pressure()), 2e-12);
}

std::string case_name(const testing::TestParamInfo<std::tuple<Flow, Part>>& info) {
  const auto& [flow, part] = info.param;
  std::ostringstream out;
  out << flow.name << "_mirrors_" << part.mirrors << "_cells";
  for (const int cells : part.cells) out << '_' << cells;
  return out.str();
}

INSTANTIATE_TEST_SUITE_P(All, MirroredFlow, testing::Combine(testing::ValuesIn(flows), testing::ValuesIn(parts)),
                         case_name);

// Every step is solved to a tolerance; a later one does not remember the errors of those before.
TEST(NavierStokesWithMirrors, FlowWithoutInertiaIsThatOfTheWholeBox) {
  const test::ThreadCount one(1);
  const Grid grid = part_of_box(6, {6, 5, 4});
  const SymmetricFunctions functions(grid);
  const auto mu = test::symmetric_viscosity(grid, 5.0);
  for (const bool variable : {false, true}) {
    FluidParameters here;
    here.inertia = Inertia::none;
    here.stokes.tolerance = 1e-12;
    FluidParameters there = here;
    if (variable) {
      here.viscosity = mu;
      there.viscosity = unfolded(mu);
    }
    NavierStokes in_part(grid, here, walls_of(functions), WallMotion::unsteady);
    NavierStokes in_whole(whole_box(grid), there, walls_of(functions), WallMotion::unsteady);
    run(in_part, functions);
    run(in_whole, functions);
    EXPECT_LT(test::difference_everywhere(in_part.velocity(), in_whole.velocity()), 1e-10);
    EXPECT_LT(test::difference_everywhere(in_part.pressure(), in_whole.pressure()), 1e-9);
  }
}

TEST(NavierStokesWithMirrors, RandomVelocityIsProjectedAsInTheWholeBox) {
  const auto at_rest = [](const Vector3&, double) { return Vector3{}; };
  for (int mirrors = 1; mirrors < 8; ++mirrors) {
    const Grid grid = part_of_box(mirrors);
    const FaceVector random = test::random_velocity(grid, 31);
    const FaceVector whole_random = unfolded(random);
    const auto project = [&](const FaceVector& u) {
      NavierStokes flow(u.grid(), {}, at_rest);
      flow.set_velocity([&](const Vector3& r) {
        Vector3 value{};
        for (int c = 0; c < 3; ++c) {
          std::array<int, 3> index{};
          for (int axis = 0; axis < 3; ++axis) {
            const double cells = (r[axis] - u.grid().lower[axis]) / u.grid().spacing(axis);
            const double offset = axis == c ? 0.0 : 0.5;
            index[axis] = static_cast<int>(std::lround(cells - offset));
            index[axis] = std::clamp(index[axis], 0, u.points()[c].extent[axis] - 1);  // for the other components
          }
          value[c] = u.points()[c](index[0], index[1], index[2]);
        }
        return value;
      });
      return flow;
    };
    const NavierStokes in_part = project(random);
    const NavierStokes in_whole = project(whole_random);
    EXPECT_GT(max_divergence(random), 1.0);
    EXPECT_LT(max_divergence(in_part.velocity()), 1e-13);
    EXPECT_LT(test::difference_everywhere(in_part.velocity(), in_whole.velocity()), 1e-14);
  }
}

TEST(NavierStokesWithMirrors, HasTheSameBitsForEveryNumberOfThreads) {
  const Grid grid = part_of_box(6, {31, 23, 29});  // large enough for threads
  const SymmetricFunctions functions(grid);
  for (const auto treatment : {ViscousTreatment::extrapolated, ViscousTreatment::implicit}) {
    const auto run_with = [&](int threads) {
      const test::ThreadCount count(threads);
      FluidParameters parameters;
      parameters.viscosity = test::symmetric_viscosity(grid, 5.0);
      parameters.viscous_treatment = treatment;
      parameters.velocity_solver = AutoOptions{.tolerance = 1e-6};
      NavierStokes flow(grid, parameters, walls_of(functions), WallMotion::unsteady);
      flow.step(0.02);
      flow.step(0.01);
      return flow;
    };
    const NavierStokes one = run_with(1);
    for (const int threads : {2, 3}) {
      const NavierStokes several = run_with(threads);
      EXPECT_TRUE(test::same_bits(one.velocity(), several.velocity()));
      EXPECT_TRUE(test::same_bits(one.pressure(), several.pressure()));
    }
  }
}

TEST(NavierStokesWithMirrors, AllocatesNothingInAWarmedUpStep) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const test::ThreadCount two(2);  // with one the OpenMP library itself allocates a team for every loop
  for (const bool variable : {false, true}) {
    const Grid grid = part_of_box(6, {28, 29, 30});
    const SymmetricFunctions functions(grid);
    FluidParameters parameters;
    if (variable) parameters.viscosity = test::symmetric_viscosity(grid, 5.0);
    NavierStokes flow(grid, parameters, walls_of(functions), WallMotion::unsteady);
    flow.step(0.02);
    flow.step(0.02);
    const long before = vesiflow::test::allocation_count();
    flow.step(0.02);
    flow.step(0.01);
    EXPECT_EQ(vesiflow::test::allocation_count() - before, 0);
  }
}

TEST(NavierStokesWithMirrors, ContinuesARestoredStateBitForBit) {
  const Grid grid = part_of_box(6);
  const SymmetricFunctions functions(grid);
  NavierStokes flow(grid, {}, walls_of(functions), WallMotion::unsteady);
  for (int step = 0; step < 3; ++step) flow.step(0.02);
  NavierStokes other(grid, {}, walls_of(functions), WallMotion::unsteady);
  other.restore(flow.velocity(), flow.previous_velocity(), flow.pressure(), flow.clock());
  flow.step(0.02);
  other.step(0.02);
  EXPECT_TRUE(test::same_bits(flow.velocity(), other.velocity()));
  EXPECT_TRUE(test::same_bits(flow.pressure(), other.pressure()));
}

}  // namespace
}  // namespace vesiflow::fluid::navier_stokes_mirror_test
