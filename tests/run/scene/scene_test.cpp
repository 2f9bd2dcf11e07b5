// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/scene.h"

#include <gtest/gtest.h>

#include <functional>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "coupling/marker_integrator.h"
#include "coupling/validity.h"
#include "run/errors.h"
#include "run/plan.h"

namespace vesiflow::run::scene_test {
namespace {

const std::string sphere = "[[vesicles]]\nshape = \"sphere\"\n";

Scene parse(const std::string& text, const Overrides& overrides = {}) {
  return parse_scene(text, "test.toml", overrides);
}

std::string message_of(const std::string& text, const Overrides& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_parts(const std::string& message, std::initializer_list<const char*> parts) {
  for (const char* part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
}

TEST(Scene, ReadsKeysFractionsAndOverrides) {
  const Scene scene = parse("[domain]\ncells = [32, 48, 40]\n[time]\nstep = \"1/384\"\nend = 2\n" + sphere,
                            {"time.end=3.5", "vesicles.0.radius=0.5", "mesh.filter=components", "membrane.sigma0=0"});
  EXPECT_EQ(scene.domain.cells, (std::array<int, 3>{32, 48, 40}));
  EXPECT_EQ(scene.time.step, 1.0 / 384.0);
  EXPECT_EQ(scene.time.end, 3.5);
  EXPECT_EQ(scene.vesicles[0].radius, 0.5);
  EXPECT_EQ(scene.mesh.filter, vesicle::FilterOrder::components);
  EXPECT_EQ(scene.membrane.sigma0, 0.0);
}

TEST(Scene, PresetSetsDefaultsThatKeysStillOverride) {
  const Scene paper = parse("[method]\npreset = \"paper\"\n[membrane]\nvolume = \"none\"\n" + sphere);
  EXPECT_EQ(paper.membrane.laplacian, vesicle::LaplacianForm::paper);
  EXPECT_EQ(paper.membrane.volume, vesicle::VolumeControl::none);
  EXPECT_EQ(parse(sphere, {"method.preset=paper"}).membrane.volume, vesicle::VolumeControl::penalty);
  EXPECT_EQ(parse(sphere).membrane.volume, vesicle::VolumeControl::projection);
}

// What docs/time_integration.md recommends; the paper's preset has the paper's markers, which that step and tension would blow up.
TEST(Scene, DefaultStepAndTensionBelongToTheDefaultMarkers) {
  const Scene standard = parse(sphere), paper = parse(sphere, {"method.preset=paper"});
  EXPECT_EQ(standard.time.markers, coupling::MarkerMotion::shape_following);
  EXPECT_EQ(standard.time.step, 1.0 / 48.0);
  EXPECT_EQ(standard.membrane.sigma0, 2000.0);
  EXPECT_EQ(paper.time.markers, coupling::MarkerMotion::euler);
  EXPECT_EQ(paper.time.step, 1.0 / 192.0);
  EXPECT_EQ(paper.membrane.sigma0, 600.0);
  EXPECT_LT(paper.tension_number(), paper.stable_tension_number());
  expect_parts(message_of(sphere, {"time.markers=euler"}), {"time.step = 0.0208", "far beyond", "sigma0 <="});
}

TEST(Scene, AccuracyChoosesGridMeshAndStep) {
  const std::string box = "[domain]\nlower = [-4, 0, -4]\nupper = [4, 4, 4]\n", small = sphere + "radius = 0.5\n";
  const Scene scene =
      parse("[method]\naccuracy = \"1e-2\"\n[flow]\nrate = 2\n" + box + sphere + "centre = [0, 2, 0]\n");
  EXPECT_EQ(scene.domain.cells, (std::array<int, 3>{64, 32, 64}));  // h = R/8
  EXPECT_EQ(scene.mesh.latitudes, 40);
  EXPECT_EQ(scene.time.step, 1.0 / 192.0);
  EXPECT_TRUE(scene.coupling.thickness_correction);
  EXPECT_EQ(parse(to_toml(scene)).time.step, scene.time.step);
  // The smallest vesicle decides on the grid, the softest time scale of a stiff membrane on the step.
  EXPECT_EQ(
      parse(small, {"method.accuracy=1e-2", "domain.lower=[-4, -4, -4]", "domain.upper=[4, 4, 4.5]"}).domain.cells,
      (std::array<int, 3>{128, 128, 144}));  // 136 has the factor 17
  EXPECT_EQ(parse(sphere, {"method.accuracy=1e-2", "membrane.capillary_number=0.5"}).time.step, 1.0 / 192.0);
}

TEST(Scene, AccuracyTakesSharpMembranesWhereTheCorrectionOfTheThicknessDoesNotReach) {
  const std::string accurate = "method.accuracy=1e-2";
  for (const char* key : {"fluid.viscosity_ratio=5", "fluid.reynolds_number=1", "coupling.method=sharp"}) {
    const Scene scene = parse(sphere, {accurate, key});
    EXPECT_EQ(scene.coupling.method, coupling::CouplingMethod::sharp) << key;
    EXPECT_FALSE(scene.coupling.thickness_correction) << key;
    EXPECT_EQ(scene.domain.cells, (std::array<int, 3>{96, 96, 96})) << key;
    EXPECT_EQ(describe_plan(scene, 1).find("not met"), std::string::npos) << key;
  }
  // The convection of a fast flow asks for shorter steps than the flow's rate.
  const Scene fast = parse(sphere, {accurate, "fluid.reynolds_number=10", "domain.cells=192"});
  EXPECT_LE(fast.time.step,
            coupling::stable_convection_step(parse(sphere, {accurate, "fluid.reynolds_number=10"}), flow_of(fast)));
  expect_parts(describe_plan(parse(sphere, {accurate, "fluid.viscosity_ratio=5", "coupling.method=delta",
                                            "coupling.thickness_correction=false"}),
                             1),
               {"not met for certain", "coupling.method = \"delta\""});
}

TEST(Scene, GivenKeysWinOverTheAccuracyAndAreSaidToSpoilIt) {
  const Scene coarse =
      parse(sphere, {"method.accuracy=1e-2", "domain.cells=48", "time.step=1/24", "mesh.latitudes=32"});
  EXPECT_EQ(coarse.domain.cells, (std::array<int, 3>{48, 48, 48}));
  EXPECT_EQ(coarse.time.step, 1.0 / 24.0);
  expect_parts(describe_plan(coarse, 1),
               {"not met for certain", "domain.cells below 96", "fewer than 40", "time.step above 1/96"});
  EXPECT_EQ(describe_plan(parse(sphere, {"method.accuracy=1e-2"}), 1).find("not met"), std::string::npos);
}

TEST(Scene, AccuracyIsRefusedWhereNoSettingsAreKnown) {
  expect_parts(message_of(sphere, {"method.accuracy=1e-4"}), {"1e-4", "no settings are known"});
  expect_parts(message_of(sphere, {"method.accuracy=1e-2", "fluid.reynolds_number=20"}),
               {"1e-2", "reynolds_number = 20", "<= 10"});
  EXPECT_EQ(message_of(sphere, {"method.accuracy=1e-3", "fluid.reynolds_number=1", "fluid.viscosity_ratio=5"}),
            "accepted");
  expect_parts(message_of(sphere, {"method.accuracy=1e-3", "fluid.reynolds_number=6"}),
               {"1e-3", "reynolds_number = 6", "<= 5"});
  expect_parts(message_of(sphere, {"method.accuracy=1e-2", "fluid.reynolds_number=1", "fluid.viscosity_ratio=6"}),
               {"1e-2", "factor of 6", "reynolds_number = 1", "<= 5"});
  expect_parts(message_of(sphere, {"method.accuracy=1e-2", "fluid.viscosity_ratio=0.1"}), {"1e-2", "ratio 0.1"});
  expect_parts(message_of(sphere, {"method.accuracy=1e-2", "method.preset=paper"}), {"1e-2", "paper"});
  expect_parts(message_of(sphere, {"method.accuracy=0.5"}), {"0.5", "1e-2"});
  expect_parts(message_of(sphere, {"method.accuracy=1e-2", "domain.lower=[1, 1e9, 1]"}), {"domain"});
}

TEST(Scene, NamesThatAreNumbersMayBeGivenAsNumbers) {
  EXPECT_EQ(parse(sphere, {"membrane.upsampling=1.5"}).membrane.upsampling, vesicle::Upsampling::three_halves);
}

TEST(Scene, VesiclesMayHaveAViscosityRatioOfTheirOwn) {
  const Scene scene = parse("[fluid]\nviscosity_ratio = 5\n" + sphere + sphere,
                            {"vesicles.1.centre=[4, 0, 0]", "vesicles.1.viscosity_ratio=20"});
  EXPECT_EQ(scene.viscosity_ratio(0), 5.0);
  EXPECT_EQ(scene.viscosity_ratio(1), 20.0);
  EXPECT_TRUE(scene.has_viscosity_contrast());
  EXPECT_FALSE(
      parse("[fluid]\nviscosity_ratio = 5\n" + sphere, {"vesicles.0.viscosity_ratio=1"}).has_viscosity_contrast());
  EXPECT_FALSE(parse(sphere).has_viscosity_contrast());
}

TEST(Scene, PaperPresetTakesThePapersViscousTerm) {
  EXPECT_EQ(parse(sphere).fluid.viscous_treatment, fluid::ViscousTreatment::extrapolated);
  EXPECT_EQ(parse(sphere, {"method.preset=paper"}).fluid.viscous_treatment, fluid::ViscousTreatment::explicit_);
}

TEST(Scene, TensionNumberIsAnotherWayToGiveSigma0) {
  const std::string text = "[time]\nstep = \"1/192\"\n" + sphere;
  EXPECT_NEAR(parse(text, {"membrane.g=25/6"}).membrane.sigma0, 600.0, 1e-9);
  EXPECT_NEAR(parse(text, {"membrane.sigma0=600"}).tension_number(), 25.0 / 6.0, 1e-12);
  expect_parts(message_of(text, {"membrane.g=2.0", "membrane.sigma0=600"}), {"g = 2", "disagree"});
  expect_parts(message_of(text, {"membrane.g=1e308"}), {"g = 1e+308", "too large"});
}

TEST(Scene, FractionsMayHaveBlanks) {
  for (const char* step : {"1/192", "1 / 192", " 1\t/ 192 "})
    EXPECT_EQ(parse(std::string("[time]\nstep = \"") + step + "\"\n" + sphere).time.step, 1.0 / 192) << step;
  for (const char* step : {" / 192", "1 / ", "1 9/2", "/"})
    expect_parts(message_of(std::string("[time]\nstep = \"") + step + "\"\n" + sphere), {"time.step"});
}

TEST(Scene, WritesItselfAndReadsBackTheSame) {
  const std::string vesicle = "[[vesicles]]\nshape = \"prolate\"\nreduced_volume = 0.9\nrotation_deg = 30\n";
  const Scene scene = parse("title = \"a \\\"quoted\\\" title\"\n[time]\nstep = \"1/384\"\n" + vesicle);
  const std::string text = to_toml(scene);
  EXPECT_EQ(to_toml(parse(text)), text);
  EXPECT_EQ(parse(text).time.step, scene.time.step);
}

// A checkpoint has the scene in it: a title that does not read back would make it useless.
TEST(Scene, WritesTitlesOfAnyCharacters) {
  const std::string title = R"("\u0000 \u0001\t\n\r\u001b\u007f \\ \" é")";
  const Scene scene = parse("title = " + title + "\n" + sphere);
  ASSERT_EQ(scene.title, std::string("\0 \1\t\n\r\x1b\x7f \\ \" \xc3\xa9", 15));
  EXPECT_EQ(parse(to_toml(scene)).title, scene.title);
}

TEST(Scene, RefusesBadValuesWithFileLineKeyValueAndRange) {
  expect_parts(message_of("[fluid]\nreynolds_number = -1\n" + sphere),
               {"test.toml:2", "fluid.reynolds_number = -1", "> 0"});
  expect_parts(message_of("[fluid]\nviscosity_ratio = -2.0\n" + sphere),
               {"test.toml:2", "fluid.viscosity_ratio", "in [0.05, 100]"});
  expect_parts(message_of("[fluid]\nviscous_treatment = \"semi\"\n" + sphere),
               {"test.toml:2", "fluid.viscous_treatment", "semi", "explicit, extrapolated, implicit"});
  expect_parts(message_of(sphere, {"vesicles.0.viscosity_ratio=0.01"}),
               {"vesicles.0.viscosity_ratio = 0.01", "in [0.05, 100]"});
  expect_parts(message_of("[domain]\ncells = \"many\"\n" + sphere), {"test.toml:2", "domain.cells", "many", "whole"});
  expect_parts(message_of("[domain]\nlower = [0, 0]\n" + sphere), {"domain.lower", "three numbers"});
  expect_parts(message_of("[time]\nstep = nan\n" + sphere), {"test.toml:2", "time.step", "> 0"});
  expect_parts(message_of("[flow]\ntype = \"sheer\"\n" + sphere), {"test.toml:2", "flow.type", "sheer", "rest, shear"});
  expect_parts(message_of("[fluid]\ninertia = \"some\"\n" + sphere), {"fluid.inertia", "full", "unsteady", "none"});
  expect_parts(message_of(sphere, {"mesh.latitudes=7"}), {"--set", "mesh.latitudes = 7", "in [8, 256]"});
  expect_parts(message_of("[domain]\nperiodic = true\n" + sphere), {"test.toml:2", "domain.periodic", "three of true"});
  expect_parts(message_of("[domain]\nperiodic = [true, 1, false]\n" + sphere), {"domain.periodic", "three of true"});
  expect_parts(message_of(sphere, {"repulsion.walls=1"}), {"--set", "repulsion.walls = 1", "true or false"});
  expect_parts(message_of(sphere, {"repulsion.range=-0.1"}), {"repulsion.range = -0.1", ">= 0"});
  expect_parts(message_of(sphere, {"repulsion.strength=-1"}), {"repulsion.strength = -1", ">= 0"});
  expect_parts(message_of(sphere, {"gravity.acceleration=[0, 1]"}), {"gravity.acceleration", "three numbers"});
  expect_parts(message_of(sphere, {"flow.angular_frequency=-1"}), {"flow.angular_frequency = -1", ">= 0"});
  expect_parts(message_of(sphere, {"flow.extension=biaxial"}), {"flow.extension", "biaxial", "planar, uniaxial"});
  expect_parts(message_of(sphere, {"flow.peak_velocity=inf"}), {"flow.peak_velocity = inf", "finite"});
  expect_parts(message_of(sphere, {"vesicles.0.capillary_number=0"}), {"vesicles.0.capillary_number = 0", "> 0"});
  expect_parts(message_of(sphere, {"vesicles.0.sigma0=-1"}), {"vesicles.0.sigma0 = -1", ">= 0"});
  expect_parts(message_of(sphere, {"vesicles.0.latitudes=300"}), {"vesicles.0.latitudes = 300", "in [8, 256]"});
  expect_parts(message_of(sphere, {"vesicles.0.spontaneous_curvature=big"}), {"spontaneous_curvature", "a number"});
  expect_parts(message_of(sphere, {"vesicles.0.density_difference=nan"}), {"density_difference = nan", "finite"});
}

// Found by fuzz/scene.cpp: a zero in a key ended the message.
TEST(Scene, RefusalsArePrintable) {
  expect_parts(message_of("\"\\u0000\\u001b[2J\" = 1\n" + sphere), {"??[2J", "there is no such key"});
  expect_parts(message_of("title = [\"\\u0000\"]\n" + sphere), {"title = ", "must be text"});
}

TEST(Scene, RefusesUnknownKeysAndSuggestsOne) {
  expect_parts(message_of("[fluid]\nreynolds = 1\n" + sphere),
               {"test.toml:2", "fluid.reynolds", "did you mean fluid.reynolds_number"});
  expect_parts(message_of("[[vesicles]]\nshape = \"sphere\"\ncenter = [0, 0, 0]\n"),
               {"test.toml:3", "vesicles.0.center", "vesicles.0.centre"});
  expect_parts(message_of("[solver]\nkind = 1\n" + sphere), {"solver"});
  expect_parts(message_of(sphere, {"time.ned=3"}), {"--set", "time.ned", "time.end"});
  expect_parts(message_of(sphere, {"time.end"}), {"--set time.end", "key=value"});
  expect_parts(message_of(sphere, {"vesicles.3.radius=1"}), {"vesicles.3"});
}

// A table that is misspelt, a key under another table, a key by the name that others give it.
TEST(Scene, NamesTheKeyOrTableThatWasMeant) {
  expect_parts(message_of("[membran]\nsigma0 = 1\n" + sphere), {"test.toml:1: [membran]", "did you mean [membrane]?"});
  expect_parts(message_of("[Time]\nend = 1\n" + sphere), {"test.toml:1: [Time]", "did you mean [time]?"});
  const std::string vesicle = message_of("title = \"\"\n[[vesicle]]\nshape = \"sphere\"\n");
  expect_parts(vesicle, {"test.toml:2: [[vesicle]]", "did you mean [[vesicles]]?"});
  EXPECT_EQ(vesicle.find("at least one"), std::string::npos) << vesicle;
  expect_parts(message_of("[flow]\nend = 3\n" + sphere),
               {"test.toml:2: flow.end", "did you mean time.end, that is end under [time]?"});
  expect_parts(
      message_of("reduced_volume = 0.9\n" + sphere),
      {"test.toml:1: reduced_volume", "vesicles.0.reduced_volume, that is reduced_volume under [[vesicles]]?"});
  expect_parts(message_of(sphere + sphere + "lattitudes = 16\n"),
               {"test.toml:5", "did you mean vesicles.1.latitudes?"});
  expect_parts(message_of("[time]\ndt = 0.1\n" + sphere), {"time.dt", "did you mean time.step?"});
  expect_parts(message_of(sphere, {"tim.end=3"}),
               {"--set tim.end=3", "did you mean time.end, that is end under [time]?"});
  expect_parts(message_of(sphere, {"time=3"}), {"--set time=3", "time is a table of keys"});
  expect_parts(message_of("time = 3\n" + sphere), {"test.toml:1: time = 3", "headed [time]"});
  EXPECT_EQ(message_of("[fluid]\nxyzzy = 3\n" + sphere).find("did you mean"), std::string::npos);
}

TEST(Scene, ListsAllMistakesInTheOrderOfTheirLines) {
  const std::string text =
      "[fluid]\nviscosity = 2\nreynolds_number = -1\n[time]\nend = 0\n[[vesicles]]\nshape = \"sphere\"\ncenter = 0\n";
  EXPECT_EQ(message_of(text, {"mesh.latitudes=7"}),
            "5 mistakes:\n"
            "  1. --set: mesh.latitudes = 7: must be in [8, 256]\n"
            "  2. test.toml:2: fluid.viscosity: there is no such key; did you mean fluid.viscosity_ratio? "
            "(docs/scene.md lists all)\n"
            "  3. test.toml:3: fluid.reynolds_number = -1: must be > 0\n"
            "  4. test.toml:5: time.end = 0: must be > 0\n"
            "  5. test.toml:8: vesicles.0.center: there is no such key; did you mean vesicles.0.centre? "
            "(docs/scene.md lists all)");
  // And those of keys that do not go together.
  expect_parts(message_of("[time]\nend = 0.001\n[[vesicles]]\nshape = \"prolate\"\n" + sphere + "centre = [9, 0, 0]\n"),
               {"3 mistakes", "time.end = 0.001", "vesicles.0: a prolate", "vesicles.1.centre = [9, 0, 0]"});
}

TEST(Scene, OneTableOfVesiclesIsAVesicle) {
  const Scene scene = parse("[vesicles]\nshape = \"sphere\"\nradius = 0.5\n", {"vesicles.0.sigma0=100"});
  ASSERT_EQ(scene.vesicles.size(), 1U);
  EXPECT_EQ(scene.vesicles[0].radius, 0.5);
  EXPECT_EQ(scene.sigma0(0), 100.0);
  EXPECT_NE(to_toml(scene).find("\n[[vesicles]]\n"), std::string::npos);
  expect_parts(message_of("[vesicles]\nshape = \"sphere\"\nradius = 0\n"), {"test.toml:3", "vesicles.0.radius = 0"});
}

TEST(Scene, OverridesOfTheOnlyVesicleNeedNoNumber) {
  EXPECT_EQ(parse(sphere, {"vesicles.radius=0.5"}).vesicles[0].radius, 0.5);
  EXPECT_EQ(parse(sphere, {" vesicles.0.radius = 0.5 "}).vesicles[0].radius, 0.5);
  const std::string two = sphere + "centre = [3, 0, 0]\n" + sphere;
  expect_parts(message_of(two, {"vesicles.radius=0.5"}),
               {"which of the 2 vesicles", "vesicles.0.radius", "vesicles.1.radius"});
  expect_parts(message_of(two, {"vesicles.2.radius=0.5"}), {"no such vesicle", "vesicles.0 to vesicles.1"});
  expect_parts(message_of(sphere, {"vesicles.99999999999999999999.radius=1"}),
               {"no such vesicle", "only one is vesicles.0"});
}

// What is not given adapts to what is.
TEST(Scene, DefaultDegreesAlongTheMembraneAreAtMostTheLatitudes) {
  EXPECT_EQ(parse(sphere).mesh.tangential_degrees, 15);
  const Scene few = parse(sphere, {"time.markers=euler", "time.step=1/384", "mesh.latitudes=12"});
  EXPECT_EQ(few.mesh.tangential_degrees, 12);
  EXPECT_EQ(to_toml(parse(to_toml(few))), to_toml(few));
  EXPECT_EQ(parse(sphere, {"vesicles.0.latitudes=10"}).mesh.tangential_degrees, 10);
  expect_parts(
      message_of(sphere, {"time.markers=euler", "time.step=1/384", "mesh.latitudes=12", "mesh.tangential_degrees=13"}),
      {"mesh.tangential_degrees = 13", "mesh.latitudes = 12"});
}

TEST(Scene, SaysOfInfiniteValuesThatTheyMustBeFinite) {
  expect_parts(message_of("[membrane]\ncapillary_number = inf\n" + sphere),
               {"test.toml:2", "membrane.capillary_number = inf", "must be finite and > 0"});
  expect_parts(message_of(sphere, {"time.step=1/0"}), {"time.step = '1/0'", "must be finite and > 0"});
}

TEST(Scene, RefusesWhatNoSingleKeyIsToBlameFor) {
  expect_parts(message_of(sphere, {"time.markers=euler", "time.step=0.2"}), {"time.step = 0.2", "g =", "time.step <="});
  expect_parts(message_of(sphere, {"time.step=100", "time.end=1000", "membrane.sigma0=0"}), {"time.step", "0.25"});
  expect_parts(message_of(sphere, {"time.step=9"}), {"time.step = 9", "time.end"});
  expect_parts(message_of(sphere, {"vesicles.0.centre=[5.5, 0, 0]"}), {"vesicles.0.centre", "along x", "walls"});
  expect_parts(message_of(sphere, {"domain.upper=[-7, 6, 6]"}), {"domain.upper[0]", "above domain.lower[0]"});
  expect_parts(message_of("[[vesicles]]\nshape = \"prolate\"\n"), {"vesicles.0", "reduced_volume or aspect_ratio"});
  expect_parts(message_of("[[vesicles]]\nshape = \"sphere\"\naspect_ratio = 2\n"),
               {"vesicles.0", "prolate and oblate"});
  expect_parts(message_of(sphere + sphere), {"vesicles.0 and vesicles.1 overlap"});
  expect_parts(message_of("title = \"empty\"\n"), {"vesicles"});
  expect_parts(message_of(sphere, {"coupling.method=delta", "fluid.viscosity_ratio=5",
                                   "fluid.viscous_treatment=implicit", "fluid.velocity_solver=fft"}),
               {"fluid.velocity_solver = \"fft\"", "fluid.viscous_treatment", "auto, pcg or cholmod"});
  expect_parts(message_of(sphere, {"fluid.precision=mixed", "fluid.inertia=none"}),
               {"fluid.precision = \"mixed\"", "fluid.inertia = \"none\"", "\"double\""});
}

TEST(Scene, HasAPrecisionThatThePlanSays) {
  expect_parts(message_of("[fluid]\nprecision = \"single\"\n" + sphere),
               {"test.toml:2", "fluid.precision", "single", "double, mixed"});
  const auto plan = [](const Overrides& overrides) { return describe_plan(parse(sphere, overrides), 1); };
  EXPECT_EQ(parse(sphere).fluid.precision, fluid::Precision::double_);
  expect_parts(plan({}), {"in double precision"});
  expect_parts(plan({"fluid.precision=mixed"}), {"for the change of the velocity", "in single precision"});
  const Overrides implicit{"coupling.method=delta", "fluid.viscosity_ratio=5", "fluid.viscous_treatment=implicit",
                           "fluid.precision=mixed"};
  expect_parts(plan(implicit), {"precondition it in single precision"});
}

// Found by fuzz/scene.cpp, or while writing it: what overflowed, took for ever or ended as an "internal error".
TEST(Scene, RefusesNumbersBeyondWhatCanBeComputedWith) {
  const auto with = [](Overrides overrides) {
    overrides.insert(overrides.begin(), {"domain.periodic=[true, true, false]"});
    return message_of(sphere, overrides);
  };
  expect_parts(with({"domain.lower=[-1e308, -6, -6]", "domain.upper=[1e308, 6, 6]"}),
               {"domain.lower[0] = -1e+308", "finite"});
  expect_parts(with({"domain.lower=[1e12, -6, -6]", "domain.upper=[1000000000012.0, 6, 6]"}),
               {"domain.upper[0]", "too few digits"});
  expect_parts(with({"vesicles.0.centre=[1e300, 0, 0]"}), {"vesicles.0.centre[0] = 1e+300", "lengths of the box"});
  EXPECT_EQ(with({"vesicles.0.centre=[36, -24, 0]"}), "accepted");
  expect_parts(with({"domain.lower=[-1e-4, -1e-4, -6]", "domain.upper=[1e-4, 1e-4, 6]"}),
               {"vesicles.0", "long along x", "repeats after 0.0002"});
  expect_parts(with({"vesicles.0.radius=1e-300"}), {"vesicles.0.radius = 1e-300", "area"});
  expect_parts(with({"vesicles.0.rotation_axis=[1e-300, 0, 0]"}), {"vesicles.0.rotation_axis = [1e-300, 0, 0]"});
}

TEST(Scene, RefusesPeriodicAxesAndStepsThatTheFlowForbids) {
  const auto with = [](const char* type, const char* periodic) {
    return message_of(sphere, {std::string("flow.type=") + type, std::string("domain.periodic=") + periodic});
  };
  for (const char* type : {"shear", "oscillating_shear", "plane_poiseuille"}) {
    EXPECT_EQ(with(type, "[true, true, false]"), "accepted");
    expect_parts(with(type, "[false, false, true]"),
                 {"domain.periodic = [false, false, true]", "not repeat along z", "allowed is [true, true, false]"});
  }
  EXPECT_EQ(with("rest", "[true, true, true]"), "accepted");
  EXPECT_EQ(with("duct", "[true, false, false]"), "accepted");
  expect_parts(with("duct", "[true, true, false]"), {"domain.periodic", "along y"});
  expect_parts(with("extension", "[false, true, false]"), {"domain.periodic", "along y"});
  const Overrides slow = {"membrane.sigma0=0", "time.step=0.2"};
  const auto stepped = [&](Overrides more) {
    more.insert(more.end(), slow.begin(), slow.end());
    return message_of(sphere, more);
  };
  EXPECT_EQ(stepped({}), "accepted");
  expect_parts(stepped({"flow.rate=1.5"}), {"time.step = 0.2", "up to 1.5", "time.step <= 0.1667"});
  expect_parts(stepped({"flow.type=oscillating_shear", "flow.angular_frequency=2"}), {"time.step = 0.2", "up to 2"});
  expect_parts(stepped({"flow.type=extension", "flow.rate=-2"}), {"time.step = 0.2", "up to 2"});
  EXPECT_EQ(stepped({"flow.type=plane_poiseuille", "flow.peak_velocity=3.7"}), "accepted");  // 2 u/H = 1.23
  expect_parts(stepped({"flow.type=plane_poiseuille", "flow.peak_velocity=3.8"}), {"time.step = 0.2", "up to 1.267"});
  expect_parts(stepped({"flow.type=duct", "flow.peak_velocity=3.7"}), {"time.step = 0.2"});
}

TEST(Scene, VesiclesHaveTheirOwnPropertiesOrThoseOfAll) {
  const Scene scene = parse("[membrane]\nsigma0 = 300\n" + sphere +
                            "[[vesicles]]\nshape = \"sphere\"\ncentre = [3, 0, 0]\nsigma0 = 500\nlatitudes = 24\n"
                            "capillary_number = 0.5\nspontaneous_curvature = -1\n");
  EXPECT_EQ(scene.sigma0(0), 300.0);
  EXPECT_EQ(scene.sigma0(1), 500.0);
  EXPECT_EQ(scene.latitudes(0), 32);
  EXPECT_EQ(scene.latitudes(1), 24);
  EXPECT_EQ(scene.capillary_number(0), 2.5);
  EXPECT_EQ(scene.capillary_number(1), 0.5);
  EXPECT_EQ(scene.spontaneous_curvature(0), 0.0);
  EXPECT_EQ(scene.spontaneous_curvature(1), -1.0);
  EXPECT_EQ(scene.tension_number(), scene.time.step * 500.0 / (4 * scene.spacing()));  // of the stiffest
  EXPECT_EQ(to_toml(parse(to_toml(scene))), to_toml(scene));
  const std::string few = sphere + "latitudes = 10\n";
  expect_parts(
      message_of(few, {"time.markers=euler", "time.step=1/192", "membrane.sigma0=600", "mesh.tangential_degrees=15"}),
      {"mesh.tangential_degrees = 15", "vesicles.0.latitudes = 10"});
  expect_parts(message_of(sphere, {"time.markers=euler", "vesicles.0.sigma0=1e4"}), {"time.step", "g =", "sigma0 <="});
}

// A vesicle that reaches out of a periodic side comes in at the other, where another one may be; or itself.
TEST(Scene, VesiclesOverlapThroughPeriodicSidesToo) {
  const std::string two = "[domain]\nperiodic = [true, true, false]\n" + sphere + "centre = [5.5, 0, 0]\n" + sphere;
  EXPECT_EQ(message_of(two + "centre = [3, 0, 0]\n"), "accepted");
  EXPECT_EQ(message_of(two + "centre = [-4, 0, 0]\n"), "accepted");
  expect_parts(message_of(two + "centre = [-5, 0, 0]\n"), {"vesicles.0 and vesicles.1 (repeated", "overlap"});
  expect_parts(message_of("[domain]\nperiodic = [true, false, false]\nlower = [0, -6, -6]\nupper = [1.9, 6, 6]\n"
                          "cells = [12, 64, 64]\n" +
                          sphere),
               {"vesicles.0 and vesicles.0 (repeated", "enlarge the box"});
}

TEST(Scene, RefusesTimeKeysThatDoNotGoTogether) {
  expect_parts(message_of(sphere, {"time.fluid_velocity=interpolated"}), {"time.fluid_velocity", "arkode"});
  expect_parts(message_of(sphere, {"time.markers=strain_relaxation", "membrane.sigma0=0"}), {"membrane.sigma0 > 0"});
  expect_parts(message_of(sphere, {"time.markers=strain_relaxation", "time.relaxation=0.0"}), {"in (0, 1]"});
  expect_parts(message_of(sphere, {"time.adaptive=yes"}), {"time.adaptive", "true or false"});
  // Relaxation allows for (2 - a)/a times the tension number.
  const char* soft = "membrane.sigma0=600";
  expect_parts(message_of(sphere, {"time.markers=euler", "time.step=1/64", soft}), {"accepted"});
  expect_parts(message_of(sphere, {"time.markers=euler", "time.step=1/24", soft}), {"time.step = 0.041", "(7)"});
  expect_parts(message_of(sphere, {"time.step=1/24", "time.markers=strain_relaxation", soft}), {"accepted"});
  expect_parts(message_of(sphere, {"time.step=1/24", "membrane.integral_rate=5"}),
               {"membrane.integral_rate = 5", "shape_following"});
  if (coupling::have_sundials()) {
    const auto implicit = [](const char* key) {
      return message_of(sphere, {"time.markers=implicit", "time.step=1/24", key});
    };
    EXPECT_EQ(implicit("time.implicit_iterations=2"), "accepted");
    expect_parts(implicit("time.implicit_iterations=1"), {"time.implicit_iterations = 1", ">= 2"});
    expect_parts(implicit("time.implicit_tolerance=0.0"), {"time.implicit_tolerance = 0", "> 0"});
    expect_parts(implicit("membrane.integral_rate=5"), {"membrane.integral_rate = 5", "\"implicit\""});
    expect_parts(implicit("membrane.area=penalty"), {"membrane.area = \"penalty\"", "\"implicit\""});
  } else {
    for (const char* markers : {"arkode", "implicit"})
      expect_parts(message_of(sphere, {std::string("time.markers=") + markers}), {markers, "VESIFLOW_WITH_SUNDIALS"});
  }
}

TEST(Scene, RefusesFilesThatCannotBeReadOrAreNotToml) {
  EXPECT_THROW(load_scene("no/such/file.toml"), SceneError);
  expect_parts(message_of("[domain\ncells = 3\n"), {"test.toml:1", "TOML"});
  for (const char* value : {"shear", "1/384", "1,5"})
    expect_parts(message_of(std::string("[time]\nend = ") + value + "\n" + sphere),
                 {"test.toml:2", "not valid TOML", "words and fractions need quotes"});
}

TEST(Scene, AllScenesOfTheProjectAreValid) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(VESIFLOW_SCENES)) {
    if (entry.is_directory()) continue;
    EXPECT_NO_THROW(load_scene(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 12);
}

TEST(Scene, EveryKeyIsDocumented) {
  std::ifstream stream(std::string(VESIFLOW_DOCS) + "/scene.md");
  std::ostringstream text;
  text << stream.rdbuf();
  for (const SceneKey& key : scene_keys())
    EXPECT_NE(text.str().find("`" + key.name + "`"), std::string::npos) << key.name << " is not in docs/scene.md";
}

// A flow is made of the box before the box is checked: that of a duct needs one with a volume.
TEST(Scene, ABoxWithoutAVolumeIsRefusedWhateverTheFlow) {
  for (const char* type : {"duct", "plane_poiseuille", "shear"})
    expect_parts(message_of(sphere, {std::string("flow.type=") + type, "domain.upper=[100, -100, 100]"}),
                 {"domain.upper[1] = -100: must be above"});
  expect_parts(message_of(sphere, {"flow.type=duct", "domain.lower=[-6, -1e308, -6]", "domain.upper=[6, 1e308, 6]"}),
               {"domain.lower[1] = -1e+308", "finite"});
}

// Programs that fill a scene themselves: each of these was accepted once, and the last two ran off an array.
TEST(Scene, WhatAProgramFillsInIsCheckedAsAFileIs) {
  const auto refusal = [](const std::function<void(Scene&)>& spoil) -> std::string {
    Scene scene = parse(sphere);
    spoil(scene);
    try {
      check_scene(scene, "program");
    } catch (const SceneError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal([](Scene&) {}), "accepted");
  EXPECT_EQ(refusal([](Scene& s) { s.time.step = -0.01; }), "program: time.step = -0.01: must be > 0");
  EXPECT_EQ(refusal([](Scene& s) { s.fluid.viscosity_ratio = 5000.0; }),
            "program: fluid.viscosity_ratio = 5000: must be in [0.05, 100]");
  EXPECT_EQ(refusal([](Scene& s) { s.output.fluid_every = -1.0; }), "program: output.fluid_every = -1: must be >= 0");
  EXPECT_EQ(refusal([](Scene& s) { s.ending.retries = 0; }), "program: limits.retries = 0: must be in [1, 30]");
  EXPECT_NE(refusal([](Scene& s) {
              s.time.markers = static_cast<coupling::MarkerMotion>(17);
            }).find("program: time.markers = 17"),
            std::string::npos);
  Scene scene = parse(sphere);
  scene.time.markers = static_cast<coupling::MarkerMotion>(17);
  EXPECT_THROW(to_toml(scene), SceneError);
}

}  // namespace
}  // namespace vesiflow::run::scene_test
