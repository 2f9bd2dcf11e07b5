// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/flow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/simulation.h"
#include "fluid/operators.h"
#include "run/errors.h"
#include "support/small_scene.h"

namespace vesiflow::run::flow_test {
namespace {

using fluid::Vector3;

Scene flow_scene(const std::string& type, const Overrides& more = {}) {
  Overrides overrides = {"flow.type=" + type};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return coupling::small_scene(overrides);
}

// A flow that deserves its name is free of divergence, and is a steady solution with the force that it asks for: the Laplacian of
// u is minus the driving force (all have a convective term that is a gradient).
TEST(Flow, SolvesTheEquationsWithItsDrivingForce) {
  const double h = 1e-3;
  for (const char* type : {"rest", "shear", "extension", "plane_poiseuille", "duct"}) {
    const coupling::Flow flow = flow_of(flow_scene(type, {"domain.upper=[3, 2, 4]"}));
    for (const Vector3& x : {Vector3{0.3, 0.2, 0.1}, Vector3{-1.0, -1.5, 2.5}}) {
      double divergence = 0.0;
      Vector3 laplacian{};
      for (int axis = 0; axis < 3; ++axis) {
        Vector3 up = x, down = x;
        up[axis] += h;
        down[axis] -= h;
        const Vector3 u = flow.velocity(x, 0), above = flow.velocity(up, 0), below = flow.velocity(down, 0);
        divergence += (above[axis] - below[axis]) / (2 * h);
        for (int c = 0; c < 3; ++c) laplacian[c] += (above[c] - 2 * u[c] + below[c]) / (h * h);
      }
      EXPECT_NEAR(divergence, 0.0, 1e-9) << type;
      EXPECT_NEAR(laplacian[0], -flow.driving_force, 1e-6) << type;
      EXPECT_NEAR(laplacian[1], 0.0, 1e-8) << type;
      EXPECT_NEAR(laplacian[2], 0.0, 1e-8) << type;
    }
  }
}

TEST(Flow, HasTheVelocitiesThatAreDocumented) {
  const auto velocity = [](const std::string& type, const Overrides& more, const Vector3& x, double t) {
    return flow_of(flow_scene(type, more)).velocity(x, t);
  };
  const Vector3 x{1.0, -0.5, 2.0};
  EXPECT_EQ(velocity("rest", {}, x, 1), (Vector3{}));
  EXPECT_EQ(velocity("shear", {"flow.rate=3"}, x, 1), (Vector3{6.0, 0.0, 0.0}));
  EXPECT_EQ(velocity("oscillating_shear", {"flow.rate=3", "flow.angular_frequency=2"}, x, 0.7),
            (Vector3{3 * std::cos(1.4) * 2.0, 0.0, 0.0}));
  EXPECT_EQ(velocity("extension", {"flow.rate=2"}, x, 1), (Vector3{2.0, 0.0, -4.0}));
  EXPECT_EQ(velocity("extension", {"flow.rate=2", "flow.extension=uniaxial"}, x, 1), (Vector3{2.0, 0.5, -2.0}));
  const Overrides shifted = {"domain.lower=[-3, -3, -2.5]", "domain.upper=[3, 3, 4.5]", "flow.peak_velocity=2"};
  EXPECT_NEAR(velocity("plane_poiseuille", shifted, {0, 0, 1.0}, 1)[0], 2.0, 1e-14);
  EXPECT_NEAR(velocity("plane_poiseuille", shifted, {0, 0, 2.75}, 1)[0], 1.5, 1e-14);
  EXPECT_NEAR(velocity("plane_poiseuille", shifted, {0, 0, 4.5}, 1)[0], 0.0, 1e-14);
}

// Values of the series summed to i = 2999 in 30 digits, by an independent program; half-widths 3 and 2.5.
TEST(Flow, OfADuctIsThatOfThePaper) {
  const coupling::Flow flow =
      flow_of(flow_scene("duct", {"domain.lower=[-3, -2, -2]", "domain.upper=[3, 4, 3]", "flow.peak_velocity=2"}));
  EXPECT_NEAR(flow.velocity({0, 1, 0.5}, 0)[0], 2.0, 1e-12);
  EXPECT_NEAR(flow.velocity({0, 2, 1.5}, 0)[0], 2 * 0.7801273418015148, 1e-8);
  EXPECT_NEAR(flow.velocity({1, 2, 0.5}, 0)[0], 2 * 0.9108478338721038, 1e-8);
  EXPECT_EQ(flow.velocity({1, 4, 0.5}, 0)[0], 0.0);
  EXPECT_NEAR(flow.velocity({0, 1, 1.5}, 0)[0], 2 * 0.8532382467215989, 1e-8);  // y alone has changed, then z alone
}

// The bound on the time step: no finite difference along an axis exceeds it, and some come near it.
TEST(Flow, KnowsItsGreatestGradient) {
  for (const char* type : {"rest", "shear", "oscillating_shear", "extension", "plane_poiseuille", "duct"}) {
    const coupling::Flow flow = flow_of(flow_scene(type, {"domain.upper=[3, 2, 4]", "flow.rate=-1.5"}));
    double greatest = 0.0;
    const double h = 1e-4;
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j <= 70; ++j) {
        const Vector3 x{0.0, -3.0 + 5.0 * i / 60, -3.0 + 7.0 * j / 70 - (j == 70 ? h : 0.0)};
        for (int axis = 0; axis < 3; ++axis) {
          Vector3 next = x;
          next[axis] += h;
          for (int c = 0; c < 3; ++c)
            greatest = std::max(greatest, std::abs(flow.velocity(next, 0)[c] - flow.velocity(x, 0)[c]) / h);
        }
      }
    EXPECT_LE(greatest, flow.greatest_gradient * (1 + 1e-3)) << type;
    EXPECT_GE(greatest, flow.greatest_gradient * (1 - 1e-2)) << type;
  }
}

// Driven by its force, a flow along a periodic axis comes from rest to the undisturbed one. Second differences are exact for a
// parabola, and the wall halfway between two points leaves f h^2/8; a duct's error is of that size.
TEST(Flow, IsReachedFromRestInAPeriodicBox) {
  const Overrides fast = {"domain.periodic=[true, false, false]", "fluid.reynolds_number=1e-3", "domain.cells=16"};
  for (const std::string type : {"plane_poiseuille", "duct"}) {
    Scene scene = flow_scene(type, fast);
    const coupling::Flow flow = flow_of(scene);
    fluid::NavierStokes fluid(grid_of(scene), fluid_parameters_of(scene), flow.velocity, flow.motion);
    fluid.uniform_force()[0] = flow.driving_force;
    for (int k = 0; k < 40; ++k) fluid.step(0.01);
    const auto& u = fluid.velocity().x;
    const double h = fluid.grid().spacing(2), error = flow.driving_force * h * h / 8;
    for (int k = 0; k < u.extent(2); ++k)
      EXPECT_NEAR(u(3, 8, k), flow.velocity(u.position(3, 8, k), 0)[0], 1.01 * error) << type;
  }
}

TEST(Flow, ThatOnlyAProgramKnowsIsRefused) {
  Scene scene = coupling::small_scene();
  scene.flow.type = FlowType::custom;
  EXPECT_THROW(flow_of(scene), SceneError);
}

}  // namespace
}  // namespace vesiflow::run::flow_test
