// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What is said of the errors of a run: where, when and what to do.
#include "run/run_quality.h"

#include <gtest/gtest.h>

#include "support/small_scene.h"

namespace vesiflow::run::run_quality_test {
namespace {

/// Three vesicles whose measures the test makes up.
class RunQualityTest : public testing::Test {
 protected:
  void set_tails(double first, double second, double third) {
    const double tails[] = {first, second, third};
    for (std::size_t i = 0; i < measures_.size(); ++i) measures_[i].spectrum_tail = tails[i];
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) simulation_.step();
  }
  void observe() { quality_.observe(simulation_, measures_, simulation_.nearest_distances()); }
  std::vector<std::string> about(const std::string& what) const {
    std::vector<std::string> found;
    for (const std::string& warning : quality_.warnings())
      if (warning.find(what) != std::string::npos) found.push_back(warning);
    return found;
  }

  SceneSimulation simulation_{coupling::three_vesicles({"time.step=1/100"})};
  RunQuality quality_{simulation_.scene()};
  std::vector<vesicle::Diagnostics> measures_ = simulation_.measure();
};

TEST_F(RunQualityTest, SaysOnceHowManyVesiclesAndWhichIsWorst) {
  set_tails(1e-9, 2e-4, 3e-4);
  observe();
  const auto warnings = about("the spectrum's tail");
  ASSERT_EQ(warnings.size(), 1);
  EXPECT_EQ(warnings[0],
            "the spectrum's tail is 0.0003, above 0.0001, in 2 of 3 vesicles, most in vesicle 2, at t = 0: take more "
            "mesh.latitudes");
  EXPECT_EQ(quality_.errors().greatest[RunQuality::spectrum_tail], 3e-4);
}

TEST_F(RunQualityTest, TellsWhatIsOfTheStartFromWhatStays) {
  set_tails(1e-9, 2e-4, 1e-9);
  observe();
  steps(4);
  observe();
  set_tails(1e-9, 1e-9, 1e-9);
  steps(8);
  observe();
  EXPECT_EQ(about("the spectrum's tail").at(0),
            "the spectrum's tail is 0.0002, above 0.0001, in vesicle 1, in the first 4 steps only, until t = 0.04: it "
            "is of the start, and what comes later does not have it");
  set_tails(1e-9, 2e-4, 1e-9);
  steps(1);
  observe();
  EXPECT_NE(about("the spectrum's tail").at(0).find("in vesicle 1, from t = 0 on: take more"), std::string::npos);
  set_tails(1e-9, 1e-9, 1e-9);
  steps(1);
  observe();
  EXPECT_NE(about("the spectrum's tail").at(0).find("from t = 0 to 0.13, below since then: take more"),
            std::string::npos);
}

TEST_F(RunQualityTest, GoesBackWithTheRun) {
  set_tails(1e-9, 1e-9, 1e-9);
  observe();
  const RunQuality::Errors before = quality_.errors();
  set_tails(1, 1, 1);
  observe();
  EXPECT_EQ(about("the spectrum's tail").size(), 1);
  quality_.restore(before);
  EXPECT_EQ(about("the spectrum's tail").size(), 0);
}

// Advice is of what the scene does not do already.
TEST(RunQuality, AdvisesNothingThatTheSceneDoes) {
  const auto said = [](const char* markers) {
    SceneSimulation simulation(coupling::small_scene({std::string("time.markers=") + markers}));
    RunQuality quality(simulation.scene());
    std::vector<vesicle::Diagnostics> measures = simulation.measure();
    measures[0].area_error = 0.1;
    measures[0].volume_error = 0.1;
    quality.observe(simulation, measures, simulation.nearest_distances());
    std::string all;
    for (const std::string& warning : quality.warnings()) all += warning + "\n";
    return all;
  };
  EXPECT_NE(said("euler").find("take time.markers = \"shape_following\""), std::string::npos);
  EXPECT_EQ(said("shape_following").find("shape_following"), std::string::npos);
  EXPECT_EQ(said("euler").find("membrane.volume = \"projection\""), std::string::npos);  // it does
  EXPECT_EQ(said("euler").find("vesicle 0"), std::string::npos);                         // there is no other
}

// The estimate is that of the thickness of a membrane, which a sharp one has none of.
TEST(RunQuality, EstimatesTheErrorOfDeltaFunctionsOnly) {
  const Scene delta = coupling::small_scene({"time.markers=shape_following"});
  const auto error = RunQuality(delta).scene_numbers().grid_error;
  ASSERT_TRUE(error.has_value());
  EXPECT_NEAR(*error, 0.19 * 0.25, 1e-12);
  const Scene sharp = coupling::small_scene({"time.markers=shape_following", "coupling.method=sharp"});
  EXPECT_FALSE(RunQuality(sharp).scene_numbers().grid_error.has_value());
}

}  // namespace
}  // namespace vesiflow::run::run_quality_test
