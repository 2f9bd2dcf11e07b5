// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Lengths and times are in any unit: the same scene in others gives the same answer, bit for bit where the units are powers of two.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "coupling/simulation.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::units_test {
namespace {

/// The scene in units of which the old ones are `length` and `time`; the viscosity of the outer fluid stays 1.
Scene in_units(Scene scene, double length, double time) {
  for (auto* corner : {&scene.domain.lower, &scene.domain.upper})
    for (double& x : *corner) x *= length;
  scene.flow.rate /= time;
  scene.fluid.reynolds_number *= time / (length * length);
  const auto scale_membrane = [&](auto& m) {
    if (m.capillary_number) *m.capillary_number *= time / (length * length * length);
    if (m.sigma0) *m.sigma0 *= length / time;
    if (m.spontaneous_curvature) *m.spontaneous_curvature /= length;
  };
  scene.membrane.capillary_number *= time / (length * length * length);
  scene.membrane.sigma0 *= length / time;
  scene.membrane.volume_stiffness /= time;
  scene.repulsion.range *= length;
  scene.repulsion.strength /= time;
  for (double& g : scene.gravity.acceleration) g /= length * time;
  for (double* t : {&scene.time.step, &scene.time.end, &scene.time.smallest_step, &scene.time.largest_step}) *t *= time;
  for (VesicleParameters& vesicle : scene.vesicles) {
    vesicle.radius *= length;
    for (double& x : vesicle.centre) x *= length;
    scale_membrane(vesicle);
  }
  return scene;
}

/// Positions of all vesicles and diagnostics of the first, after a few steps.
struct Answer {
  std::vector<vesicle::VectorField> positions;
  vesicle::Diagnostics first;
  long steps = 0;
};

Answer answer_to(const Scene& scene) {
  SceneSimulation simulation(scene);
  for (int i = 0; i < 6; ++i) simulation.step();
  Answer answer;
  for (std::size_t i = 0; i < simulation.vesicle_count(); ++i)
    answer.positions.push_back(simulation.membrane(i).positions());
  answer.first = simulation.measure().at(0);
  answer.steps = simulation.steps();
  return answer;
}

struct Kind {
  std::string name;
  Scene scene;
};

std::vector<Kind> kinds() {
  const auto one = [](const Overrides& overrides) {
    Scene scene = small_scene(overrides);
    scene.g.reset();
    return scene;
  };
  const Overrides follow{"time.markers=shape_following", "time.step=1/24"};
  const auto following = [&](const Overrides& more) {
    Overrides all = follow;
    all.insert(all.end(), more.begin(), more.end());
    return one(all);
  };
  Scene three = three_vesicles();
  three.g.reset();
  return {
      {"euler", one({})},
      {"arkode", one({"time.markers=arkode"})},
      {"shape_following", following({})},
      {"contrast", following({"fluid.viscosity_ratio=5"})},
      {"no inertia", following({"fluid.inertia=none"})},
      {"near a sphere", following({"vesicles.0.reduced_volume=0.9999"})},
      {"thin", following({"coupling.thickness_correction=true"})},
      {"adaptive", following({"time.adaptive=true"})},
      {"implicit", following({"time.markers=implicit"})},
      {"three, repelling, sinking", three},
  };
}

TEST(Units, PowersOfTwoGiveTheSameBits) {
  for (const Kind& kind : kinds()) {
    const Answer a = answer_to(kind.scene);
    for (const auto& [length, time] : {std::pair{std::ldexp(1, -10), 1.0}, {1.0, std::ldexp(1, -10)}, {32.0, 1.0}}) {
      SCOPED_TRACE(kind.name + ", length " + std::to_string(length) + ", time " + std::to_string(time));
      const Answer b = answer_to(in_units(kind.scene, length, time));
      for (std::size_t i = 0; i < a.positions.size(); ++i)
        EXPECT_TRUE((length * a.positions[i] == b.positions[i]).all());
      EXPECT_EQ(a.first.tank_treading_frequency, b.first.tank_treading_frequency * time);
      EXPECT_EQ(a.first.max_local_area_error, b.first.max_local_area_error);
      EXPECT_EQ(a.first.inclination_angle, b.first.inclination_angle);
      const double unresolved = a.first.resolution.unresolved;  // by logarithms of amplitudes
      EXPECT_NEAR(b.first.resolution.unresolved, unresolved, 1e-11 * unresolved);
    }
  }
}

// 6e-14 is seen.
TEST(Units, OthersGiveTheSameToRoundOff) {
  const Scene scene = kinds().at(2).scene;
  const Answer a = answer_to(scene);
  for (const double length : {1e-3, 3e-6, 7e4}) {
    const Answer b = answer_to(in_units(scene, length, 1.0));
    EXPECT_LT((a.positions[0] - b.positions[0] / length).abs().maxCoeff(), 1e-11) << length;
    EXPECT_NEAR(a.first.tank_treading_frequency, b.first.tank_treading_frequency, 1e-10) << length;
  }
}

}  // namespace
}  // namespace vesiflow::coupling::units_test
