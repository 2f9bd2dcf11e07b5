#include "vesicle/star_shaped_fit.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "meshes.h"
#include "support.h"

namespace vesiflow::vesicle {
namespace {

using std::numbers::pi;
using testing::octasphere;

/// Moves the vertices of a sphere about the origin to the given radius of their direction.
template <class Radius>
TriangleMesh star(int times, const Radius& radius) {
  TriangleMesh mesh = octasphere(times);
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) {
    const Vector3 d = mesh.vertices.row(i).matrix().normalized();
    mesh.vertices.row(i) = radius(d) * d.transpose().array();
  }
  return mesh;
}

double theta_of(const Vector3& d) {
  return std::atan2(std::hypot(d.x(), d.y()), d.z());
}
double phi_of(const Vector3& d) {
  return std::atan2(d.y(), d.x());
}

/// Random coefficients of even degree, hence a surface with a centre of symmetry, which then is the centroid of the mesh.
Coefficients symmetric_radius(int degrees) {
  Coefficients radius = testing::random_coefficients(degrees, 1, 17);
  for (int n = 0; n < degrees; ++n)
    for (int m = 0; m <= n; ++m) radius(0, n, m) *= n % 2 ? 0 : 0.06;
  radius(0, 0, 0) = std::sqrt(4 * pi);
  return radius;
}

std::string complaint(const TriangleMesh& mesh, int degrees) {
  try {
    fit_star_shaped(mesh, degrees);
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(StarShapedFit, RecoversABandLimitedRadiusToRoundOff) {
  const Coefficients radius = symmetric_radius(9);
  TriangleMesh mesh = star(4, [&](const Vector3& d) { return testing::point_value(radius, theta_of(d), phi_of(d)); });
  const Vector3 centre(3, -2, 10);
  mesh.vertices = 2 * mesh.vertices;
  mesh.vertices.rowwise() += centre.transpose().array();

  const StarShapedFit fit = fit_star_shaped(mesh, 14);
  EXPECT_LT((fit.centre - centre).norm(), 1e-13);
  EXPECT_NEAR(fit.mean_radius, 2, 1e-13);
  EXPECT_LT(fit.max_residual, 1e-13);
  EXPECT_LE(fit.rms_residual, fit.max_residual);
  ASSERT_EQ(fit.radius.degrees(), 14);
  for (int n = 0; n < 14; ++n)
    for (int m = 0; m <= n; ++m) {
      const Coefficients::Complex expected = n < 9 ? 2.0 * radius(0, n, m) : 0;
      EXPECT_LT(std::abs(fit.radius(0, n, m) - expected), 1e-12) << n << " " << m;
    }

  // X = centre + r d in Cartesian coefficients, of one degree more.
  ASSERT_EQ(fit.surface.degrees(), 15);
  const SphereGrid grid(20);
  VectorField x(grid.size(), 3);
  SphericalHarmonics(15, grid).synthesis(fit.surface, x);
  for (int j = 0; j < 20; j += 3)
    for (int i = 0; i < 40; i += 7) {
      const double theta = grid.colatitude()[j], phi = grid.longitude(i);
      const double r = 2 * testing::point_value(radius, theta, phi);
      const Vector3 expected =
          centre + r * Vector3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      EXPECT_LT((Vector3(x.row(grid.index(i, j))) - expected).norm(), 1e-12);
    }
}

/// The radius of a spheroid of axes 1:1:2, (1 - 3/4 cos^2)^(-1/2), has its singularities at cos = 2/sqrt(3): the degrees
/// of its expansion fall off like (1/sqrt(3))^n, by 9 in four degrees.
TEST(StarShapedFit, ConvergesOnTheSpheroidAtTheRateOfItsSingularity) {
  const TriangleMesh mesh = star(4, [](const Vector3& d) { return 1 / std::sqrt(1 - 0.75 * d.z() * d.z()); });
  double previous = fit_star_shaped(mesh, 6).rms_residual;
  for (int degrees : {10, 14, 18}) {
    const double residual = fit_star_shaped(mesh, degrees).rms_residual;
    EXPECT_GT(previous / residual, 8) << degrees;
    EXPECT_LT(previous / residual, 13) << degrees;
    previous = residual;
  }
  const Coefficients surface = fit_star_shaped(mesh, 20).surface;
  Surface fitted(32);
  fitted.update(shape_from_coefficients(fitted.grid(), surface));
  EXPECT_NEAR(reduced_volume(fitted.area(), fitted.volume()), spheroid_reduced_volume(2), 2e-6);
}

/// Known errors of the vertices come back as the residual: white noise of size e leaves e sqrt(1 - unknowns/vertices).
TEST(StarShapedFit, ResidualMeasuresTheNoiseOfTheVertices) {
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0, 1e-3);
  const TriangleMesh mesh = star(4, [&](const Vector3&) { return 1 + noise(generator); });
  const StarShapedFit fit = fit_star_shaped(mesh, 8);
  EXPECT_NEAR(fit.rms_residual, 1e-3 * std::sqrt(1 - 64.0 / 1026), 0.1e-3);  // 1026 samples: 2 %, four times that
  EXPECT_GT(fit.max_residual, 2 * fit.rms_residual);
  EXPECT_LT(fit.max_residual, 6e-3);
}

TEST(StarShapedFit, SurfaceWithoutSymmetryIsFittedAboutItsCentroid) {
  const auto radius = [](const Vector3& d) {
    return 1 + 0.2 * d.z() * d.x() + 0.25 * d.z() + 0.1 * d.x() * d.y() * d.z();
  };
  const TriangleMesh mesh = star(4, radius);
  const StarShapedFit fit = fit_star_shaped(mesh, 20);
  EXPECT_GT(fit.centre.norm(), 0.1);
  EXPECT_LT(fit.max_residual, 1e-6);
  // Points of the fitted surface lie on the given one.
  const SphereGrid grid(12);
  VectorField x(grid.size(), 3);
  SphericalHarmonics(21, grid).synthesis(fit.surface, x);
  double error = 0;
  for (Eigen::Index k = 0; k < grid.size(); ++k) {
    const Vector3 p = x.row(k);
    error = std::max(error, std::abs(p.norm() - radius(p.normalized())));
  }
  EXPECT_LT(error, 2e-6);
}

TEST(StarShapedFit, MeshesThatTurnInwardGiveTheSame) {
  const auto radius = [](const Vector3& d) { return 1 + 0.3 * d.x() * d.x(); };
  TriangleMesh mesh = star(3, radius);
  const StarShapedFit outward = fit_star_shaped(mesh, 5);
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  const StarShapedFit inward = fit_star_shaped(mesh, 5);
  for (int n = 0; n < 6; ++n)
    for (int m = 0; m <= n; ++m)
      EXPECT_LT(std::abs(inward.surface(0, n, m) - outward.surface(0, n, m)), 1e-14) << n << " " << m;
}

TEST(StarShapedFit, RefusesTooFewVerticesAndSaysHowManyAreNeeded) {
  EXPECT_EQ(complaint(octasphere(2), 5), "accepted");
  EXPECT_EQ(complaint(octasphere(2), 6),
            "degrees = 6: the fit needs 2 degrees^2 = 72 vertices and the mesh has 66; at most 5 degrees");
  EXPECT_EQ(complaint(octasphere(2), 1), "degrees = 1: must be >= 2");
}

TEST(StarShapedFit, RefusesMeshesThatAreNotStarShaped) {
  // The north pole pushed through the middle: a dimple whose walls are seen from behind.
  TriangleMesh mesh = octasphere(3);
  mesh.vertices.row(4) << 0, 0, -0.9;
  EXPECT_THROW(fit_star_shaped(mesh, 4), std::domain_error);
  const std::string what = complaint(mesh, 4);
  EXPECT_NE(what.find("not star-shaped"), std::string::npos) << what;
  EXPECT_NE(what.find("remesh"), std::string::npos) << what;
  const std::size_t at = what.find("volume triangle ");
  ASSERT_NE(at, std::string::npos) << what;
  // The triangle that is named is one of those at the pole.
  EXPECT_TRUE((mesh.triangles.row(std::stoi(what.substr(at + 16))) == 4).any()) << what;
}

TEST(StarShapedFit, RefusesWhatIsNoClosedSurface) {
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
}

TEST(StarShapedFit, RefusesVerticesThatLeaveGaps) {
  // All vertices but those on the equator crowd around the poles.
  TriangleMesh mesh = octasphere(4);
  mesh.vertices.col(2) *= 50;
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) mesh.vertices.row(i) /= mesh.vertices.row(i).matrix().norm();
  EXPECT_NE(complaint(mesh, 20).find("gaps"), std::string::npos) << complaint(mesh, 20);
}

}  // namespace
}  // namespace vesiflow::vesicle
