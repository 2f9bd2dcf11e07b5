#include "coupling/scene.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "coupling/errors.h"
#include "coupling/marker_integrator.h"

namespace vesiflow::coupling {
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

TEST(Scene, TensionNumberIsAnotherWayToGiveSigma0) {
  const std::string text = "[time]\nstep = \"1/192\"\n" + sphere;
  EXPECT_NEAR(parse(text, {"membrane.g=25/6"}).membrane.sigma0, 600.0, 1e-9);
  EXPECT_NEAR(parse(text).tension_number(), 25.0 / 6.0, 1e-12);
  expect_parts(message_of(text, {"membrane.g=2.0", "membrane.sigma0=600"}), {"membrane.g = 2", "disagree"});
}

TEST(Scene, WritesItselfAndReadsBackTheSame) {
  const std::string vesicle = "[[vesicles]]\nshape = \"prolate\"\nreduced_volume = 0.9\nrotation_deg = 30\n";
  const Scene scene = parse("title = \"a \\\"quoted\\\" title\"\n[time]\nstep = \"1/384\"\n" + vesicle);
  const std::string text = to_toml(scene);
  EXPECT_EQ(to_toml(parse(text)), text);
  EXPECT_EQ(parse(text).time.step, scene.time.step);
}

TEST(Scene, RefusesBadValuesWithFileLineKeyValueAndRange) {
  expect_parts(message_of("[fluid]\nreynolds_number = -1\n" + sphere),
               {"test.toml:2", "fluid.reynolds_number = -1", "> 0"});
  expect_parts(message_of("[fluid]\nviscosity_ratio = -2.0\n" + sphere),
               {"test.toml:2", "fluid.viscosity_ratio", "> 0"});
  expect_parts(message_of("[domain]\ncells = \"many\"\n" + sphere), {"test.toml:2", "domain.cells", "many", "whole"});
  expect_parts(message_of("[domain]\nlower = [0, 0]\n" + sphere), {"domain.lower", "three numbers"});
  expect_parts(message_of("[time]\nstep = nan\n" + sphere), {"test.toml:2", "time.step", "> 0"});
  expect_parts(message_of("[flow]\ntype = \"sheer\"\n" + sphere), {"test.toml:2", "flow.type", "sheer", "rest, shear"});
  expect_parts(message_of("[fluid]\ninertia = \"some\"\n" + sphere), {"fluid.inertia", "full", "unsteady", "none"});
  expect_parts(message_of(sphere, {"mesh.latitudes=7"}), {"--set", "mesh.latitudes = 7", "in [8, 256]"});
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

TEST(Scene, RefusesWhatNoSingleKeyIsToBlameFor) {
  expect_parts(message_of(sphere, {"time.step=0.2"}), {"time.step = 0.2", "g =", "time.step <="});
  expect_parts(message_of(sphere, {"time.step=100", "time.end=1000", "membrane.sigma0=0"}), {"time.step", "0.25"});
  expect_parts(message_of(sphere, {"time.step=9"}), {"time.step = 9", "time.end"});
  expect_parts(message_of(sphere, {"vesicles.0.centre=[5.5, 0, 0]"}), {"vesicles.0.centre", "along x", "walls"});
  expect_parts(message_of(sphere, {"domain.upper=[-7, 6, 6]"}), {"domain.upper[0]", "above domain.lower[0]"});
  expect_parts(message_of("[[vesicles]]\nshape = \"prolate\"\n"), {"vesicles.0", "reduced_volume or aspect_ratio"});
  expect_parts(message_of("[[vesicles]]\nshape = \"sphere\"\naspect_ratio = 2\n"),
               {"vesicles.0", "prolate and oblate"});
  expect_parts(message_of(sphere + sphere), {"vesicles.0 and vesicles.1 overlap"});
  expect_parts(message_of("title = \"empty\"\n"), {"vesicles"});
  expect_parts(message_of(sphere, {"fluid.viscosity_ratio=5"}), {"fluid.viscosity_ratio = 5", "allowed is 1"});
}

TEST(Scene, RefusesTimeKeysThatDoNotGoTogether) {
  expect_parts(message_of(sphere, {"time.fluid_velocity=interpolated"}), {"time.fluid_velocity", "arkode"});
  expect_parts(message_of(sphere, {"time.markers=strain_relaxation", "membrane.sigma0=0"}), {"membrane.sigma0 > 0"});
  expect_parts(message_of(sphere, {"time.markers=strain_relaxation", "time.relaxation=0.0"}), {"in (0, 1]"});
  expect_parts(message_of(sphere, {"time.adaptive=yes"}), {"time.adaptive", "true or false"});
  // Relaxation allows for (2 - a)/a times the tension number.
  expect_parts(message_of(sphere, {"time.step=1/64"}), {"accepted"});
  expect_parts(message_of(sphere, {"time.step=1/24"}), {"time.step = 0.041", "(7)"});
  expect_parts(message_of(sphere, {"time.step=1/24", "time.markers=strain_relaxation"}), {"accepted"});
  if (!have_sundials())
    expect_parts(message_of(sphere, {"time.markers=arkode"}), {"time.markers", "VESIFLOW_WITH_SUNDIALS"});
}

TEST(Scene, RefusesFilesThatCannotBeReadOrAreNotToml) {
  EXPECT_THROW(load_scene("no/such/file.toml"), SceneError);
  expect_parts(message_of("[domain\ncells = 3\n"), {"test.toml:1", "TOML"});
}

TEST(Scene, AllScenesOfTheProjectAreValid) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(VESIFLOW_SCENES)) {
    EXPECT_NO_THROW(load_scene(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST(Scene, EveryKeyIsDocumented) {
  std::ifstream stream(std::string(VESIFLOW_DOCS) + "/scene.md");
  std::ostringstream text;
  text << stream.rdbuf();
  for (const SceneKey& key : scene_keys())
    EXPECT_NE(text.str().find("`" + key.name + "`"), std::string::npos) << key.name << " is not in docs/scene.md";
}

}  // namespace
}  // namespace vesiflow::coupling
