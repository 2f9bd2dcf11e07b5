// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Reports of whole runs, and of folders in which something is missing or damaged.
#include "run/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "files/hdf5_file.h"
#include "report/membrane_course.h"
#include "report/packed_membranes.h"
#include "report/stored_run.h"
#include "run/run_in_folder.h"
#include "support/small_scene.h"

namespace vesiflow::run::report_test {
namespace {

using coupling::small_scene, coupling::three_vesicles;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class Report : public RunInFolder {
 protected:
  void SetUp() override {
    if (!have_hdf5()) GTEST_SKIP() << "built without HDF5";
  }

  std::string page(const char* run = "run") const { return text_of(at(run) / report_name); }
};

TEST_F(Report, IsWrittenAtTheEndOfARun) {
  run_scene(small_scene({"time.end=1/12", "output.vesicle_every=1/48"}), at("run"));
  const std::string text = page();
  for (const char* part : {"completed", "What came out", "How far it can be trusted", "Where the time went",
                           "What was asked", "How to repeat it", "Content-Security-Policy", "t = 0.08333", "Its plan",
                           "tension number g", "class=\"membrane\"", "inclination"})
    EXPECT_TRUE(has(text, part)) << part;
  EXPECT_EQ(has(text, "It holds 5 of the 5 snapshots of the membranes."), report_has_viewer());
  EXPECT_EQ(has(text, "scripts/viewer.sh"), !report_has_viewer());
  EXPECT_FALSE(has(text, "What is missing"));
  // Nothing that a browser would fetch.
  for (const char* part : {" src=", "url(", "@import", "<link", "<iframe"}) {
    const std::string before_the_viewer = text.substr(0, text.find("<script"));
    EXPECT_FALSE(has(before_the_viewer, part)) << part;
  }
}

// It has nothing of the moment in which it is made.
TEST_F(Report, IsTheSameWheneverItIsMade) {
  run_scene(small_scene({"time.end=1/24"}), at("run"));
  EXPECT_EQ(report_of(at("run")), page());
  EXPECT_FALSE(has(page(), "the file system of"));
}

// The numbers of summary.json stand in the page.
TEST_F(Report, HasTheNumbersOfTheSummary) {
  run_scene(small_scene({"time.end=1/24"}), at("run"));
  const auto summary = nlohmann::json::parse(text_of(at("run") / "summary.json"));
  const std::string text = page();
  for (const char* key : {"inclination_angle_deg", "reduced_volume", "bending_energy"}) {
    char number[32];
    std::snprintf(number, sizeof number, "<td>%.5g</td>", summary["vesicles"][0][key].get<double>());
    const std::size_t row = text.find("data-name=\"" + std::string(key) + "\"");
    ASSERT_NE(row, std::string::npos) << key;
    EXPECT_TRUE(has(text.substr(row, 200), number)) << key << number << text.substr(row, 200);
  }
}

TEST_F(Report, IsNotWrittenWhereItIsNotWanted) {
  run_scene(small_scene({"time.end=1/48", "output.report=false"}), at("run"));
  EXPECT_FALSE(fs::exists(at("run") / report_name));
  EXPECT_TRUE(fs::exists(at("run") / "summary.json"));
}

TEST_F(Report, IsWrittenWhereARunIsStopped) {
  EXPECT_THROW(run_scene(small_scene({"membrane.g=15.5", "time.end=20", "output.vesicle_every=1/96"}), at("run")),
               coupling::SimulationStopped);
  const std::string text = page();
  EXPECT_TRUE(has(text, "The run could not go on."));
  EXPECT_TRUE(has(text, "likely cause"));
}

TEST_F(Report, IsWrittenWhereTimeIsOut) {
  EXPECT_EQ(run_scene(small_scene({"limits.wall_time=1e-6"}), at("run")), RunStatus::out_of_time);
  EXPECT_TRUE(has(page(), "out of time"));
}

// A report that cannot be written does not fail the run.
TEST_F(Report, IsNoReasonToFail) {
  SceneSimulation simulation(small_scene({"time.end=1/48"}));
  RunOptions options = options_in(at("run"));
  options.after_step = [&](const SceneSimulation&) { fs::create_directories(at("run") / report_name / "in the way"); };
  EXPECT_EQ(run(simulation, options), RunStatus::completed);
  EXPECT_TRUE(fs::is_directory(at("run") / report_name));
  EXPECT_TRUE(has(text_of(at("run") / "summary.json"), "\"completed\""));
}

// Another run in the folder moves it aside with what else is there.
TEST_F(Report, IsMovedWithEarlierResults) {
  run_scene(small_scene({"time.end=1/48"}), at("run"));
  const std::string before = page();
  run_scene(small_scene({"time.end=1/24"}), at("run"));
  EXPECT_EQ(text_of(at("run") / "previous_1" / report_name), before);
  EXPECT_NE(page(), before);
}

// What a user writes into a scene does nothing in a page.
TEST_F(Report, ShowsMarkupAsText) {
  const Scene plain = small_scene({"time.end=1/96"});
  run_scene(plain, at("plain"));
  Scene scene = plain;
  scene.title = "</script><script>alert(1)</script><!-- \" & '";
  run_scene(scene, at("run"));
  const std::string text = page(), other = page("plain");
  EXPECT_EQ(count(text, "<script"), count(other, "<script"));
  EXPECT_EQ(count(text, "</script"), count(other, "</script"));
  EXPECT_EQ(count(text, "<!--"), count(other, "<!--"));
  EXPECT_TRUE(has(text, "&lt;/script&gt;&lt;script&gt;alert(1)"));
}

TEST_F(Report, KeepsToItsSize) {
  run_scene(three_vesicles({"time.end=0.5", "output.vesicle_every=1/96", "output.diagnostics_every=1/96"}), at("run"));
  const std::size_t all = page().size();
  EXPECT_LE(all, 3'000'000U);
  const std::size_t least = report_of(at("run"), {.most_frames = 1, .bytes = 100'000}).size();
  const std::size_t asked = least + 60'000;
  const std::string text = report_of(at("run"), {.bytes = asked});
  EXPECT_LE(text.size(), asked);
  if (report_has_viewer()) {
    EXPECT_TRUE(has(text, "snapshots of the membranes, chosen evenly."));
    EXPECT_GT(all, text.size());
  }
  EXPECT_THROW(report_of(at("run"), {.most_frames = 0}), std::invalid_argument);
  EXPECT_THROW(report_of(at("run"), {.bytes = 1000}), std::invalid_argument);
}

// Snapshots come back as they were written, at the markers.
TEST_F(Report, MembranesAreThoseOfTheSnapshots) {
  run_scene(three_vesicles({"time.end=1/24", "output.vesicle_every=1/96"}), at("run"));
  const StoredRun stored = read_stored_run(at("run"));
  const MembraneCourse course = read_membranes(stored, 3);
  EXPECT_EQ(course.stored, 5U);
  ASSERT_EQ(course.frames.size(), 3U);
  EXPECT_EQ(course.latitudes, (std::vector<int>{16, 20, 12}));
  EXPECT_EQ(course.frames[1].step, 2);
  const PackedMembranes packed = pack_membranes(course, 1'000'000);
  ASSERT_EQ(packed.frames.size(), 3U);
  const Hdf5File file(stored.membranes.at(2), Hdf5File::Mode::read);
  std::size_t offset = packed.bytes.size() / 3;  // of the second frame
  for (int v = 0; v < 3; ++v) {
    const int n = course.latitudes[static_cast<std::size_t>(v)];
    const vesicle::SphericalHarmonics harmonics(n, vesicle::SphereGrid(n), membrane_columns);
    RealCoefficients coefficients = RealCoefficients::Zero(n * n, membrane_columns);
    for (const CoefficientPacking& packing : packed.packings[static_cast<std::size_t>(v)]) {
      packing.unpack(std::span(packed.bytes).subspan(offset, packing.bytes_per_frame()), coefficients);
      offset += packing.bytes_per_frame();
    }
    Eigen::ArrayXXd values(2 * n * n, membrane_columns);
    harmonics.synthesis(complex_coefficients(coefficients), values);
    const std::string group = "/vesicle_" + std::to_string(v);
    const std::vector<double> positions = file.read(group + "/positions"),
                              curvature = file.read(group + "/mean_curvature");
    double off = 0.0, off_curvature = 0.0;
    for (int k = 0; k < 2 * n * n; ++k) {
      for (int c = 0; c < 3; ++c) off += std::pow(values(k, c) - positions[static_cast<std::size_t>(3 * k + c)], 2);
      off_curvature += std::pow(values(k, 4) - curvature[static_cast<std::size_t>(k)], 2);
    }
    // Means over the markers, which are denser near the poles than the sphere that the error is a mean over.
    EXPECT_LE(std::sqrt(off / (2 * n * n)), 2.0 * packed.error[0]);
    EXPECT_LE(std::sqrt(off_curvature / (2 * n * n)), 2.0 * packed.error[2]);
  }
}

TEST_F(Report, NamesWhatIsMissing) {
  run_scene(small_scene({"time.end=1/24", "output.fluid_every=0", "output.diagnostics_every=0"}), at("run"));
  std::string text = page();
  EXPECT_TRUE(has(text, "Numbers against time: output.diagnostics_every = 0 in the scene."));
  EXPECT_TRUE(has(text, "Fluid: output.fluid_every = 0 in the scene."));
  fs::remove(at("run") / "scene.toml");
  fs::remove(at("run") / "summary.json");
  text = report_of(at("run"));
  EXPECT_TRUE(has(text, "summary.json: it is not in the folder."));
  EXPECT_TRUE(has(text, "scene.toml: it is not in the folder."));
  EXPECT_TRUE(has(text, "class=\"membrane\""));
}

TEST_F(Report, NamesWhatIsDamaged) {
  run_scene(small_scene({"time.end=1/24", "output.vesicle_every=1/96"}), at("run"));
  fs::resize_file(at("run") / "snapshots" / "vesicle_000000002.h5", 3000);
  std::ofstream(at("run") / "snapshots" / "fluid_000000000.h5") << "not HDF5";
  std::ofstream(at("run") / "summary.json") << "{ \"status\": ";
  const std::string text = report_of(at("run"));
  EXPECT_TRUE(has(text, "vesicle_000000002.h5"));
  EXPECT_TRUE(has(text, "fluid_000000000.h5"));
  EXPECT_TRUE(has(text, "summary.json: it is damaged."));
  EXPECT_TRUE(has(text, "tension number g"));
  std::ofstream(at("run") / "scene.toml") << "[domain\n<b>";
  const std::string other = report_of(at("run"));
  EXPECT_TRUE(has(other, "[domain\n&lt;b&gt;"));
  EXPECT_FALSE(has(other, "tension number g"));
  EXPECT_EQ(has(text, "It holds 4 of the 5 snapshots of the membranes"), report_has_viewer());
}

// The state that a run has blown up to may be written before it is noticed.
TEST_F(Report, LeavesOutWhatIsNotFinite) {
  run_scene(small_scene({"time.end=1/24", "output.vesicle_every=1/96"}), at("run"));
  const StoredRun stored = read_stored_run(at("run"));
  std::vector<double> tension = Hdf5File(stored.membranes.at(3), Hdf5File::Mode::read).read("/vesicle_0/tension");
  for (const double value : {1e200, std::numeric_limits<double>::quiet_NaN()}) {
    tension[100] = value;
    Hdf5File old(stored.membranes.at(2), Hdf5File::Mode::read);
    Hdf5File file(at("run") / "fake.h5", Hdf5File::Mode::create);
    file.attribute("/", "time", 3.0 / 96.0);
    file.attribute("/vesicle_0", "latitudes", std::int64_t{16});
    file.attribute("/vesicle_0", "longitudes", std::int64_t{32});
    for (const char* name : {"positions", "velocity"})
      file.write(std::string("/vesicle_0/") + name, old.read(std::string("/vesicle_0/") + name).data(), {514, 3});
    for (const char* name : {"mean_curvature", "local_area_error"})
      file.write(std::string("/vesicle_0/") + name, old.read(std::string("/vesicle_0/") + name).data(), {514});
    file.write("/vesicle_0/tension", tension.data(), {514});
    file.close();
    fs::rename(at("run") / "fake.h5", stored.membranes.at(3));
    const MembraneCourse course = read_membranes(stored, 10);
    EXPECT_EQ(course.frames.size(), 4U) << value;
    ASSERT_EQ(course.missing.size(), 1U) << value;
    EXPECT_NE(course.missing[0].find("vesicle_000000003.h5: /vesicle_0 has values that are not finite"),
              std::string::npos)
        << course.missing[0];
  }
}

// JSON that is whole, but not what a run writes.
TEST_F(Report, TakesAnySummary) {
  run_scene(small_scene({"time.end=1/96"}), at("run"));
  for (const char* summary :
       {"{}", "[]", "null", "{\"vesicles\": 3, \"warnings\": {}, \"parameters\": []}",
        "{\"vesicles\": [null, 1], \"retries\": [1], \"phase_seconds\": {\"a\": null}, \"largest_errors\": 2}",
        "{\"status\": 4, \"time\": \"x\", \"parameters\": {\"domain.cells\": 3, \"title\": 5, \"domain.mirror\": "
        "[1]}}"}) {
    std::ofstream(at("run") / "summary.json") << summary;
    EXPECT_NO_THROW(report_of(at("run"))) << summary;
  }
}

TEST_F(Report, OfAnEmptyRunSaysSo) {
  fs::create_directories(at("run"));
  EXPECT_THROW(report_of(at("run")), FileError);
  EXPECT_THROW(report_of(at("nowhere")), FileError);
  std::ofstream(at("run") / "summary.json") << "{\"status\": \"running\"}";
  const std::string text = report_of(at("run"));
  EXPECT_TRUE(has(text, "There are no snapshots of the membranes to draw."));
  EXPECT_TRUE(has(text, "Membranes: nothing is written yet."));
}

TEST_F(Report, CannotBeWrittenWhereNoFileCanBe) {
  run_scene(small_scene({"time.end=1/96"}), at("run"));
  EXPECT_THROW(write_report(at("run"), at("nowhere") / "report.html"), FileError);
}

}  // namespace
}  // namespace vesiflow::run::report_test
