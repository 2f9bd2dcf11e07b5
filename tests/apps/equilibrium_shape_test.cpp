// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "equilibrium.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "arguments.h"
#include "program.h"
#include "stationarity.h"

namespace equilibrium {
namespace {

using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Independent of this code: the axisymmetric shape equations, by shooting and by collocation, to about 1e-11 in the energy. Energy
// (1/2) int H^2 dA, V = 4 pi / 3, tension and pressure in the same units.
struct Reference {
  Branch branch;
  double reduced_volume, energy, tension, pressure, polar_semi_axis, equatorial_radius, polar_curvature,
      equatorial_curvature;
};

void PrintTo(const Reference& reference, std::ostream* stream) {
  *stream << name_of(reference.branch) << ' ' << reference.reduced_volume;
}

constexpr Reference references[] = {
    {Branch::prolate, 0.95, 6.883637153659839, -1.295918976424514, -2.682000008252962, 1.3188976567236843,
     0.8435344961164373, 1.4625241822378041, 0.7406189548543349},
    {Branch::prolate, 0.75, 9.436303798378788, -1.1577261763965918, -2.8049707679888667, 1.9336628094966013,
     0.5426478204900091, 1.6523656089801884, 0.6855022670001627},
    {Branch::prolate, 0.65, 11.485222121159842, -1.518644119843369, -4.047719765246002, 2.4229422082283376,
     0.46339965669281885, 1.8157545903052288, 1.0277339624527801},
    {Branch::oblate, 0.9, 7.652041697380643, -1.432763392166568, -3.0740396573067668, 0.6092877279513936,
     1.2035954059898666, 0.03954936049326454, 1.418890304321908},
    {Branch::oblate, 0.65, 11.474563152950182, -0.9387359818570069, -2.5020609756151826, 0.220593944958536,
     1.426061838154635, -0.836800660602781, 1.6972982408582487},
};

std::vector<Method> methods_of_this_build() {
#ifdef VESIFLOW_WITH_SUNDIALS
  return {Method::newton, Method::gradient_flow, Method::kinsol, Method::cvode};
#else
  return {Method::newton, Method::gradient_flow};
#endif
}

class EquilibriumReference : public testing::TestWithParam<Reference> {};

// At 32 latitudes the truncation is below the accuracy of the reference in the energy, and near 1e-7 in the local values of the dumbbell.
TEST_P(EquilibriumReference, EnergyMultipliersAndAxesAgree) {
  const Reference& expected = GetParam();
  ConstrainedEnergy energy(32);
  const Equilibrium shape = find_equilibrium(energy, expected.branch, expected.reduced_volume, Method::newton, {});
  EXPECT_NEAR(shape.energy / expected.energy, 1, 1e-10);
  EXPECT_NEAR(shape.tension, expected.tension, 1e-7);
  EXPECT_NEAR(shape.pressure, expected.pressure, 1e-7);
  EXPECT_NEAR(shape.polar_semi_axis, expected.polar_semi_axis, 1e-7);
  EXPECT_NEAR(shape.equatorial_radius, expected.equatorial_radius, 1e-7);
  EXPECT_NEAR(shape.polar_mean_curvature, expected.polar_curvature, 1e-6);
  EXPECT_NEAR(shape.equatorial_mean_curvature, expected.equatorial_curvature, 1e-6);
}

TEST_P(EquilibriumReference, IdentitiesHold) {
  ConstrainedEnergy energy(32);
  const Equilibrium shape = find_equilibrium(energy, GetParam().branch, GetParam().reduced_volume, Method::newton, {});
  EXPECT_LE(std::abs(shape.area_error), 1e-12);
  EXPECT_LE(std::abs(shape.volume_error), 1e-12);
  EXPECT_LE(std::abs(shape.scaling_error), 1e-9);  // residual 1e-9 over a gradient of order one
  EXPECT_LE(shape.euler_lagrange_residual, 1e-5 * shape.largest_force);
  EXPECT_TRUE(shape.resolved());
}

INSTANTIATE_TEST_SUITE_P(Shapes, EquilibriumReference, testing::ValuesIn(references));

TEST(EquilibriumShape, AllMethodsAgree) {
  ConstrainedEnergy energy(24);
  for (const Reference& expected : {references[1], references[4]})
    for (const Method method : methods_of_this_build()) {
      const Equilibrium shape = find_equilibrium(energy, expected.branch, expected.reduced_volume, method, {});
      EXPECT_NEAR(shape.energy / expected.energy, 1, 1e-9) << name_of(expected.branch) << ' ' << name_of(method);
    }
}

TEST(EquilibriumShape, ErrorFallsGeometricallyWithLatitudes) {
  double last_error = 1e-5;
  for (const int latitudes : {12, 16, 20, 24}) {
    ConstrainedEnergy energy(latitudes);
    const Equilibrium shape = find_equilibrium(energy, Branch::prolate, 0.75, Method::newton, {});
    const double error = std::abs(shape.energy / references[1].energy - 1);
    EXPECT_LT(error, last_error / 4) << latitudes << " latitudes";
    last_error = error;
  }
}

// The derivative of the least energy with respect to the area at fixed volume is minus the tension.
TEST(EquilibriumShape, TensionIsTheSlopeOfTheEnergy) {
  constexpr double v = 0.8, step = 1e-3;
  ConstrainedEnergy energy(24);
  const auto at = [&](double reduced_volume) {
    return find_equilibrium(energy, Branch::oblate, reduced_volume, Method::newton, {});
  };
  const auto area = [](double reduced_volume) { return 4 * pi * std::pow(reduced_volume, -2.0 / 3); };
  const double slope = (at(v + step).energy - at(v - step).energy) / (area(v + step) - area(v - step));
  EXPECT_NEAR(slope, -at(v).tension, 1e-5);  // second order in the step
}

TEST(EquilibriumShape, NearTheSphereTheTensionIsThatOfTheSecondMode) {
  // Degree 2 is marginal at tension -6 kappa / r^2, which is -3/2 with kappa = c_b / 4; energy 2 pi (1 + 2 (1 - v)) to first order.
  ConstrainedEnergy energy(16);
  for (const Branch branch : {Branch::prolate, Branch::oblate}) {
    const Equilibrium shape = find_equilibrium(energy, branch, 1 - 1e-6, Method::newton, {});
    EXPECT_NEAR(shape.tension, -1.5, 2e-3);  // of order sqrt(1 - v)
    EXPECT_NEAR(shape.energy / (2 * pi) - 1, 2e-6, 5e-9);
  }
  const Equilibrium sphere = find_equilibrium(energy, Branch::oblate, 1, Method::newton, {});
  EXPECT_NEAR(sphere.energy / (2 * pi), 1, 1e-12);
  EXPECT_TRUE(std::isnan(sphere.tension));
}

TEST(EquilibriumShape, SaysWhereTheOblateBranchEnds) {
  ConstrainedEnergy energy(24);
  EXPECT_THAT([&] { find_equilibrium(energy, Branch::oblate, 0.45, Method::newton, {}); },
              ThrowsMessage<NotConverged>(HasSubstr("pass through each other")));
}

TEST(EquilibriumShape, SaysThatTheLimitOfIterationsWasReached) {
  ConstrainedEnergy energy(16);
  SolverOptions options;
  options.most_iterations = 1;
  EXPECT_THAT([&] { find_equilibrium(energy, Branch::prolate, 0.8, Method::gradient_flow, options); },
              ThrowsMessage<NotConverged>(HasSubstr("limit of iterations")));
}

#ifndef VESIFLOW_WITH_SUNDIALS
TEST(EquilibriumShape, NamesTheOptionOfABuildWithoutSundials) {
  ConstrainedEnergy energy(16);
  for (const Method method : {Method::kinsol, Method::cvode})
    EXPECT_THAT([&] { find_equilibrium(energy, Branch::prolate, 0.8, method, {}); },
                ThrowsMessage<MethodMissing>(HasSubstr("VESIFLOW_WITH_SUNDIALS")));
}
#endif

TEST(ConstrainedEnergy, GradientsAreTheDerivatives) {
  ConstrainedEnergy energy(32);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(energy.unknowns());
  x.head(5) << 1.1, 0.5, -0.1, 0.05, 0.02;
  energy.set(x);
  const Gradients gradients = energy.gradients();
  constexpr double step = 1e-5;
  for (Eigen::Index k = 0; k < 8; ++k) {
    Eigen::VectorXd ahead = x, behind = x;
    ahead[k] += step;
    behind[k] -= step;
    energy.set(ahead);
    const Functionals high = energy.functionals();
    energy.set(behind);
    const Functionals low = energy.functionals();
    EXPECT_NEAR(gradients.energy[k], (high.energy - low.energy) / (2 * step), 1e-8) << k;
    EXPECT_NEAR(gradients.area[k], (high.area - low.area) / (2 * step), 1e-8) << k;
    EXPECT_NEAR(gradients.volume[k], (high.volume - low.volume) / (2 * step), 1e-8) << k;
  }
}

TEST(ConstrainedEnergy, RefusesBadArguments) {
  EXPECT_THAT([] { ConstrainedEnergy energy(11); },
              ThrowsMessage<std::invalid_argument>("latitudes = 11: must be >= 12"));
  ConstrainedEnergy energy(12);
  EXPECT_THAT([&] { energy.set_reduced_volume(1.5); },
              ThrowsMessage<std::invalid_argument>("reduced_volume = 1.5: must be in (0, 1]"));
}

TEST(ParseReducedVolumes, IncludesBothEnds) {
  EXPECT_THAT(parse_reduced_volumes("0.9"), ElementsAre(0.9));
  EXPECT_THAT(parse_reduced_volumes("0.7:0.9:0.1"), ElementsAre(0.7, 0.8, 0.9));
  EXPECT_THAT(parse_reduced_volumes("0.9:0.75:0.1"), ElementsAre(0.9, 0.8));
}

}  // namespace
}  // namespace equilibrium
