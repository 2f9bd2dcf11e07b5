// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/thickness_correction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "coupling/errors.h"
#include "coupling/simulation.h"
#include "motion/sphere_response.h"
#include "support/shape_modes.h"
#include "support/small_scene.h"
#include "vesicle/shapes.h"

namespace vesiflow::coupling::thickness_correction_test {
namespace {

vesicle::Membrane sphere(double capillary_number, double sigma0) {
  const vesicle::SphereGrid grid(16);
  vesicle::MembraneParameters parameters;
  parameters.capillary_number = capillary_number;
  parameters.sigma0 = sigma0;
  return {vesicle::sphere(grid, {}), 16, parameters};
}

constexpr DeltaKernel kernel = DeltaKernel::smoothed_four_point;

// What the velocity along a membrane lacks is c h/mu to leading order: half of the mean over orientations of the sheet
// of the mean distance of two points that are chosen across it by the kernel (here by a midpoint rule). Lattices
// parallel to the sheet have a smaller c, by up to 0.07, which the mean over all positions sees as 0.03.
TEST(ThicknessCorrection, LacksTheKinkToFirstOrderAndIsOtherwiseOfSecond) {
  const vesicle::Membrane membrane = sphere(1.0, 1.0);
  for (const DeltaKernel any : delta_kernels) {
    const ThicknessCorrection coarse(membrane, any, 0.04, 1.0), fine(membrane, any, 0.02, 1.0);
    for (int n = 1; n < 4; ++n) {
      const double limit = 2.0 * fine.along(n) / 0.02 - coarse.along(n) / 0.04;
      EXPECT_LT(limit, thickening(any)) << name(any);
      EXPECT_GT(limit, thickening(any) - 0.03) << name(any);
      EXPECT_NEAR(coarse.smoothing(n) / fine.smoothing(n), 4.0, 0.4) << name(any);
    }
  }
}

// m_2 of a kernel's function, in squares of the spacing.
double second_moment(DeltaKernel any, Direction direction) {
  constexpr int points = 1000;  // per spacing
  const int half = support_width(any, direction) * points / 2;
  double sum = 0.0;
  for (int j = 0; j < half; ++j) {
    const double r = (j + 0.5) / points;
    sum += 2.0 * r * r * delta(any, r, direction) / points;
  }
  return sum;
}

// Long waves: a component i is spread and interpolated by 1 - h^2 (m_t q^2 + (m_n - m_t) q_i^2)/2 each, and the grid answers
// to a wave by 1/q^2 + h^2/12 sum q_i^4/q^4. In the mean over all directions (of n_i^4: 1/5) what is transverse has the answer
// (1 - alpha (q h)^2)/q^2, alpha = m_t + (m_n - m_t)/5 - 1/20. In motion/sphere_response.h that takes away, once what tension
// mixes is left out,
//   r_l^- = 2 R (l + 2)/pi int alpha h^2 q j_l j_{l+1} dq = alpha h^2 (l + 2)/(2 R),   r_l^+ = alpha h^2 (l - 1)/(2 R),
// by j_{n-1}(x) + j_{n+1}(x) = (2n + 1) j_n(x)/x and int x j_n j_{n+1} dx = pi/4 (Weber and Schafheitlin). The numbers of the
// response are good to 1e-5 of all of it (motion/constants.h), which is 1 % of these differences at most.
TEST(ThicknessCorrection, SharpensByWhatKernelAndGridSmoothOutToSecondOrder) {
  const vesicle::Membrane membrane = sphere(1.0, 1.0);
  for (const DeltaKernel any : delta_kernels) {
    const double along = second_moment(any, Direction::normal), across = second_moment(any, Direction::tangential);
    const double alpha = across + (along - across) / 5.0 - 1.0 / 20.0;
    const ThicknessCorrection coarse(membrane, any, 0.1, 1.0), fine(membrane, any, 0.05, 1.0);
    for (int l = 1; l < 5; ++l) {
      const double limit = 2.0 * fine.smoothing(l) / (0.05 * 0.05) - coarse.smoothing(l) / (0.1 * 0.1);
      const double minus = alpha * (l + 2.0) / 2.0, plus = alpha * (l - 1.0) / 2.0;
      const double mean = ((2.0 * l + 3.0) * minus + (2.0 * l - 1.0) * plus) / (4.0 * l + 2.0);
      EXPECT_NEAR(limit / (l == 1 ? minus : mean), 1.0, 0.01) << name(any) << ", degree " << l;
    }
  }
}

// A velocity per force per area is a length over a viscosity.
TEST(ThicknessCorrection, ScalesWithTheRadius) {
  const auto of_radius = [](double radius) {
    const vesicle::SphereGrid grid(16);
    const vesicle::Membrane membrane(radius * vesicle::sphere(grid, {}), 16, {});
    return ThicknessCorrection(membrane, kernel, 0.2 * radius, 1.0);
  };
  const ThicknessCorrection one = of_radius(1.0), two = of_radius(2.0);
  ASSERT_EQ(one.degrees(), two.degrees());
  for (int n = 0; n < one.degrees(); ++n) {
    EXPECT_NEAR(two.smoothing(n), 2.0 * one.smoothing(n), 1e-12);
    EXPECT_NEAR(two.along(n), 2.0 * one.along(n), 1e-12);
  }
}

// Where little is lost nothing is faded out: what is added along the sphere is all that the immersed answer mixes e+ and
// e- by (motion/sphere_response.h), which the exact one does not.
TEST(ThicknessCorrection, TakesAwayWhatTheImmersedAnswerMixes) {
  const vesicle::Membrane membrane = sphere(1.0, 1.0);
  constexpr double h = 0.05;
  const ThicknessCorrection correction(membrane, kernel, h, 1.0);
  const SphereResponse response(kernel, 1.0, h);
  for (int n = 1; n < 4; ++n) {
    const double mixed = response.immersed(n).mixed, t = n / (2.0 * n + 1.0);
    EXPECT_NEAR(mixed + correction.along(n) * std::sqrt(t * (1.0 - t)), 0.0, 1e-3 * std::abs(mixed)) << n;
  }
}

TEST(ThicknessCorrection, FallsWithTheViscosityAndIsPositive) {
  const vesicle::Membrane membrane = sphere(1.0, 1.0);
  for (const DeltaKernel any : delta_kernels) {
    const ThicknessCorrection one(membrane, any, 0.15, 1.0), three(membrane, any, 0.15, 3.0);
    for (int n = 0; n < one.degrees(); ++n) {
      EXPECT_GT(one.smoothing(n), 0.0);
      EXPECT_GE(one.along(n), 0.0);
      EXPECT_NEAR(one.smoothing(n) / three.smoothing(n), 3.0, 1e-12);
    }
  }
}

// A sphere whose tension is of degree 2, and degree 0, without force: a velocity along the gradient of the tension.
TEST(ThicknessCorrection, FollowsTheGradientOfTheTension) {
  vesicle::Membrane membrane = sphere(1e12, 10.0);
  const vesicle::VectorField x = membrane.positions();
  membrane.move_to(x, 1e-6 * (3.0 * x.col(2).square() - 1.0));
  membrane.compute_force();
  ThicknessCorrection correction(membrane, kernel, 0.1, 1.0);
  vesicle::VectorField velocity = vesicle::VectorField::Zero(x.rows(), 3);
  correction.add_to(membrane, vesicle::VectorField::Zero(x.rows(), 3), velocity);
  const vesicle::ScalarField z = x.col(2);  // grad of 3 z^2 on the unit sphere is 6 z (e_z - z n)
  for (int axis = 0; axis < 3; ++axis) {
    const vesicle::ScalarField expected = 6e-5 * z * ((axis == 2 ? 1.0 : 0.0) - z * x.col(axis)) * correction.along(2);
    EXPECT_LT((velocity.col(axis) - expected).abs().maxCoeff(), 1e-4 * velocity.abs().maxCoeff());
  }
}

// Components by their degree: a uniform force, one of components x y, and a pressure, which moves nothing.
TEST(ThicknessCorrection, SharpensTheComponentsOfTheWholeForce) {
  vesicle::Membrane membrane = sphere(1.0, 1.0);
  membrane.update_geometry();
  membrane.compute_force();  // of a sphere at rest: no tension
  const vesicle::VectorField& x = membrane.positions();
  ThicknessCorrection correction(membrane, kernel, 0.1, 2.0);
  vesicle::VectorField force = vesicle::VectorField::Zero(x.rows(), 3), velocity = force;
  force.col(0).setConstant(0.7);
  force.col(1) = x.col(0) * x.col(1);
  vesicle::VectorField expected = force;
  expected.col(0) *= correction.smoothing(0);
  expected.col(1) *= correction.smoothing(2);
  force += 5.0 * membrane.surface().normal();
  correction.add_to(membrane, force, velocity);
  EXPECT_LT((velocity - expected).abs().maxCoeff(), 1e-12);
}

// Rates of a coarse sphere in [-3,3]^3, 18 to 28 % low as they are, come within 5 % of theory in a sphere of this
// radius. The walls of a cube are farther away and slow it less: n = 2 lies between that theory and the one without
// walls, n = 3 and 4 are the same within 2 %.
TEST(ThicknessCorrection, BringsTheRatesOfACoarseSphereNearTheory) {
  SimulationParameters scene = test::quarter_of(test::shape_modes(3.0, 32, 24, 1.0));
  scene.coupling.thickness_correction = true;
  const auto rates = test::measured_rates(scene), walls = *test::wall_factors(3.0, 1.0);
  EXPECT_GT(rates[0], test::relaxation_rate(2, 1.0, 2.5) * walls[0]);
  EXPECT_LT(rates[0], test::relaxation_rate(2, 1.0, 2.5));
  for (int n = 3; n <= 4; ++n) {
    const auto i = static_cast<std::size_t>(n - 2);
    EXPECT_NEAR(rates[i] / (test::relaxation_rate(n, 1.0, 2.5) * walls[i]), 1.0, 0.05) << n;
  }
}

// The tank-treading of a coarse box moves towards that of a fine one: less inclined and faster.
TEST(ThicknessCorrection, MovesASimulationTheRightWay) {
  const auto after = [](const char* correction) {
    SceneSimulation simulation(
        small_scene({std::string("coupling.thickness_correction=") + correction, "membrane.g=1.5"}));
    for (int i = 0; i < 96; ++i) simulation.step();
    return simulation.measure().at(0);
  };
  const vesicle::Diagnostics thick = after("false"), thin = after("true");
  EXPECT_LT(thin.inclination_angle, thick.inclination_angle);
  EXPECT_GT(thin.tank_treading_frequency, thick.tank_treading_frequency);
}

TEST(ThicknessCorrection, IsRefusedWhereItIsUnstable) {
  const auto message = [](const char* key) -> std::string {
    try {
      small_scene({"coupling.thickness_correction=true", "membrane.g=1.5", key});
    } catch (const SceneError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("time.markers=euler"), "accepted");
  EXPECT_EQ(message("time.markers=shape_following"), "accepted");  // its implicit part is then that of a thin membrane
  EXPECT_NE(message("membrane.g=4").find("and here it is 4; take time.step <= 0.0052"), std::string::npos);
}

TEST(ThicknessCorrection, IsRefusedWhereInertiaCounts) {
  const std::string on = "coupling.thickness_correction=true", markers = "time.markers=shape_following";
  EXPECT_THROW(small_scene({on, markers, "fluid.reynolds_number=1"}), SceneError);
  EXPECT_NO_THROW(small_scene({on, markers, "fluid.reynolds_number=0.1"}));
  EXPECT_NO_THROW(small_scene({on, markers, "fluid.reynolds_number=1", "fluid.inertia=none"}));
}

}  // namespace
}  // namespace vesiflow::coupling::thickness_correction_test
