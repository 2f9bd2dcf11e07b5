// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Halves and quarters of symmetric boxes (domain.mirror) against the whole.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "coupling/errors.h"
#include "coupling/repulsion.h"
#include "coupling/simulation.h"
#include "mirrored_scenes.h"
#include "run/plan.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::mirror_test {
namespace {

using mirrored::advance, mirrored::expect_same, mirrored::side_of;

constexpr long steps = 20;

// A prolate along x, off the middle plane of a duct in no direction: symmetric about y = 0 and z = 0.
Scene duct_scene(const Overrides& more) {
  Overrides overrides = {"flow.type=duct",
                         "domain.lower=[-2.5, -2, -2]",
                         "domain.upper=[2.5, 2, 2]",
                         "domain.cells=[20, 16, 16]",
                         "mesh.tangential_degrees=12",
                         "vesicles.0.rotation_deg=90"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return small_scene(overrides);
}

Scene shear_scene(const Overrides& more) {
  Overrides overrides = {"domain.lower=[-2.5, -2, -2]", "domain.upper=[2.5, 2, 2]", "domain.cells=[20, 16, 16]",
                         "mesh.tangential_degrees=12"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return small_scene(overrides);
}

// With tension, bending and, in half of the cases, another viscosity inside.
TEST(Mirror, HalfOfAShearFlowIsTheHalfOfTheWhole) {
  for (const char* markers : {"euler", "shape_following"})
    for (const char* ratio : {"1", "5"}) {
      SCOPED_TRACE(std::string(markers) + ", ratio " + ratio);
      const Scene scene =
          shear_scene({std::string("time.markers=") + markers, std::string("fluid.viscosity_ratio=") + ratio});
      SceneSimulation whole(scene), half(side_of(scene, {false, true, false}));
      advance(whole, steps);
      advance(half, steps);
      expect_same(whole, half, 1e-10);
    }
}

TEST(Mirror, QuarterOfADuctIsTheQuarterOfTheWhole) {
  for (const char* markers : {"euler", "shape_following"})
    for (const char* ratio : {"1", "5"}) {
      SCOPED_TRACE(std::string(markers) + ", ratio " + ratio);
      const Scene scene =
          duct_scene({std::string("time.markers=") + markers, std::string("fluid.viscosity_ratio=") + ratio});
      SceneSimulation whole(scene), quarter(side_of(scene, {false, true, true}));
      advance(whole, steps);
      advance(quarter, steps);
      expect_same(whole, quarter, 1e-10);
    }
}

// Two vesicles, one on each side of the plane, near enough to repel each other, of another viscosity and with a third across
// the plane; the half box has the one on its side and that across.
TEST(Mirror, AVesicleOnOneSideStandsForItsImageToo) {
  Scene whole_scene = shear_scene({"domain.upper=[5, 2, 2]", "domain.cells=[30, 16, 16]", "repulsion.range=0.4",
                                   "repulsion.strength=20", "fluid.viscosity_ratio=3", "vesicles.0.radius=0.7"});
  VesicleParameters aside;
  aside.shape = Shape::oblate;
  aside.aspect_ratio = 1.3;
  aside.radius = 0.6;
  aside.centre = {1.55, 0.75, 0.1};
  aside.rotation_axis = {1, 0, 0};
  aside.rotation_deg = 20;
  whole_scene.vesicles.push_back(aside);
  Scene half_scene = side_of(whole_scene, {false, true, false});
  VesicleParameters image = aside;
  image.centre[1] *= -1.0;
  image.rotation_deg *= -1.0;
  whole_scene.vesicles.push_back(image);
  SceneSimulation whole(whole_scene), half(half_scene);
  ASSERT_LT(half.nearest_distances()[1], 0.35);  // repelled by its image
  EXPECT_NEAR(half.nearest_distances()[1], whole.nearest_distances()[1], 1e-12);
  EXPECT_NEAR(half.nearest_distances()[0], whole.nearest_distances()[0], 1e-12);
  advance(whole, steps);
  advance(half, steps);
  expect_same(whole, half, 1e-10);
}

// The markers of both sides are computed. What round-off puts between them and their images would grow, as the fluid does not answer to it.
TEST(Mirror, MarkersStaySymmetric) {
  for (const char* markers : {"euler", "shape_following", "implicit"}) {
    SCOPED_TRACE(markers);
    SceneSimulation half(side_of(shear_scene({std::string("time.markers=") + markers}), {false, true, false}));
    advance(half, 3 * steps);
    const vesicle::VectorField& x = half.membrane(0).positions();
    const Eigen::Index longitudes = 2 * half.scene().latitudes(0), latitudes = half.scene().latitudes(0);
    double worst = 0.0;
    for (Eigen::Index j = 0; j < latitudes; ++j)
      for (Eigen::Index i = 0; i < longitudes; ++i) {
        const Eigen::Index a = j * longitudes + i, b = j * longitudes + (longitudes - i) % longitudes;
        worst =
            std::max({worst, std::abs(x(a, 0) - x(b, 0)), std::abs(x(a, 1) + x(b, 1)), std::abs(x(a, 2) - x(b, 2))});
      }
    RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
    constexpr double round_off = 2e-15;  // of sums of displacements, each of them symmetric to the last bit
    EXPECT_LT(worst, round_off);
  }
}

std::string refusal(const Scene& scene) {
  try {
    check_scene(scene, "test");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Mirror, RefusesWhatIsNotSymmetric) {
  const Scene shear = shear_scene({}), duct = duct_scene({});
  EXPECT_EQ(refusal(side_of(shear, {false, true, false})), "accepted");
  EXPECT_EQ(refusal(side_of(duct, {false, true, true})), "accepted");
  EXPECT_NE(refusal(side_of(shear, {false, false, true})).find("not symmetric about the plane z = 0"),
            std::string::npos);
  EXPECT_NE(refusal(side_of(duct, {true, false, false})).find("allowed here is [false, true, true]"),
            std::string::npos);

  Scene both = side_of(shear, {false, true, false});
  both.domain.periodic[1] = true;
  EXPECT_NE(refusal(both).find("domain.mirror = [false, true, false]: y is periodic too"), std::string::npos);

  Scene extension = side_of(duct, {true, true, true});
  extension.flow.type = FlowType::extension;
  EXPECT_EQ(refusal(extension), "accepted");
  extension.domain.lower[1] = -0.25;
  EXPECT_NE(refusal(extension).find("not symmetric about the plane y = -0.25"), std::string::npos);

  Scene shifted = side_of(shear, {false, true, false});
  shifted.vesicles[0].centre[1] = 1e-9;
  EXPECT_NE(refusal(shifted).find("without being symmetric about it"), std::string::npos);
  Scene turned = side_of(shear, {false, true, false});
  turned.vesicles[0].rotation_axis = {1, 1, 0};
  EXPECT_NE(refusal(turned).find("vesicles.0: lies across the plane y = 0"), std::string::npos);
  Scene aside = shear_scene({"domain.lower=[-2.5, -1.25, -2]", "domain.mirror=[false, true, false]"});
  EXPECT_EQ(refusal(aside), "accepted");  // touches nothing

  Scene pulled = side_of(duct, {false, true, true});
  pulled.gravity.acceleration = {1.0, 0.0, -1.0};
  EXPECT_EQ(refusal(pulled), "accepted");
  pulled.vesicles[0].density_difference = 1.0;
  EXPECT_NE(refusal(pulled).find("gravity.acceleration[2] = -1: pulls across the plane"), std::string::npos);
}

TEST(Mirror, ThePlanNamesThePlanes) {
  EXPECT_NE(describe_plan(side_of(duct_scene({}), {false, true, true}), 1).find("y = 0, z = 0"), std::string::npos);
}

}  // namespace
}  // namespace vesiflow::coupling::mirror_test
