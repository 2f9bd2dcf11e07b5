// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "coupling/errors.h"
#include "coupling/flow.h"
#include "coupling/mistakes.h"
#include "coupling/parameter_table.h"
#include "coupling/simulation.h"

namespace vesiflow::coupling::check_parameters_test {
namespace {

SimulationParameters one_vesicle() {
  SimulationParameters parameters;
  parameters.domain = {.lower = {-3, -3, -3}, .upper = {3, 3, 3}, .cells = {24, 24, 24}};
  parameters.mesh.latitudes = 16;
  parameters.vesicles.resize(1);
  parameters.vesicles[0].reduced_volume = 0.9;
  return parameters;
}

std::vector<std::string> mistakes_of(const SimulationParameters& parameters) {
  try {
    check(parameters, shear_flow(1.0, parameters.domain));
  } catch (const ParameterError& error) {
    return error.mistakes();
  }
  return {};
}

// Each of these was accepted once, or ran off an array.
TEST(CheckParameters, RefusesWhatAProgramFillsInWrong) {
  EXPECT_EQ(mistakes_of(one_vesicle()), std::vector<std::string>{});
  const auto refusal = [](const std::function<void(SimulationParameters&)>& spoil) {
    SimulationParameters parameters = one_vesicle();
    spoil(parameters);
    const std::vector<std::string> mistakes = mistakes_of(parameters);
    EXPECT_EQ(mistakes.size(), 1u) << testing::PrintToString(mistakes);
    return mistakes.empty() ? "accepted" : mistakes.front();
  };
  EXPECT_EQ(refusal([](auto& p) { p.time.step = -0.01; }), "time.step = -0.01: must be > 0");
  EXPECT_EQ(refusal([](auto& p) { p.fluid.viscosity_ratio = 5000.0; }),
            "fluid.viscosity_ratio = 5000: must be in [0.05, 100]");
  EXPECT_EQ(refusal([](auto& p) { p.vesicles[0].viscosity_ratio = 5000.0; }),
            "vesicles.0.viscosity_ratio = 5000: must be in [0.05, 100]");
  EXPECT_EQ(refusal([](auto& p) { p.time.markers = static_cast<MarkerMotion>(17); }),
            "time.markers = 17: this enumeration has the values 0 to 5");
  EXPECT_EQ(refusal([](auto& p) { p.membrane.sigma0 = std::numeric_limits<double>::quiet_NaN(); }),
            "membrane.sigma0 = nan: must be >= 0");
  EXPECT_EQ(refusal([](auto& p) {
              p.domain.cells = {24, 1, 24};
            }),
            "domain.cells = [24, 1, 24]: each must be in [8, 2048]");
  EXPECT_NE(refusal([](auto& p) { p.vesicles[0].centre = {2.9, 0, 0}; }).find("off the walls"), std::string::npos);
  EXPECT_EQ(refusal([](auto& p) {
              p.domain.cells = {96, 96, 96};
              p.fluid.pressure_solver = fluid::SolverKind::cholmod;
            }).rfind("fluid.pressure_solver = \"cholmod\": ", 0),
            0u);
  EXPECT_NE(refusal([](auto& p) { p.vesicles.clear(); }).find("at least one"), std::string::npos);
}

TEST(CheckParameters, SharpMembranesNeedAKernelThatKeepsThemOffWalls) {
  SimulationParameters parameters = one_vesicle();
  parameters.coupling.method = CouplingMethod::sharp;
  parameters.time.markers = MarkerMotion::shape_following;
  for (const DeltaKernel kernel : {DeltaKernel::three_point, DeltaKernel::four_point, DeltaKernel::smoothed_four_point,
                                   DeltaKernel::composite_bspline_32}) {
    parameters.coupling.kernel = kernel;
    parameters.domain.periodic = {};
    const std::vector<std::string> mistakes = mistakes_of(parameters);
    ASSERT_EQ(mistakes.size(), wall_clearance(kernel) < 1.5 ? 1u : 0u) << name(kernel);
    if (!mistakes.empty()) {
      EXPECT_NE(mistakes[0].find("must keep 1.5 grid spacings off walls"), std::string::npos);
    }
    parameters.domain.periodic = {true, true, true};
    try {
      check(parameters, flow_at_rest());
    } catch (const ParameterError& error) {
      FAIL() << error.what();
    }
  }
}

// Sharp membranes solve with one viscosity, whatever would be done with a field of it.
TEST(CheckParameters, SharpMembranesMayTakeFastTransformsAtAnyRatio) {
  SimulationParameters parameters = one_vesicle();
  parameters.fluid.viscosity_ratio = 5.0;
  parameters.fluid.inertia = fluid::Inertia::full;
  parameters.fluid.viscous_treatment = fluid::ViscousTreatment::implicit;
  parameters.fluid.velocity_solver = fluid::SolverKind::fft;
  EXPECT_EQ(mistakes_of(parameters).size(), 1u);
  parameters.coupling.method = CouplingMethod::sharp;
  parameters.time.markers = MarkerMotion::shape_following;
  EXPECT_EQ(mistakes_of(parameters), std::vector<std::string>{});
}

TEST(CheckParameters, GathersAllMistakes) {
  SimulationParameters parameters = one_vesicle();
  parameters.time.step = -1.0;
  parameters.mesh.latitudes = 7;
  parameters.vesicles[0].radius = 0.0;
  const std::vector<std::string> mistakes = mistakes_of(parameters);
  ASSERT_EQ(mistakes.size(), 3u);
  const std::string all = ParameterError(mistakes).what();
  EXPECT_TRUE(all.starts_with("3 mistakes:\n  1. mesh.latitudes = 7")) << all;
}

TEST(Mistakes, AreSaidOnceInTheOrderInWhichTheyAreFound) {
  Mistakes mistakes;
  EXPECT_NO_THROW(mistakes.refuse());
  mistakes.add("second letter");
  EXPECT_FALSE(mistakes.gather([] { throw ParameterError({"a letter", "second letter", "a word"}); }));
  EXPECT_TRUE(mistakes.gather([] {}));
  EXPECT_THROW(mistakes.gather([] { throw std::logic_error("no mistake of a parameter"); }), std::logic_error);
  try {
    mistakes.refuse();
    FAIL() << "should have refused";
  } catch (const ParameterError& error) {
    EXPECT_STREQ(error.what(), "3 mistakes:\n  1. second letter\n  2. a letter\n  3. a word");
  }
}

// The viscous layer of a step, sqrt(dt/Re), against the radius; inside, mu u has the Reynolds number Re/ratio.
TEST(SimulationParameters, TheFluidIsCorrectedWhereItsLayerIsThinnerThanTheVesicle) {
  SimulationParameters parameters = one_vesicle();
  parameters.coupling.method = CouplingMethod::sharp;
  parameters.time.markers = MarkerMotion::shape_following;
  parameters.fluid.inertia = fluid::Inertia::unsteady;
  parameters.fluid.reynolds_number = 0.05;
  EXPECT_TRUE(parameters.corrects_fluid(0.049));
  EXPECT_FALSE(parameters.corrects_fluid(0.051));
  parameters.vesicles[0].radius = 2.0;
  EXPECT_TRUE(parameters.corrects_fluid(0.19));
  EXPECT_FALSE(parameters.corrects_fluid(0.21));
  parameters.fluid.viscosity_ratio = 0.5;
  EXPECT_TRUE(parameters.corrects_fluid(0.39));
  EXPECT_FALSE(parameters.corrects_fluid(0.41));
  parameters.fluid.viscosity_ratio = 5.0;
  EXPECT_TRUE(parameters.corrects_fluid(0.19));
  EXPECT_FALSE(parameters.corrects_fluid(0.21));
  for (const auto& change :
       {std::function<void(SimulationParameters&)>([](auto& p) { p.coupling.method = CouplingMethod::delta; }),
        std::function<void(SimulationParameters&)>([](auto& p) { p.time.markers = MarkerMotion::implicit; }),
        std::function<void(SimulationParameters&)>([](auto& p) { p.fluid.inertia = fluid::Inertia::none; })}) {
    SimulationParameters other = parameters;
    change(other);
    EXPECT_FALSE(other.corrects_fluid(1e-6));
  }
}

TEST(CheckParameters, SimulationsAreCheckedToo) {
  SimulationParameters parameters = one_vesicle();
  parameters.time.step = -0.01;
  EXPECT_THROW(Simulation(parameters, shear_flow(1.0, parameters.domain)), ParameterError);
}

TEST(CheckParameters, FlowsThatDoNotFitTheDomainAreRefused) {
  SimulationParameters parameters = one_vesicle();
  parameters.domain.periodic = {false, false, true};
  EXPECT_THROW(check(parameters, shear_flow(1.0, parameters.domain)), ParameterError);
  EXPECT_NO_THROW(check(parameters, flow_at_rest()));
}

}  // namespace
}  // namespace vesiflow::coupling::check_parameters_test
