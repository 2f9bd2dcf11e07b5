#include "thickness_correction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/errors.h"
#include "coupling/simulation.h"
#include "small_scene.h"
#include "vesicle/shapes.h"

namespace vesiflow::coupling {
namespace {

vesicle::Membrane sphere(double capillary_number, double sigma0) {
  const vesicle::SphereGrid grid(16);
  vesicle::MembraneParameters parameters;
  parameters.capillary_number = capillary_number;
  parameters.sigma0 = sigma0;
  return {vesicle::sphere(grid, {}), 16, parameters};
}

// 1/(2 pi mu) int (1 - g^2) {k_z^2, k^2}/(k^2 + k_z^2)^2 dk_z with g^2 = exp(-pi c^2 h^2 k_z^2), by the midpoint rule in
// the angle of (k, k_z), times what fades the degree.
double missing(double k, double h, double c, double viscosity, bool along) {
  constexpr int points = 20000;
  double sum = 0.0;
  for (int i = 0; i < points; ++i) {
    const double angle = (i + 0.5) / points * std::numbers::pi / 2.0, kz = k * std::tan(angle);
    const double part = along ? std::sin(angle) : std::cos(angle);
    sum += (1.0 - std::exp(-std::numbers::pi * std::pow(c * h * kz, 2))) * part * part;
  }
  return std::exp(-std::pow(k * h, 4)) * sum * std::numbers::pi / points / (2.0 * std::numbers::pi * viscosity * k);
}

TEST(ThicknessCorrection, IsWhatAPlaneSheetLacks) {
  const vesicle::Membrane membrane = sphere(1.0, 1.0);
  for (const DeltaKernel kernel : delta_kernels) {
    constexpr double h = 0.15, viscosity = 3.0;
    const ThicknessCorrection correction(membrane, kernel, h, viscosity);
    for (int n = 1; n < 8; ++n) {
      EXPECT_NEAR(correction.along(n) / missing(n + 0.5, h, thickening(kernel), viscosity, true), 1.0, 1e-6);
      EXPECT_NEAR(correction.normal(n) / missing(n + 0.5, h, thickening(kernel), viscosity, false), 1.0, 1e-6);
    }
  }
}

// c h/mu along the membrane and pi c^2 h^2 k/(4 mu) normal to it, with errors one order higher in h.
TEST(ThicknessCorrection, IsOfFirstOrderAlongAndOfSecondNormal) {
  const vesicle::Membrane membrane = sphere(1.0, 1.0);
  const double c = thickening(DeltaKernel::smoothed_four_point), k = 2.5;
  const auto errors = [&](double h) {
    const ThicknessCorrection correction(membrane, DeltaKernel::smoothed_four_point, h, 1.0);
    return std::array{std::abs(correction.along(2) / (c * h) - 1.0),
                      std::abs(correction.normal(2) / (std::numbers::pi * c * c * h * h * k / 4.0) - 1.0)};
  };
  const auto coarse = errors(0.02), fine = errors(0.01);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(fine[i], 0.05);
    EXPECT_NEAR(coarse[i] / fine[i], 2.0, 0.05);
  }
}

// A sphere whose tension is sigma0 a Y_2^0-like: strains of degree 2 give a velocity along the gradient of the tension.
TEST(ThicknessCorrection, FollowsTheGradientOfTheTension) {
  vesicle::Membrane membrane = sphere(1e12, 10.0);
  const vesicle::VectorField x = membrane.positions();
  const vesicle::ScalarField strain = 1e-6 * (3.0 * x.col(2).square() - 1.0);
  membrane.move_to(x, strain);
  membrane.compute_force();
  ThicknessCorrection correction(membrane, DeltaKernel::smoothed_four_point, 0.1, 1.0);
  vesicle::VectorField velocity = vesicle::VectorField::Zero(x.rows(), 3);
  correction.add_to(membrane, velocity);
  // grad of 3 z^2 on the unit sphere is 6 z (e_z - z n); the normal force -2 H sigma = -2 sigma is of degree 2 too.
  const vesicle::ScalarField z = x.col(2), sigma = 10.0 * strain;
  for (int axis = 0; axis < 3; ++axis) {
    const vesicle::ScalarField tangent = (axis == 2 ? 1.0 : 0.0) - z * x.col(axis);
    const vesicle::ScalarField expected =
        6e-5 * z * tangent * correction.along(2) - 2.0 * sigma * x.col(axis) * correction.normal(2);
    EXPECT_LT((velocity.col(axis) - expected).abs().maxCoeff(), 1e-4 * velocity.abs().maxCoeff());
  }
}

// The tank-treading of a coarse box moves towards that of a fine one: less inclined and faster.
TEST(ThicknessCorrection, MovesASimulationTheRightWay) {
  const auto after = [](const char* correction) {
    Simulation simulation(small_scene({std::string("coupling.thickness_correction=") + correction, "membrane.g=1.5"}));
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
  EXPECT_NE(message("membrane.g=4").find("this scene has 4; take time.step <= 0.0052"), std::string::npos);
}

}  // namespace
}  // namespace vesiflow::coupling
