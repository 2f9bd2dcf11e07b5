// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/owed_force.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/constants.h"
#include "motion/flat_coefficients.h"
#include "vesicle/shapes.h"

namespace vesiflow::coupling::owed_force_test {
namespace {

constexpr int degrees = 8, latitudes = 12;
constexpr double radius = 1.4;

class OwedForceTest : public testing::Test {
 protected:
  OwedForceTest() : grid(latitudes), harmonics(degrees, grid, 4), surface(grid) {
    surface.update(vesicle::sphere(grid, {.effective_radius = radius}));
  }

  MembraneResponse response(double a, double mu) const {
    MembraneResponse modes(degrees, radius, 0.0, {});
    modes.update(a, mu);
    return modes;
  }

  /// Forces of one mode of the x component.
  static vesicle::Coefficients forces(int fields, int n, double value) {
    vesicle::Coefficients result(degrees, fields);
    result.set_zero();
    result(0, n, 1) = {value, 0.5 * value};
    return result;
  }

  double coefficient(const vesicle::VectorField& force, int n) const {
    vesicle::Coefficients c;
    harmonics.analysis(force, c);
    return c(0, n, 1).real();
  }

  vesicle::SphereGrid grid;
  vesicle::SphericalHarmonics harmonics;
  vesicle::Surface surface;
};

SurroundingFluid fluid(double reynolds_number, double ratio, bool extrapolates = true) {
  SurroundingFluid result{
      .has_inertia = true, .reynolds_number = reynolds_number, .extrapolates_viscosity = extrapolates};
  result.set_viscosities({ratio, std::max(1.0, ratio), ratio != 1.0});
  return result;
}

TEST_F(OwedForceTest, NothingIsOwedAtFirstOrToAFluidWithoutInertia) {
  SurroundingFluid still = fluid(1.0, 1.0);
  still.has_inertia = false;
  for (const SurroundingFluid& around : {fluid(1.0, 1.0), still}) {
    OwedForce owed(harmonics, 3, around);
    owed.find(0.1, Bdf2::of(0.1, 0.0), response(10.0, 1.0), surface);
    EXPECT_EQ(owed.force(), nullptr);
    if (around.has_inertia) continue;
    owed.add(forces(3, 2, 1.0));
    owed.find(0.1, Bdf2::of(0.1, 0.1), response(0.0, 1.0), surface);
    EXPECT_EQ(owed.force(), nullptr);
  }
}

// A correction that is the same in each step has been in the fluid's terms at old times for good: they lack a0 Re/dt
// e = a e of its velocity e whatever the steps, and mu_e e of the explicit viscosity, extrapolated or not. In forces
// that is minus the derivative of the answer with respect to a and mu, over the answer. Of the first a curved
// membrane owes less.
TEST_F(OwedForceTest, OfASteadyCorrectionIsWhatTheDiscreteStepOwes) {
  const double dt = 0.05, step = 1e-5;
  for (const bool extrapolates : {true, false})
    for (const double ratio : {1.0, 5.0, 0.2})
      for (const double last_dt : {0.05, 0.04, 0.1}) {
        const SurroundingFluid around = fluid(2.0, ratio, extrapolates);
        const Bdf2 scheme = Bdf2::of(dt, last_dt);
        const double a = around.acceleration(dt, scheme), mu = around.solved_viscosity;
        const auto velocity = [&](int n, double at_a, double at_mu) {
          return response(at_a, at_mu)[n].normal.velocity;
        };
        const double layers = constants::layers_of_curvature / radius;
        const double flat = 1.0 / (1.0 + layers * layers * mu / a);
        for (const int n : {2, 5}) {
          OwedForce owed(harmonics, 3, around);
          for (int i = 0; i < 2; ++i) owed.add(forces(3, n, 3.0));
          owed.find(dt, scheme, response(a, mu), surface);
          ASSERT_NE(owed.force(), nullptr);
          const double v = velocity(n, a, mu);
          const double of_a = -(velocity(n, a + step, mu) - velocity(n, a - step, mu)) / (2.0 * step * v);
          const double of_mu = -(velocity(n, a, mu + step) - velocity(n, a, mu - step)) / (2.0 * step * v);
          const double expected = 3.0 * (a * flat * of_a + around.remembered_viscosity() * of_mu);
          EXPECT_NEAR(coefficient(*owed.force(), n), expected, 1e-6 * std::abs(expected)) << n << ' ' << ratio;
        }
      }
}

// What the time derivative owes to one step alone is (1 + r), and then -r^2/(1 + r) of it: a correction is paid for
// once.
TEST_F(OwedForceTest, OfOneStepIsPaidBackInTheNextTwo) {
  const SurroundingFluid around = fluid(2.0, 1.0);
  const Bdf2 scheme = Bdf2::of(0.05, 0.1);
  const MembraneResponse modes = response(around.acceleration(0.05, scheme), 1.0);
  const int n = 3;
  OwedForce owed(harmonics, 3, around);
  owed.add(forces(3, n, 1.0));
  owed.find(0.05, scheme, modes, surface);
  const double next = coefficient(*owed.force(), n);
  owed.add(forces(3, n, 0.0));
  owed.find(0.05, scheme, modes, surface);
  const double after = coefficient(*owed.force(), n);
  EXPECT_NEAR(after / next, -0.25 / 1.5 / 1.5, 1e-12);
  owed.add(forces(3, n, 0.0));
  owed.find(0.05, scheme, modes, surface);
  EXPECT_NEAR(coefficient(*owed.force(), n), 0.0, 1e-14 * std::abs(next));
}

// A tension acts by its divergence on the surface.
TEST_F(OwedForceTest, OfATensionIsItsForce) {
  const SurroundingFluid around = fluid(2.0, 1.0);
  const Bdf2 scheme = Bdf2::of(0.05, 0.05);
  const MembraneResponse modes = response(around.acceleration(0.05, scheme), 1.0);
  vesicle::Coefficients forces(degrees, 4), tension(degrees, 1);
  forces.set_zero();
  tension.set_zero();
  forces(3, 4, 2) = {0.7, -0.2};
  tension(0, 4, 2) = {0.7, -0.2};
  OwedForce owed(harmonics, 4, around);
  owed.add(forces);
  owed.find(0.05, scheme, modes, surface);
  vesicle::ScalarField values(grid.size());
  vesicle::VectorField expected(grid.size(), 3);
  harmonics.synthesis(tension, values);
  surface.projector_divergence(values, expected);
  // The factor that one of its components shows is that of all.
  const double factor = (*owed.force() * expected).sum() / expected.square().sum();
  EXPECT_LT((*owed.force() - factor * expected).abs().maxCoeff(), 1e-12 * factor * expected.abs().maxCoeff());
  const double layers = constants::layers_of_curvature / radius;
  const double rate = 2.0 / 0.05 / (1.0 + layers * layers / around.acceleration(0.05, scheme));
  EXPECT_NEAR(factor, 2.0 * rate * modes[4].along.inertia, 1e-8 * factor);
}

TEST_F(OwedForceTest, ARestoredOneOwesTheSame) {
  const SurroundingFluid around = fluid(2.0, 5.0);
  const Bdf2 scheme = Bdf2::of(0.05, 0.04);
  const MembraneResponse modes = response(around.acceleration(0.05, scheme), around.solved_viscosity);
  OwedForce owed(harmonics, 4, around), other(harmonics, 4, around);
  owed.add(forces(4, 2, 1.0));
  owed.add(forces(4, 5, -0.3));
  const std::vector<double> last(owed.last().begin(), owed.last().end()),
      older(owed.older().begin(), owed.older().end());
  other.restore(owed.steps(), last, older);
  EXPECT_EQ(other.force(), nullptr);
  for (OwedForce* one : {&owed, &other}) one->find(0.05, scheme, modes, surface);
  EXPECT_TRUE((*owed.force() == *other.force()).all());
  other.restart();
  EXPECT_EQ(other.steps(), 0);
  other.find(0.05, scheme, modes, surface);
  EXPECT_EQ(other.force(), nullptr);
}

}  // namespace
}  // namespace vesiflow::coupling::owed_force_test
