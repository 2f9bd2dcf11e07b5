// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Shapes as scenes ask for them, and their files.
#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "run/checkpoint.h"
#include "run/errors.h"
#include "run/run.h"
#include "run/scene.h"
#include "vesicle/mesh_fit.h"
#include "vesicle/shapes.h"
#include "vesicle/surface.h"
#include "vesicle/surface_file.h"
#include "vesicle/triangle_mesh_file.h"

namespace vesiflow::run::initial_shape_test {
namespace {

namespace fs = std::filesystem;

constexpr int latitudes = 16;

// A folder with a scene, its files, and its results.
class InitialShapeTest : public testing::Test {
 protected:
  InitialShapeTest()
      : folder_(fs::temp_directory_path() / ("vesiflow_shape_" + std::to_string(getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "shapes");
    omp_set_num_threads(1);  // the runs are too small for more
  }
  ~InitialShapeTest() override {
    omp_set_num_threads(threads_);
    fs::remove_all(folder_);
  }

  void write(const char* file, const std::string& text) const { std::ofstream(folder_ / file) << text; }

  // The scene of a small box with one vesicle of these keys, from a file in the folder.
  Scene scene_with(const std::string& keys, const Overrides& overrides = {}) const {
    write("scene.toml", std::string(R"(
[domain]
lower = [-3, -3, -3]
upper = [3, 3, 3]
cells = 24
[membrane]
g = 2.0
[mesh]
latitudes = 16
[time]
step = "1/96"
end = "12/96"
[output]
checkpoint_every = "6/96"
[[vesicles]]
radius = 0.9
centre = [0.1, 0.2, -0.1]
rotation_deg = 40
)") + keys);
    return load_scene(folder_ / "scene.toml", overrides);
  }

  std::string complaint(const std::string& keys, const Overrides& overrides = {}) const {
    try {
      scene_with(keys, overrides);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "accepted";
  }

  void expect_complaint(const std::string& keys, std::initializer_list<const char*> parts) const {
    const std::string message = complaint(keys);
    for (const char* part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
  }

  fs::path folder_;
  int threads_ = omp_get_max_threads();
};

const vesicle::Placement placement{
    0.9, Eigen::AngleAxisd(40 * std::numbers::pi / 180, vesicle::Vector3::UnitY()).toRotationMatrix(),
    vesicle::Vector3(0.1, 0.2, -0.1)};

const std::string coefficients_keys = "shape = \"coefficients\"\nfile = \"shapes/a.txt\"\n";
const std::string mesh_keys = "shape = \"mesh\"\nfile = \"shapes/a.obj\"\nfit_degrees = 3\n";

// Shape 1:1.4:0.8 in a parametrisation of its own.
vesicle::Coefficients some_surface() {
  vesicle::Surface surface(8);
  surface.update(vesicle::ellipsoid(surface.grid(), {1.0, 1.4, 0.8}));
  return surface.position_coefficients();
}

// A cube with a pyramid on each face: 14 vertices, enough for two degrees and not for three.
std::string some_mesh() {
  std::string text;
  const auto vertex = [&text](double x, double y, double z) {
    text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  };
  for (int k = 0; k < 8; ++k) vertex(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
  const int faces[6][4] = {{1, 2, 4, 3}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 4, 8, 7}, {1, 3, 7, 5}, {2, 4, 8, 6}};
  const bool turned[6] = {true, false, false, true, true, false};
  const double s = 1.7;
  const double centres[6][3] = {{0, 0, -s}, {0, 0, s}, {0, -s, 0}, {0, s, 0}, {-s, 0, 0}, {s, 0, 0}};
  int next = 9;
  std::string triangles;
  for (int f = 0; f < 6; ++f) {
    vertex(centres[f][0], centres[f][1], centres[f][2]);
    const int top = next++;
    for (int k = 0; k < 4; ++k) {
      int a = faces[f][k], b = faces[f][(k + 1) % 4];
      if (turned[f]) std::swap(a, b);
      triangles += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(top) + "\n";
    }
  }
  return text + triangles;
}

// A disc of semi-axes 1.3 and 0.45 bent over a sphere of radius 0.9, a bowl without a centre that sees all of it, by longitudes and
// latitudes: 218 vertices, enough for ten degrees.
std::string bowl() {
  constexpr int around = 18, down = 13;
  std::string vertices, faces;
  const auto vertex = [&](double theta, double phi) {
    const double angle = 1.3 / 0.9 * std::sin(theta), r = 0.9 + 0.45 * std::cos(theta);
    for (const double x :
         {r * std::sin(angle) * std::cos(phi), r * std::sin(angle) * std::sin(phi), r * std::cos(angle)})
      vertices += std::to_string(x) + " ";
    vertices += "\n";
  };
  const auto face = [&](int a, int b, int c) {
    faces += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  };
  const auto at = [](int j, int i) { return 1 + (j - 1) * around + i % around; };
  constexpr int last = 1 + (down - 1) * around;
  vertex(0, 0);
  for (int j = 1; j < down; ++j)
    for (int i = 0; i < around; ++i) vertex(std::numbers::pi * j / down, 2 * std::numbers::pi * i / around);
  vertex(std::numbers::pi, 0);
  for (int i = 0; i < around; ++i) {
    face(0, at(1, i), at(1, i + 1));
    face(last, at(down - 1, i + 1), at(down - 1, i));
    for (int j = 1; j + 1 < down; ++j) {
      face(at(j, i), at(j + 1, i), at(j + 1, i + 1));
      face(at(j, i), at(j + 1, i + 1), at(j, i + 1));
    }
  }
  return "OFF\n" + std::to_string(last + 1) + " " + std::to_string(2 * around * (down - 1)) + " 0\n" + vertices + faces;
}

vesicle::VectorField start_of(const Scene& scene) {
  return SceneSimulation(scene).state().vesicles[0].membrane.positions;
}

TEST_F(InitialShapeTest, AreThoseOfTheLibraryInTheirPlace) {
  const vesicle::SphereGrid grid(latitudes);
  EXPECT_TRUE((start_of(scene_with("shape = \"biconcave\"\n")) == vesicle::biconcave_disc(grid, placement)).all());

  const std::vector<vesicle::Harmonic> terms{{2, 0, 0.1}, {3, -2, -0.05}};
  EXPECT_TRUE((start_of(scene_with("shape = \"harmonics\"\nharmonics = [[2, 0, 0.1], [3, -2, -0.05]]\n")) ==
               vesicle::perturbed_sphere(grid, terms, placement))
                  .all());

  vesicle::write_surface_coefficients(folder_ / "shapes/a.txt", some_surface());
  EXPECT_TRUE(
      (start_of(scene_with(coefficients_keys)) == vesicle::shape_from_coefficients(grid, some_surface(), placement))
          .all());
}

TEST_F(InitialShapeTest, MeshIsFittedAndPlaced) {
  write("shapes/a.obj", some_mesh());
  const vesicle::TriangleMesh mesh = vesicle::read_triangle_mesh(folder_ / "shapes/a.obj");
  const vesicle::Coefficients fitted = vesicle::fit_mesh(mesh, 2).surface;
  EXPECT_TRUE((start_of(scene_with(mesh_keys, {"vesicles.0.fit_degrees=2"})) ==
               vesicle::shape_from_coefficients(vesicle::SphereGrid(latitudes), fitted, placement))
                  .all());
}

/// Degrees not given are those that the vertices determine, below the latitudes; vesicles share a fit.
TEST_F(InitialShapeTest, DegreesOfTheFitFollowFromTheMesh) {
  write("shapes/a.obj", some_mesh());
  const std::string keys = "shape = \"mesh\"\nfile = \"shapes/a.obj\"\n";
  EXPECT_TRUE((start_of(scene_with(keys)) == start_of(scene_with(mesh_keys, {"vesicles.0.fit_degrees=2"}))).all());
  const Scene two = scene_with(keys + "[[vesicles]]\nradius = 0.3\ncentre = [1.4, 1.4, 1.4]\n" + keys);
  ASSERT_EQ(two.vesicles.size(), 2u);
  EXPECT_EQ(two.vesicles[1].surface->energy(0, 2), two.vesicles[0].surface->energy(0, 2));
  EXPECT_FALSE(two.surface_file(1).fit_degrees);
}

/// A shape that is not star-shaped starts a simulation like any other: it keeps its area and volume, its membrane hardly yields.
TEST_F(InitialShapeTest, BowlsOfTrianglesCanBeSimulated) {
  write("shapes/a.off", bowl());
  SceneSimulation simulation(
      scene_with("shape = \"mesh\"\nfile = \"shapes/a.off\"\n", {"membrane.capillary_number=1"}));
  const vesicle::Surface& surface = simulation.membrane(0).surface();
  const double area = surface.area(), volume = surface.volume();
  EXPECT_NEAR(vesicle::reduced_volume(area, volume), 0.7685, 5e-3);
  for (int step = 0; step < 12; ++step) simulation.step();
  EXPECT_NEAR(simulation.membrane(0).surface().area() / area, 1, 1e-10);
  EXPECT_NEAR(simulation.membrane(0).surface().volume() / volume, 1, 1e-10);
}

TEST_F(InitialShapeTest, ScenesAreWrittenBackAndReadTheSameFromAnywhere) {
  vesicle::write_surface_coefficients(folder_ / "shapes/a.txt", some_surface());
  write("shapes/a.obj", some_mesh());
  const std::vector<std::string> all{"shape = \"biconcave\"\n", "shape = \"harmonics\"\nharmonics = [[2, 1, 1e-05]]\n",
                                     coefficients_keys,
                                     "shape = \"mesh\"\nfile = \"shapes/../shapes/a.obj\"\nfit_degrees = 2\n"};
  for (const std::string& keys : all) {
    const Scene scene = scene_with(keys);
    const std::string text = to_toml(scene);
    const Scene again = parse_scene(text, "elsewhere/scene.toml");
    EXPECT_EQ(to_toml(again), text);
    EXPECT_TRUE((start_of(again) == start_of(scene)).all()) << keys;
  }
  EXPECT_EQ(*scene_with(coefficients_keys).surface_file(0).file, (folder_ / "shapes/a.txt").string());
}

TEST_F(InitialShapeTest, BadKeysAreRefusedByName) {
  const std::string form = "must be a list of [degree, order, amplitude]";
  for (const char* list : {"[]", "[2, 0, 0.1]", "[[2, 0]]", "[[2.5, 0, 0.1]]", "\"Y20\""})
    expect_complaint(std::string("shape = \"harmonics\"\nharmonics = ") + list, {"vesicles.0.harmonics", form.c_str()});
  expect_complaint("shape = \"harmonics\"\nharmonics = [[2, 3, 0.1]]", {"vesicles.0.harmonics", "in [-2, 2]"});
  expect_complaint("shape = \"harmonics\"\nharmonics = [[2, 0, nan]]", {"vesicles.0.harmonics", "a finite number"});
  expect_complaint("shape = \"harmonics\"\nharmonics = [[15, 0, 0.1]]", {"vesicles.0.harmonics", "in [0, 14]"});
  expect_complaint("shape = \"harmonics\"\nharmonics = [[2, 0, 5.0]]", {"vesicles.0.harmonics", "smallest radius"});
  expect_complaint("shape = \"harmonics\"\n",
                   {"vesicles.0", "harmonics = [[degree, order, amplitude], ...] goes with"});
  expect_complaint("shape = \"sphere\"\nharmonics = [[2, 0, 0.1]]\n",
                   {"vesicles.0", "goes with shape = \"harmonics\""});
  expect_complaint("shape = \"biconcave\"\nreduced_volume = 0.6\n", {"vesicles.0", "prolate and oblate"});
  expect_complaint("shape = \"sphere\"\nfile = \"a.txt\"\n", {"vesicles.0", "\"coefficients\" or \"mesh\""});
  expect_complaint("shape = \"mesh\"\n", {"vesicles.0", "file = "});
  expect_complaint("shape = \"sphere\"\nfit_degrees = 4\n", {"vesicles.0", "fit_degrees goes with shape = \"mesh\""});
  expect_complaint("shape = \"coefficients\"\nfile = 3\n", {"vesicles.0.file = 3", "text"});
  expect_complaint("shape = \"coefficients\"\nfile = \"\"\n", {"vesicles.0.file", "cannot be read"});
}

TEST_F(InitialShapeTest, BadFilesAreRefusedByKeyFileAndLine) {
  expect_complaint(coefficients_keys, {"scene.toml: vesicles.0.file", "shapes/a.txt: cannot be read"});
  write("shapes/a.txt", "# bad\n1 2 0 0 0 0 0 0\n");
  expect_complaint(coefficients_keys, {"vesicles.0.file", "shapes/a.txt:2: m = 2: must be in [0, n]"});
  write("shapes/a.txt", "0 0 1 0 0 0 0 0\n");
  expect_complaint(coefficients_keys, {"vesicles.0.file", "enclosed volume = 0"});
  write("shapes/a.txt", "1 0 0 0 0 0 1 0\n1 1 1 0 0 1 0 0\n");
  expect_complaint(coefficients_keys, {"vesicles.0.file", "points inward"});

  write("shapes/a.obj", "v 0 0\n");
  expect_complaint(mesh_keys, {"vesicles.0.file", "shapes/a.obj:1: a vertex needs three"});
  write("shapes/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  expect_complaint(mesh_keys, {"vesicles.0.file", "shapes/a.obj", "vertex 3 belongs to no triangle"});
  write("shapes/a.obj", some_mesh());
  expect_complaint(mesh_keys, {"vesicles.0.fit_degrees", "degrees = 3: the fit needs 2 degrees^2 = 18", "at most 2"});
  const std::string message =
      complaint(mesh_keys, {"vesicles.0.fit_degrees=2", "mesh.latitudes=8", "vesicles.0.fit_degrees=65"});
  EXPECT_NE(message.find("vesicles.0.fit_degrees = 65: must be in [2, 64]"), std::string::npos) << message;
}

TEST_F(InitialShapeTest, ProgramsMayGiveTheSurfaceThemselves) {
  Scene scene = scene_with("shape = \"sphere\"\n");
  scene.vesicles[0].shape = coupling::Shape::coefficients;
  scene.surface_files[0].file = "never read";
  EXPECT_THROW(check_scene(scene, "program"), SceneError);
  scene.surface_files[0].file.reset();
  scene.vesicles[0].surface = some_surface();
  EXPECT_NO_THROW(check_scene(scene, "program"));
  EXPECT_TRUE(
      (start_of(scene) == vesicle::shape_from_coefficients(vesicle::SphereGrid(latitudes), some_surface(), placement))
          .all());
  scene.vesicles[0].shape = coupling::Shape::mesh;
  scene.surface_files[0].fit_degrees = 15;
  EXPECT_NO_THROW(check_scene(scene, "program"));
  scene.surface_files[0].fit_degrees = 16;
  EXPECT_THROW(check_scene(scene, "program"), SceneError);
  scene.surface_files[0].fit_degrees.reset();
  scene.vesicles[0].shape = coupling::Shape::sphere;
  EXPECT_THROW(check_scene(scene, "program"), SceneError);
}

TEST_F(InitialShapeTest, RestartFromTheCheckpointAloneNeedsNoFile) {
  vesicle::write_surface_coefficients(folder_ / "shapes/a.txt", some_surface());
  const auto go = [](const Scene& scene, const fs::path& directory, const std::optional<fs::path>& checkpoint) {
    SceneSimulation simulation(scene);
    RunOptions options;
    options.directory = directory;
    options.checkpoint = checkpoint;
    options.quiet = true;
    EXPECT_EQ(run(simulation, options), RunStatus::completed);
    return simulation.state().vesicles[0].membrane.positions;
  };
  const vesicle::VectorField whole = go(scene_with(coefficients_keys), folder_ / "whole", std::nullopt);
  go(scene_with(coefficients_keys, {"time.end=6/96"}), folder_ / "parts", std::nullopt);

  fs::remove(folder_ / "shapes/a.txt");
  const fs::path checkpoint = folder_ / "parts" / "checkpoint.h5";
  const Scene stored = read_checkpoint_scene(checkpoint, {"time.end=12/96"});
  EXPECT_EQ(stored.time.end, 0.125);
  EXPECT_TRUE(
      (start_of(stored) == vesicle::shape_from_coefficients(vesicle::SphereGrid(latitudes), some_surface(), placement))
          .all());
  EXPECT_TRUE((go(stored, folder_ / "parts", checkpoint) == whole).all());

  // With the scene file the file is read again, and must say the same.
  vesicle::Coefficients other = some_surface();
  other(0, 1, 1) *= 1.01;
  vesicle::write_surface_coefficients(folder_ / "shapes/a.txt", other);
  SceneSimulation changed(scene_with(coefficients_keys));
  try {
    restore_checkpoint(checkpoint, changed);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("another surface in vesicles.0.file"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace vesiflow::run::initial_shape_test
