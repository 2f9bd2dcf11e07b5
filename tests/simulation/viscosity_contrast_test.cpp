// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "coupling/errors.h"
#include "coupling/simulation.h"
#include "run/plan.h"
#include "support/allocation_counter.h"
#include "support/shape_modes.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::viscosity_contrast_test {
namespace {

void advance(SceneSimulation& simulation, long steps) {
  for (long i = 0; i < steps; ++i) simulation.step();
}

vesicle::VectorField positions_after(const Scene& scene, long steps) {
  SceneSimulation simulation(scene);
  advance(simulation, steps);
  return simulation.membrane(0).positions();
}

Overrides with(std::initializer_list<std::string> more, const std::string& treatment = "extrapolated") {
  Overrides all{"fluid.viscous_treatment=" + treatment};
  all.insert(all.end(), more);
  return all;
}

// Two vesicles of different viscosities in a box for both.
Scene two_vesicles(const Overrides& overrides = {}) {
  Overrides all{"domain.upper=[6, 3, 3]", "domain.cells=[36, 24, 24]"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  Scene scene = small_scene(all);
  scene.vesicles[0].viscosity_ratio = 5.0;
  scene.vesicles.push_back(scene.vesicles[0]);
  scene.vesicles[1].centre = {3.0, 0.2, 0.3};
  scene.vesicles[1].shape = Shape::oblate;
  scene.vesicles[1].viscosity_ratio = 0.3;
  return scene;
}

TEST(ViscosityContrast, EqualViscositiesHaveNoFieldAndTakeNoTime) {
  SceneSimulation simulation(small_scene());
  advance(simulation, 2);
  EXPECT_EQ(simulation.viscosity(), nullptr);
  EXPECT_EQ(simulation.phases().indicator.entries, 0);
  const std::string plan = describe_plan(small_scene(), 1);
  EXPECT_NE(plan.find("- indicator                     skipped: the viscosity ratio of every vesicle is 1"),
            std::string::npos)
      << plan;
}

TEST(ViscosityContrast, FieldHoldsTheViscosityOfEachVesicle) {
  const Scene scene = two_vesicles();
  SceneSimulation simulation(scene);
  advance(simulation, 1);
  ASSERT_NE(simulation.viscosity(), nullptr);
  const fluid::Field<fluid::Cell>& mu = *simulation.viscosity();
  const auto at = [&](double x, double y, double z) {  // the cell that holds the point
    return mu(static_cast<int>((x + 3.0) * 4), static_cast<int>((y + 3.0) * 4), static_cast<int>((z + 3.0) * 4));
  };
  EXPECT_NEAR(at(0.1, 0.1, 0.1), 5.0, 0.1);
  EXPECT_NEAR(at(3.1, 0.1, 0.3), 0.3, 0.1);
  EXPECT_NEAR(at(1.6, -2.0, 2.0), 1.0, 0.02);
  double least = 1e300, greatest = 0.0, sum = 0.0;
  for (int k = 0; k < mu.extent(2); ++k)
    for (int j = 0; j < mu.extent(1); ++j)
      for (int i = 0; i < mu.extent(0); ++i) {
        least = std::min(least, mu(i, j, k));
        greatest = std::max(greatest, mu(i, j, k));
        sum += (mu(i, j, k) - 1.0) * mu.grid().cell_volume();
      }
  EXPECT_GE(least, 0.3);
  EXPECT_LE(greatest, 5.0);
  const double volume = 4.0 / 3.0 * std::numbers::pi;
  EXPECT_NEAR(sum, (4.0 - 0.7) * volume, 0.02 * volume);  // what limiting the field adds or takes
  EXPECT_EQ(mu(-1, 3, 4), mu(0, 3, 4));
  EXPECT_GT(simulation.phases().indicator.seconds, 0.0);
  EXPECT_GT(simulation.phases().fluid_viscous.seconds, 0.0);
}

// With a contrast that is hardly there the terms of a field must give what a number gives. (Not so the implicit treatment,
// which takes div(grad u*^T) along for a u* that is not yet free of divergence.)
TEST(ViscosityContrast, GoesOverIntoEqualViscosities) {
  const auto difference = [](const std::string& key) {
    const vesicle::VectorField equal = positions_after(small_scene({key}), 6);
    const vesicle::VectorField nearly = positions_after(small_scene({key, "fluid.viscosity_ratio=1.000001"}), 6);
    return (nearly - equal).abs().maxCoeff();
  };
  EXPECT_LT(difference("fluid.viscous_treatment=explicit"), 1e-6);
  EXPECT_LT(difference("fluid.viscous_treatment=extrapolated"), 1e-6);
  EXPECT_LT(difference("fluid.inertia=none"), 1e-6);
}

TEST(ViscosityContrast, ViscousVesiclesAreSlower) {
  const auto frequency = [](const char* ratio) {
    SceneSimulation simulation(small_scene({std::string("fluid.viscosity_ratio=") + ratio}));
    advance(simulation, 24);
    return simulation.measure().at(0).tank_treading_frequency;
  };
  const double thin = frequency("0.2"), equal = frequency("1"), thick = frequency("10");
  EXPECT_GT(thin, equal);
  EXPECT_GT(equal, thick);
}

// The three treatments solve the same equations: what sets them apart vanishes with the step. (Slower than the orders 1 and 2
// that libfluid's tests find, as the flow starts with a jolt: the membrane stops it.)
TEST(ViscosityContrast, TreatmentsAgreeInTheLimitOfSmallSteps) {
  const auto positions = [](const char* treatment, const std::string& step, long steps) {
    return positions_after(small_scene(with({"fluid.reynolds_number=1", "fluid.viscosity_ratio=5", "membrane.g=1",
                                             "domain.cells=16", "time.step=" + step},
                                            treatment)),
                           steps);
  };
  const vesicle::VectorField coarse = positions("implicit", "1/48", 12), fine = positions("implicit", "1/96", 24);
  const auto difference = [](const vesicle::VectorField& a, const vesicle::VectorField& b) {
    return (a - b).abs().maxCoeff();
  };
  const double explicit_coarse = difference(positions("explicit", "1/48", 12), coarse);
  const double explicit_fine = difference(positions("explicit", "1/96", 24), fine);
  const double extrapolated_coarse = difference(positions("extrapolated", "1/48", 12), coarse);
  const double extrapolated_fine = difference(positions("extrapolated", "1/96", 24), fine);
  EXPECT_GT(explicit_coarse / explicit_fine, 1.5);
  EXPECT_GT(extrapolated_coarse / extrapolated_fine, 2.0);
  EXPECT_LT(extrapolated_fine, explicit_fine / 2.0);
}

TEST(ViscosityContrast, VesiclesDoNotDependOnTheirOrder) {
  const Scene scene = two_vesicles();
  Scene swapped = scene;
  swapped.vesicles = {scene.vesicles[1], scene.vesicles[0]};
  SceneSimulation a(scene), b(swapped);
  advance(a, 6);
  advance(b, 6);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((a.membrane(i).positions() - b.membrane(1 - i).positions()).abs().maxCoeff(), 1e-12);
}

TEST(ViscosityContrast, GivesTheSameBitsForEveryNumberOfThreads) {
  const int before = omp_get_max_threads();
  for (const char* treatment : {"extrapolated", "implicit"}) {
    const Scene scene = two_vesicles(with({}, treatment));
    omp_set_num_threads(1);
    const vesicle::VectorField one = positions_after(scene, 3);
    omp_set_num_threads(3);
    const vesicle::VectorField three = positions_after(scene, 3);
    EXPECT_TRUE((one == three).all()) << treatment;
  }
  omp_set_num_threads(before);
}

TEST(ViscosityContrast, AWarmedUpStepAllocatesNothing) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  for (const char* treatment : {"explicit", "extrapolated"}) {
    SceneSimulation simulation(small_scene(with({"fluid.viscosity_ratio=5"}, treatment)));
    advance(simulation, 3);
    const long before = vesiflow::test::allocation_count();
    advance(simulation, 2);
    EXPECT_EQ(vesiflow::test::allocation_count() - before, 0) << treatment;
  }
}

TEST(ViscosityContrast, ASolverThatCannotIsRefusedWithItsKey) {
  try {
    small_scene(with({"fluid.viscosity_ratio=5", "fluid.velocity_solver=fft"}, "implicit"));
    FAIL() << "should be refused";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("fluid.velocity_solver = \"fft\""), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("fluid.viscous_treatment"), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(
      small_scene(with({"fluid.velocity_solver=fft"}, "implicit")));  // equal viscosities: nothing is coupled
  EXPECT_NO_THROW(small_scene(with({"fluid.viscosity_ratio=5", "fluid.velocity_solver=fft"}, "explicit")));
  EXPECT_NO_THROW(
      small_scene(with({"fluid.viscosity_ratio=5", "fluid.velocity_solver=fft", "fluid.inertia=none"}, "implicit")));
}

TEST(ViscosityContrast, PlanSaysWhatIsDoneAndWarnsOfStepsThatRing) {
  const auto expect_part = [](const Overrides& overrides, const char* part) {
    const std::string plan = describe_plan(small_scene(overrides), 1);
    EXPECT_NE(plan.find(part), std::string::npos) << part << "\n" << plan;
  };
  expect_part({"fluid.viscosity_ratio=5"}, "+ indicator                     viscosity between 1 and 5");
  expect_part({"fluid.viscosity_ratio=5"}, "extrapolated: 5 Lap u*");
  expect_part({"fluid.viscosity_ratio=5"}, "good for steps up to 0.0447");
  expect_part({"fluid.viscosity_ratio=0.05", "time.step=1/24", "membrane.g=4"}, "WARNING: its errors ring");
  expect_part(with({"fluid.viscosity_ratio=5"}, "implicit"), "implicit: all three components in one solve");
  expect_part({"fluid.viscosity_ratio=5", "method.preset=paper"}, "explicit (paper)");
  expect_part({"fluid.viscosity_ratio=5", "fluid.inertia=none"}, "fluid.viscous_treatment plays no part");
}

// Against theory, at a coarse resolution: validation/studies/viscosity_ratio.md has finer ones, where also the rates themselves
// come near to it. The delta function thickens the membrane and the layer of viscosity, which slows the modes down at both
// ratios, and a few per cent less at ratio 5; without a contrast in the flow the quotient would be 1, not 0.34 to 0.42.
TEST(ViscosityContrast, RelaxationOfShapeModesSlowsDownWithTheRatioAsInTheory) {
  const auto equal = test::measured_rates(test::shape_modes(3.0, 24, 16, 1.0));
  const auto five = test::measured_rates(test::shape_modes(3.0, 24, 16, 5.0));
  for (int n = 2; n <= 4; ++n) {
    const auto i = static_cast<std::size_t>(n - 2);
    const double theory = test::relaxation_rate(n, 5.0, 2.5) * (*test::wall_factors(3.0, 5.0))[i] /
                          (test::relaxation_rate(n, 1.0, 2.5) * (*test::wall_factors(3.0, 1.0))[i]);
    EXPECT_NEAR(five[i] / equal[i] / theory, 1.0, 0.1) << n;
  }
}

}  // namespace
}  // namespace vesiflow::coupling::viscosity_contrast_test
