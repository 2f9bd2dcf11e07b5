// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The time step with a field of viscosity.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "fluid/operators.h"
#include "manufactured_flow.h"
#include "support/allocation_counter.h"
#include "thread_count.h"

namespace vesiflow::fluid::navier_stokes_viscosity_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Grid grid({-1, -1, -1}, {1, 1, 1}, {12, 11, 13});
constexpr ViscousTreatment treatments[] = {ViscousTreatment::explicit_, ViscousTreatment::extrapolated,
                                           ViscousTreatment::implicit};

double sphere(const Vector3& r, double ratio, double width) {
  const double distance = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) - 0.5;
  return 1.0 + 0.5 * (ratio - 1.0) * (1.0 - std::tanh(distance / width));
}

Vector3 stirring(const Vector3& r, double t) {
  return {std::sin(r[2] + 3 * t), std::cos(r[0] - t), 0.5 * std::sin(r[1]) * t};
}

void set_force(NavierStokes& fluid) {
  test::sample_faces(fluid.force(), [](const Vector3& r) {
    return Vector3{std::sin(2 * r[1]), std::cos(3 * r[2]), r[0] * r[1]};
  });
}

NavierStokes make(ViscousTreatment treatment, Viscosity viscosity, double reynolds_number = 1.0,
                  const Grid& box = grid) {
  FluidParameters parameters;
  parameters.reynolds_number = reynolds_number;
  parameters.viscosity = viscosity;
  parameters.viscous_treatment = treatment;
  return NavierStokes(box, parameters, stirring, WallMotion::unsteady);
}

// A field that is a constant is the constant: in the implicit form up to the grad-div term, which acts on u* alone.
TEST(VariableViscosity, AUniformFieldIsANumber) {
  NavierStokes number = make(ViscousTreatment::explicit_, 3.0);
  set_force(number);
  for (int k = 0; k < 5; ++k) number.step(0.02);
  for (const ViscousTreatment treatment : {ViscousTreatment::explicit_, ViscousTreatment::extrapolated}) {
    NavierStokes field = make(treatment, sample_viscosity(grid, [](const Vector3&) { return 3.0; }));
    set_force(field);
    for (int k = 0; k < 5; ++k) field.step(0.02);
    EXPECT_LT(test::max_difference(field.velocity(), number.velocity()), 1e-13);
  }
}

// With viscosity mu(z), the wall at z = 1 moving along x: mu du/dz is the same everywhere.
TEST(VariableViscosity, LayeredShearHasConstantStress) {
  const Grid layers({0, 0, -1}, {1, 1, 1}, {4, 4, 24}, {.periodic = {true, true, false}});
  for (const ViscousTreatment treatment : treatments) {
    FluidParameters parameters;
    parameters.reynolds_number = 0.1;
    parameters.viscous_treatment = treatment;
    parameters.viscosity = sample_viscosity(layers, [](const Vector3& r) { return r[2] < 0.0 ? 1.0 : 10.0; });
    const auto wall = [](const Vector3& r, double) { return Vector3{r[2] > 0 ? 1.0 : 0.0, 0.0, 0.0}; };
    NavierStokes fluid(layers, parameters, wall);
    for (int k = 0; k < 400; ++k) fluid.step(0.05);
    // Between the middles of the outermost cells: 11 1/2 gaps of one viscosity, the gap of mean viscosity 5.5, 11 1/2 of
    // the other; walls half a gap away.
    const double h = layers.spacing(2);
    const double stress = 1.0 / (h * (11.5 / 1.0 + 1.0 / 5.5 + 11.5 / 10.0));
    const Field<FaceX>& u = fluid.velocity().x;
    for (int k = 0; k < 24; ++k) {
      const double below = k < 12 ? 1.0 : k == 12 ? 5.5 : 10.0;
      EXPECT_NEAR(below * (u(2, 1, k) - u(2, 1, k - 1)) / h, stress, 1e-7 * stress) << k;
    }
  }
}

// The pressure iteration of the implicit treatment must not grow, whatever the ratio, when inertia is negligible.
TEST(VariableViscosity, ImplicitTreatmentIsStableAtExtremeRatios) {
  for (const double ratio : {0.05, 100.0}) {
    NavierStokes fluid = make(ViscousTreatment::implicit,
                              sample_viscosity(grid, [&](const Vector3& r) { return sphere(r, ratio, 0.05); }), 1e-3);
    set_force(fluid);
    double largest = 0.0;
    for (int k = 0; k < 60; ++k) {
      fluid.step(0.01);
      largest = std::max(largest, test::max_abs(fluid.pressure().points()));
    }
    EXPECT_LT(test::max_abs(fluid.velocity().x.points()), 1.5) << ratio;  // the walls move by at most 1
    EXPECT_LT(test::max_abs(fluid.pressure().points()), 2.0 * largest);
    EXPECT_LT(max_divergence(fluid.velocity()) * grid.min_spacing(), 1e-13);
  }
}

