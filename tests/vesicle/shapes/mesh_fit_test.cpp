// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/mesh_fit.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "meshes.h"
#include "support.h"
#include "vesicle/diagnostics.h"

namespace vesiflow::vesicle::mesh_fit_test {
namespace {

using testing::mapped;
using testing::octasphere;

/// Of the smooth shape, from its own parametrisation.
template <class Shape>
AreaAndVolume truth(const Shape& shape) {
  Surface surface(96);
  const SphereGrid& grid = surface.grid();
  VectorField x(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const double s = grid.sin_colatitude()[j], phi = grid.longitude(i);
      const Vector3 d(s * std::cos(phi), s * std::sin(phi), grid.cos_colatitude()[j]);
      x.row(grid.index(i, j)) = Vector3(shape(d)).transpose().array();
    }
  surface.update(x);
  return {surface.area(), surface.volume()};
}

double reduced(const AreaAndVolume& of) {
  return reduced_volume(of.area, of.volume);
}

double worst_error(const AreaAndVolume& a, const AreaAndVolume& b) {
  return std::max(
      {std::abs(a.area / b.area - 1), std::abs(a.volume / b.volume - 1), std::abs(reduced(a) / reduced(b) - 1)});
}

std::string complaint(const TriangleMesh& mesh, int degrees) {
  try {
    fit_mesh(mesh, degrees);
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "accepted";
}

/// As many degrees as the vertices determine.
MeshFit fitted(const TriangleMesh& mesh) {
  return fit_mesh(mesh, default_fit_degrees(mesh.vertices.rows(), 64));
}

/// A smooth shape is met with all orders: 258 vertices determine 11 degrees, 1026 determine 22.
TEST(MeshFit, RedCellsConvergeFasterThanTheirTriangles) {
  const AreaAndVolume exact = truth(testing::red_cell);
  EXPECT_NEAR(reduced(exact), 0.6444, 5e-5);
  const MeshFit coarse = fitted(mapped(octasphere(3), testing::red_cell));
  const MeshFit fine = fitted(mapped(octasphere(4), testing::red_cell));
  EXPECT_LT(worst_error(coarse.fitted, exact), 2e-3);
  EXPECT_LT(worst_error(fine.fitted, exact), worst_error(coarse.fitted, exact) / 16);
  EXPECT_NEAR(coarse.triangles.area / exact.area - 1, 4 * (fine.triangles.area / exact.area - 1), 2e-3);
  EXPECT_LT(worst_error(fine.smooth, exact), worst_error(coarse.smooth, exact) / 8);
  EXPECT_LT(worst_error(fine.smooth, exact), worst_error(fine.triangles, exact) / 8);
}

TEST(MeshFit, StomatocytesConverge) {
  const AreaAndVolume exact = truth(testing::stomatocyte);
  const MeshFit coarse = fitted(mapped(octasphere(3), testing::stomatocyte));
  const MeshFit fine = fitted(mapped(octasphere(4), testing::stomatocyte));
  EXPECT_LT(worst_error(coarse.fitted, exact), 1e-2);
  EXPECT_LT(worst_error(fine.fitted, exact), worst_error(coarse.fitted, exact) / 4);
}

/// Faster than the second order of the triangles.
TEST(MeshFit, CigarsConverge) {
  const auto cigar = [](const Vector3& d) { return Vector3(d.x(), d.y(), 5 * d.z()); };
  const AreaAndVolume exact = truth(cigar);
  const MeshFit coarse = fitted(mapped(octasphere(3), cigar));
  const MeshFit fine = fitted(mapped(octasphere(4), cigar));
  EXPECT_LT(worst_error(coarse.fitted, exact), 3e-3);
  EXPECT_LT(worst_error(fine.fitted, exact), worst_error(coarse.fitted, exact) / 4);
}

/// To what the relaxation of the map leaves, which stops at gains of 1e-7 of its energy.
TEST(MeshFit, SurfaceLiesWhereTheMeshIsAndScalesWithIt) {
  const TriangleMesh mesh = mapped(octasphere(3), testing::red_cell);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  const Vector3 shift(3, -20, 100);
  const MeshFit here = fit_mesh(mesh, 10);
  const MeshFit there = fit_mesh(mapped(mesh, [&](const Vector3& x) { return Vector3(shift + 5 * (turn * x)); }), 10);
  EXPECT_NEAR(there.fitted.area / here.fitted.area, 25, 25e-6);
  EXPECT_NEAR(there.fitted.volume / here.fitted.volume, 125, 125e-6);
  EXPECT_NEAR(there.triangles.volume / here.triangles.volume, 125, 1e-11);
  EXPECT_NEAR(there.radius / here.radius, 5, 1e-12);
  EXPECT_NEAR(there.rms_distance, here.rms_distance, 1e-6);
  // X turns with the mesh: places on the sphere are those of the body.
  Surface a(16), b(16);
  VectorField x(a.grid().size(), 3);
  SphericalHarmonics(10, a.grid()).synthesis(here.surface, x);
  a.update(x);
  SphericalHarmonics(10, b.grid()).synthesis(there.surface, x);
  b.update(x);
  EXPECT_NEAR(b.area() / a.area(), 25, 25e-6);
  const VolumeMoments p = volume_moments(a), q = volume_moments(b);
  EXPECT_LT((q.centroid - (shift + 5 * (turn * p.centroid))).norm(), 1e-6);
  EXPECT_LT((q.semi_axes - 5 * p.semi_axes).norm(), 5e-6);
}

TEST(MeshFit, MeshesThatTurnInwardGiveTheSame) {
  TriangleMesh mesh = mapped(octasphere(3), testing::red_cell);
  const MeshFit outward = fit_mesh(mesh, 8);
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  const MeshFit inward = fit_mesh(mesh, 8);
  EXPECT_NEAR(inward.fitted.area, outward.fitted.area, 1e-6 * outward.fitted.area);
  EXPECT_NEAR(inward.fitted.volume, outward.fitted.volume, 1e-6 * outward.fitted.volume);
}

/// Errors of the vertices are smoothed out of the shape and come back as the residual. A fit without smoothing would leave
/// e sqrt(1 - unknowns/vertices) of white noise of size e.
TEST(MeshFit, NoiseOfTheVerticesIsSmoothedOut) {
  constexpr double size = 5e-3;
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0, size);
  const TriangleMesh mesh =
      mapped(octasphere(4), [&](const Vector3& d) { return Vector3((1 + noise(generator)) * d); });
  const MeshFit fit = fit_mesh(mesh, 20);
  EXPECT_GT(fit.rms_distance, size * std::sqrt(1 - 400.0 / 1026));
  EXPECT_LT(fit.rms_distance, 1.1 * size);  // 1026 samples: 2 %
  // The area that noise adds to the triangles is that which it leaves in the fit and the roughness, up to chance.
  const double added = fit.triangles.area - fit_mesh(octasphere(4), 2).triangles.area;
  EXPECT_NEAR(fit.fitted.area - 4 * std::numbers::pi + fit.roughness, added, added / 4);
  EXPECT_GT(fit.roughness, 0.01);
  EXPECT_LT(std::abs(fit.fitted.area / (4 * std::numbers::pi) - 1), 1e-3);
}

TEST(MeshFit, RefusesWhatIsAnotherShapeWithNumbersAndAdvice) {
  const std::string what = complaint(mapped(octasphere(3), testing::stomatocyte), 4);
  for (const char* part : {"the surface of 4 degrees is another shape than the mesh: area ", "volume ",
                           "reduced volume ", "between the vertices", "take more degrees"})
    EXPECT_NE(what.find(part), std::string::npos) << what;
}

TEST(MeshFit, RefusesTooFewVerticesAndSaysHowManyAreNeeded) {
  EXPECT_EQ(complaint(octasphere(2), 5), "accepted");
  EXPECT_EQ(complaint(octasphere(2), 6),
            "degrees = 6: the fit needs 2 degrees^2 = 72 vertices and the mesh has 66; at most 5 degrees");
  EXPECT_EQ(complaint(octasphere(2), 1), "degrees = 1: must be >= 2");
  EXPECT_EQ(default_fit_degrees(66, 64), 5);
  EXPECT_EQ(default_fit_degrees(66, 4), 3);
  EXPECT_EQ(default_fit_degrees(10242, 64), 32);
  EXPECT_EQ(default_fit_degrees(4, 64), 2);
}

TEST(MeshFit, RefusesWhatIsNoClosedSurface) {
  TriangleMesh mesh = octasphere(3);
  std::swap(mesh.triangles(9, 1), mesh.triangles(9, 2));
  EXPECT_NE(complaint(mesh, 4).find("triangle 9 is inside out"), std::string::npos) << complaint(mesh, 4);
  mesh = octasphere(3);
  mesh.triangles.conservativeResize(mesh.triangles.rows() - 1, 3);
  EXPECT_NE(complaint(mesh, 4).find("is open"), std::string::npos) << complaint(mesh, 4);
  mesh = octasphere(3);
  mesh.vertices(11, 2) = std::numeric_limits<double>::infinity();
  EXPECT_NE(complaint(mesh, 4).find("vertex 11 is not finite"), std::string::npos) << complaint(mesh, 4);
  EXPECT_NE(complaint(testing::torus(12, 8), 4).find("1 handle"), std::string::npos);
  mesh = octasphere(3);
  mesh.vertices *= 1e200;
  EXPECT_NE(complaint(mesh, 4).find("must be in [1e-100, 1e100]"), std::string::npos) << complaint(mesh, 4);
  mesh = octasphere(3);
  mesh.vertices.col(2) *= 1e-12;
  EXPECT_NE(complaint(mesh, 4).find("encloses no volume"), std::string::npos) << complaint(mesh, 4);
}

TEST(MeshFit, RefusesSurfacesThatCrossThemselves) {
  TriangleMesh mesh = octasphere(3);
  EXPECT_NO_THROW(check_no_crossings(mesh));
  mesh.vertices.row(4) << 0.01, 0.02, -1.5;  // the north pole pushed through the south
  const std::string what = complaint(mesh, 4);
  EXPECT_NE(what.find("cut through each other"), std::string::npos) << what;
}

// Processor seconds of a look at a tube along an axis, of rings of three vertices.
double cost_of_crossings_along(int axis) {
  constexpr int rings = 3000;
  TriangleMesh mesh{VectorField(3 * rings, 3), decltype(TriangleMesh::triangles)(6 * (rings - 1), 3)};
  for (int i = 0; i < 3 * rings; ++i) {
    const double angle = 2 * std::numbers::pi * (i % 3) / 3;
    mesh.vertices(i, axis) = i / 3;
    mesh.vertices(i, (axis + 1) % 3) = std::cos(angle);
    mesh.vertices(i, (axis + 2) % 3) = std::sin(angle);
  }
  for (int i = 0; i < 3 * (rings - 1); ++i) {
    const int next = i % 3 == 2 ? i - 2 : i + 1;
    mesh.triangles.row(2 * i) << i, next, next + 3;
    mesh.triangles.row(2 * i + 1) << i, next + 3, i + 3;
  }
  const std::clock_t start = std::clock();
  check_no_crossings(mesh);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// Seen from the end of a tube, every triangle is beside a good part of all others.
TEST(MeshFit, LooksForCrossingsAlongTheLongestAxis) {
  const double along_x = cost_of_crossings_along(0);
  for (const int axis : {1, 2}) EXPECT_LT(cost_of_crossings_along(axis), 4 * along_x + 0.02);
}

}  // namespace
}  // namespace vesiflow::vesicle::mesh_fit_test