TEST(VariableViscosity, GivesTheSameBitsForEveryNumberOfThreads) {
  for (const ViscousTreatment treatment : treatments) {
    const auto run = [&](int threads) {
      const test::ThreadCount count(threads);
      const Grid large({-1, -1, -1}, {1, 1, 1}, {28, 27, 26});  // small ones are left to one thread
      NavierStokes fluid =
          make(treatment, sample_viscosity(large, [](const Vector3& r) { return sphere(r, 5.0, 0.2); }), 1.0, large);
      set_force(fluid);
      for (int k = 0; k < 3; ++k) fluid.step(0.02);
      return fluid.velocity().clone();
    };
    EXPECT_TRUE(test::same_bits(run(1), run(3)));
  }
}

TEST(VariableViscosity, RestoredRunContinuesBitForBit) {
  for (const ViscousTreatment treatment : treatments) {
    const auto viscosity = sample_viscosity(grid, [](const Vector3& r) { return sphere(r, 5.0, 0.2); });
    NavierStokes fluid = make(treatment, viscosity);
    set_force(fluid);
    for (int k = 0; k < 3; ++k) fluid.step(0.02);
    NavierStokes restored = make(treatment, viscosity);
    set_force(restored);
    restored.restore(fluid.velocity(), fluid.previous_velocity(), fluid.pressure(), fluid.clock());
    for (NavierStokes* one : {&fluid, &restored}) {
      for (int k = 0; k < 3; ++k) one->step(0.02);
    }
    EXPECT_TRUE(test::same_bits(fluid.velocity(), restored.velocity()));
  }
}

// The owner changes the field between steps.
TEST(VariableViscosity, IsReadAnewInEveryStep) {
  for (const ViscousTreatment treatment : treatments) {
    const auto viscosity = sample_viscosity(grid, [](const Vector3&) { return 1.0; });
    NavierStokes fluid = make(treatment, viscosity);
    for (int k = 0; k < 2; ++k) fluid.step(0.02);
    const auto changed = sample_viscosity(grid, [](const Vector3& r) { return sphere(r, 5.0, 0.2); });
    NavierStokes other = make(treatment, changed);
    other.restore(fluid.velocity(), fluid.previous_velocity(), fluid.pressure(), fluid.clock());
    if (treatment == ViscousTreatment::explicit_) {
      *viscosity = changed->clone();  // other arrays too
    } else {
      std::copy_n(changed->data(), changed->size(), viscosity->data());
    }
    fluid.step(0.02);
    other.step(0.02);
    // The implicit solves start from different solvers only in their reference viscosity, which update() brings up to date.
    EXPECT_TRUE(test::same_bits(fluid.velocity(), other.velocity()));
  }
}

TEST(VariableViscosity, AllocatesNothingInAWarmedUpStep) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const test::ThreadCount two(2);  // with one the OpenMP library itself allocates a team for every loop
  for (const ViscousTreatment treatment : treatments) {
    const auto viscosity = sample_viscosity(grid, [](const Vector3& r) { return sphere(r, 5.0, 0.2); });
    NavierStokes fluid = make(treatment, viscosity);
    for (int k = 0; k < 2; ++k) fluid.step(0.02);
    const long before = vesiflow::test::allocation_count();
    for (int k = 0; k < 2; ++k) fluid.step(0.02);
    EXPECT_EQ(vesiflow::test::allocation_count() - before, 0) << static_cast<int>(treatment);
  }
}

TEST(VariableViscosity, ThatIsNotPositiveIsRefusedWithItsPlaceBeforeTheStep) {
  const auto viscosity = sample_viscosity(grid, [](const Vector3&) { return 2.0; });
  NavierStokes fluid = make(ViscousTreatment::extrapolated, viscosity);
  fluid.step(0.02);
  const FaceVector velocity = fluid.velocity().clone();
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    (*viscosity)(3, 4, 5) = bad;
    EXPECT_THAT([&] { fluid.step(0.02); }, ThrowsMessage<std::invalid_argument>(HasSubstr("(3, 4, 5)")));
    EXPECT_TRUE(test::same_bits(fluid.velocity(), velocity));
  }
  (*viscosity)(3, 4, 5) = 2.0;
  fluid.step(0.02);
  EXPECT_EQ(fluid.steps(), 2);
}

// No factor of a box this large fits, and the solver that is asked for by name is not replaced silently.
TEST(VariableViscosity, SolverThatCannotIsRefusedByName) {
  FluidParameters parameters;
  parameters.viscosity = sample_viscosity(grid, [](const Vector3& r) { return sphere(r, 5.0, 0.2); });
  parameters.viscous_treatment = ViscousTreatment::implicit;
  parameters.velocity_solver = FftOptions{};
  NavierStokes fluid(grid, parameters, stirring, WallMotion::unsteady);
  EXPECT_THAT([&] { fluid.step(0.02); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("'fft'"), HasSubstr("'pcg'"))));
}

}  // namespace
}  // namespace vesiflow::fluid::navier_stokes_viscosity_test
