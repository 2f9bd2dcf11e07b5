// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/shapes.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support.h"
#include "vesicle/diagnostics.h"
#include "vesicle/surface.h"

namespace vesiflow::vesicle::shapes_test {
namespace {

using std::numbers::pi;

TEST(Shapes, SpheroidsHitTheReducedVolume) {
  for (double v : {1e-3, 0.3, 0.6, 0.8, 0.95, 0.999, 1 - 1e-10, 1.0}) {
    EXPECT_NEAR(spheroid_reduced_volume(prolate_aspect_ratio(v)), v, 1e-12);
    EXPECT_NEAR(spheroid_reduced_volume(oblate_aspect_ratio(v)), v, 1e-12);
    EXPECT_GE(prolate_aspect_ratio(v), 1);
    EXPECT_LE(oblate_aspect_ratio(v), 1);
  }
}

/// Reference aspect ratios, c/a of prolates.
TEST(Shapes, AspectRatiosAgainstReference) {
  EXPECT_NEAR(prolate_aspect_ratio(0.975), 1.3733491471145063, 1e-10);
  EXPECT_NEAR(prolate_aspect_ratio(0.9), 1.9621762549176347, 1e-11);
  EXPECT_NEAR(prolate_aspect_ratio(0.8), 2.791386466405403, 1e-11);
  EXPECT_NEAR(spheroid_reduced_volume(1.0 / 3), 0.7103340305170204, 1e-15);
  EXPECT_NEAR(spheroid_reduced_volume(2.8), 0.7990751130622032, 1e-15);
}

TEST(Shapes, MeshesHaveTheReducedVolumeAndTheVolume) {
  Surface surface(64);
  for (double v : {0.7, 0.8, 0.9, 0.975}) {
    for (const VectorField& x : {prolate(surface.grid(), v, {.effective_radius = 1.5}),
                                 oblate(surface.grid(), v, {.effective_radius = 1.5})}) {
      surface.update(x);
      EXPECT_NEAR(reduced_volume(surface.area(), surface.volume()), v, 1e-11) << v;
      EXPECT_NEAR(surface.volume(), 4 * pi / 3 * std::pow(1.5, 3), 1e-11);
    }
  }
}

TEST(Shapes, ArePlaced) {
  const SphereGrid grid(16);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.4, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3 centre(5, -3, 1);
  const VectorField plain = ellipsoid(grid, {1, 2, 3});
  const VectorField placed = ellipsoid(grid, {2, 4, 6}, {1, rotation, centre});
  const VectorField expected = ((rotation * plain.matrix().transpose()).colwise() + centre).transpose().array();
  EXPECT_LT((placed - expected).abs().maxCoeff(), 1e-14);
}

/// Volume and area of the profile of Evans and Fung with radius 1, by Simpson's rule over the polar angle.
std::pair<double, double> evans_fung_volume_and_area() {
  const auto half_thickness = [](double t) {
    const double s2 = std::sin(t) * std::sin(t);
    return 0.5 * std::cos(t) * (0.207161 + 2.002558 * s2 - 1.122762 * s2 * s2);
  };
  double volume = 0, area = 0;
  constexpr int panels = 2000;
  const double h = pi / 2 / panels;
  for (int k = 0; k <= panels; ++k) {
    const double t = k * h, e = 1e-4;
    const double slope =
        (8 * (half_thickness(t + e) - half_thickness(t - e)) - half_thickness(t + 2 * e) + half_thickness(t - 2 * e)) /
        (12 * e);
    const double weight = (k == 0 || k == panels ? 1 : k % 2 == 1 ? 4 : 2) * h / 3;
    volume += weight * 4 * pi * std::sin(t) * std::cos(t) * half_thickness(t);
    area += weight * 4 * pi * std::sin(t) * std::hypot(std::cos(t), slope);
  }
  return {volume, area};
}

TEST(Shapes, BiconcaveDiscIsEvansAndFungs) {
  const auto [volume, area] = evans_fung_volume_and_area();
  // Their cell of radius 3.91 um is 0.81 um thick in the middle; their mean volume and area over all cells, 94 um^3 and
  // 135 um^2, are those of the mean profile to a per cent.
  EXPECT_NEAR(volume * std::pow(3.91, 3), 94, 0.94);
  EXPECT_NEAR(area * std::pow(3.91, 2), 135, 1.35);
  EXPECT_NEAR(reduced_volume(area, volume), 0.6444, 5e-5);

  Surface surface(64);
  surface.update(biconcave_disc(surface.grid(), {.effective_radius = 1.5}));
  EXPECT_NEAR(surface.volume(), 4 * pi / 3 * std::pow(1.5, 3), 1e-11);
  EXPECT_NEAR(reduced_volume(surface.area(), surface.volume()), reduced_volume(area, volume), 1e-11);
  const double scale = 1.5 / std::cbrt(volume / (4 * pi / 3));
  const Vector3 next_to_pole = surface.positions().row(0);
  EXPECT_NEAR(2 * next_to_pole.z() / scale, 0.81 / 3.91, 0.003);
}

TEST(Shapes, PerturbedSphereHasTheGivenHarmonics) {
  Surface surface(24);
  const std::vector<Harmonic> terms{{2, 0, 0.1}, {3, 2, 0.2}, {5, -3, -0.15}, {0, 0, 0.3}};
  surface.update(perturbed_sphere(surface.grid(), terms, {.effective_radius = 2}));
  EXPECT_NEAR(surface.volume(), 4 * pi / 3 * 8, 1e-11);
  const auto y = [](unsigned n, unsigned m, double theta) { return (m % 2 ? -1 : 1) * std::sph_legendre(n, m, theta); };
  const SphereGrid& grid = surface.grid();
  ScalarField ratio(grid.size());
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const double theta = grid.colatitude()[j], phi = grid.longitude(i);
      const double r = 1 + 0.1 * y(2, 0, theta) + 0.2 * y(3, 2, theta) * std::cos(2 * phi) -
                       0.15 * y(5, 3, theta) * std::sin(3 * phi) + 0.3 / std::sqrt(4 * pi);
      const Vector3 x = surface.positions().row(grid.index(i, j));
      ratio[grid.index(i, j)] = x.norm() / r;
      EXPECT_NEAR(std::acos(x.z() / x.norm()), theta, 1e-13);
    }
  EXPECT_LT(ratio.maxCoeff() - ratio.minCoeff(), 1e-13);
}

/// For r = 1 + a Y_2^0, int r^3 = 4 pi + 3 a^2 + a^3 sqrt(5/pi)/7, from the integrals of powers of Y_2^0.
TEST(Shapes, PerturbedSphereIsScaledByItsExactVolume) {
  const SphereGrid grid(8);
  const double a = 0.4;
  const VectorField x = perturbed_sphere(grid, std::vector<Harmonic>{{2, 0, a}});
  const double volume = (4 * pi + 3 * a * a + a * a * a * std::sqrt(5 / pi) / 7) / 3;
  const double r = 1 + a * std::sph_legendre(2, 0, grid.colatitude()[3]);
  EXPECT_NEAR(x.row(grid.index(5, 3)).matrix().norm(), r / std::cbrt(volume / (4 * pi / 3)), 1e-14);
}

TEST(Shapes, CoefficientsGiveBackTheShapeTheyCameFrom) {
  // The same ellipsoid placed anywhere, of any size, has its shape in its coefficients.
  Surface source(12);
  source.update(ellipsoid(source.grid(), {1, 2, 3}, {2.5, Eigen::Matrix3d::Identity(), Vector3(7, -8, 9)}));
  const SphereGrid grid(20);
  const Placement placement{0.5, Eigen::AngleAxisd(1.1, Vector3(1, 1, -2).normalized()).toRotationMatrix(),
                            Vector3(-1, 0.5, 3)};
  const VectorField x = shape_from_coefficients(grid, source.position_coefficients(), placement);
  EXPECT_LT((x - ellipsoid(grid, {1, 2, 3}, placement)).abs().maxCoeff(), 1e-13);
}

TEST(Shapes, CoefficientsOfAnySizeGiveTheSameShape) {
  Surface source(8);
  source.update(ellipsoid(source.grid(), {1, 2, 3}));
  const SphereGrid grid(8);
  const VectorField x = shape_from_coefficients(grid, source.position_coefficients());
  // Powers of two, of which cubes and fourth powers overflow or vanish, within the range of doubles.
  for (const int exponent : {-900, -300, 300, 900}) {
    Coefficients coefficients = source.position_coefficients();
    for (int n = 0; n < coefficients.degrees(); ++n)
      for (int m = 0; m <= n; ++m)
        for (int f = 0; f < 3; ++f) coefficients(f, n, m) *= std::ldexp(1.0, exponent);
    EXPECT_LT((shape_from_coefficients(grid, coefficients) - x).abs().maxCoeff(), 1e-14) << exponent;
  }
}

TEST(Shapes, CoefficientsAreScaledToTheVolumeAndCentredOnTheCentroid) {
  // No symmetry, and more degrees than the nodes that it is then given on have latitudes.
  Surface source(24);
  source.update(
      perturbed_sphere(source.grid(), std::vector<Harmonic>{{1, 1, 0.3}, {2, 0, 0.3}, {3, -2, 0.2}, {5, 4, 0.1}}));
  EXPECT_GT(volume_moments(source).centroid.norm(), 0.05);
  Coefficients coefficients = source.position_coefficients();
  Surface surface(32);
  surface.update(shape_from_coefficients(surface.grid(), coefficients, {.effective_radius = 3, .centre = {1, 2, 3}}));
  EXPECT_NEAR(surface.volume(), 36 * pi, 1e-10);
  EXPECT_LT((volume_moments(surface).centroid - Vector3(1, 2, 3)).norm(), 1e-12);
  const VectorField coarse = shape_from_coefficients(SphereGrid(8), coefficients);
  const VectorField fine = shape_from_coefficients(SphereGrid(8, 32), coefficients);
  EXPECT_LT((coarse.row(3) - fine.row(6)).abs().maxCoeff(), 1e-14);
}

TEST(Shapes, RefuseSurfacesThatAreNone) {
  const SphereGrid grid(8);
  Surface source(12);
  source.update(ellipsoid(source.grid(), {1, 2, 3}));
  Coefficients inward = source.position_coefficients();
  for (int field = 0; field < 3; ++field)
    for (int n = 0; n < inward.degrees(); ++n)
      for (int m = 0; m <= n; ++m) inward(field, n, m) = std::conj(inward(field, n, m));
  try {
    shape_from_coefficients(grid, inward);
    FAIL();
  } catch (const std::domain_error& error) {
    EXPECT_NE(std::string(error.what()).find("enclosed volume = -4.18"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("points inward"), std::string::npos) << error.what();
  }
  EXPECT_THROW(shape_from_coefficients(grid, testing::random_coefficients(4, 2, 1)), std::invalid_argument);
  inward(1, 2, 2) = std::nan("");
  EXPECT_THROW(shape_from_coefficients(grid, inward), std::invalid_argument);
  Coefficients point(3, 3);
  point.set_zero();
  EXPECT_THROW(shape_from_coefficients(grid, point), std::domain_error);

  const auto perturbed = [&grid](const Harmonic& term) {
    try {
      perturbed_sphere(grid, std::vector{term});
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(perturbed({6, 6, 0.1}), "accepted");
  EXPECT_EQ(perturbed({7, 0, 0.1}), "degree of a harmonic = 7: must be in [0, 6], the latitudes of the mesh less two");
  EXPECT_EQ(perturbed({-1, 0, 0.1}),
            "degree of a harmonic = -1: must be in [0, 6], the latitudes of the mesh less two");
  EXPECT_EQ(perturbed({2, -3, 0.1}), "order of a harmonic = -3: must be in [-n, n], n = 2 its degree");
  EXPECT_EQ(perturbed({2, 0, std::nan("")}), "amplitude of a harmonic = nan: must be finite");
  // At the equator Y_2^0 = -sqrt(5/(16 pi)), so the largest amplitude is 3.17, at the poles -1.585.
  EXPECT_EQ(perturbed({2, 0, 3.0}), "accepted");
  EXPECT_NE(perturbed({2, 0, 3.4}).find("smallest radius of the perturbed sphere = -0.0"), std::string::npos);
}

TEST(Shapes, RefuseBadArgumentsWithValueAndRange) {
  const SphereGrid grid(8);
  EXPECT_THROW(prolate(grid, 0), std::invalid_argument);
  EXPECT_THROW(oblate(grid, -0.5), std::invalid_argument);
  EXPECT_THROW(oblate(grid, std::nan("")), std::invalid_argument);
  EXPECT_THROW(prolate(grid, 1e-300), std::invalid_argument);
  EXPECT_THROW(spheroid(grid, 0), std::invalid_argument);
  EXPECT_THROW(ellipsoid(grid, {1, -1, 1}), std::invalid_argument);
  EXPECT_THROW(sphere(grid, {.effective_radius = 0}), std::invalid_argument);
  EXPECT_THROW(sphere(grid, {.rotation = 2 * Eigen::Matrix3d::Identity()}), std::invalid_argument);
  EXPECT_THROW(sphere(grid, {.rotation = std::nan("") * Eigen::Matrix3d::Identity()}), std::invalid_argument);
  EXPECT_THROW(sphere(grid, {.centre = {0, std::nan(""), 0}}), std::invalid_argument);
  EXPECT_THROW(biconcave_disc(grid, {.effective_radius = -1}), std::invalid_argument);
  EXPECT_THROW(perturbed_sphere(grid, {}, {.effective_radius = 0}), std::invalid_argument);
  EXPECT_THROW(shape_from_coefficients(grid, testing::random_coefficients(4, 3, 1), {.effective_radius = 0}),
               std::invalid_argument);
  EXPECT_THROW(sphere(grid, {.rotation = -Eigen::Matrix3d::Identity()}), std::invalid_argument);
  try {
    prolate(grid, 1.25);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "reduced_volume = 1.25: must be in (0, 1]");
  }
}

/// 6 sqrt(pi) V / A^{3/2} -> 2 sqrt(2) q for flat discs, where 1 - q^2 rounds to 1.
TEST(Shapes, FlatSpheroidsFollowTheirLimit) {
  for (const double q : {1e-7, 1e-9, 1e-20}) {
    EXPECT_NEAR(spheroid_reduced_volume(q), 2 * M_SQRT2 * q, 1e-11 * q) << q;
    EXPECT_NEAR(oblate_aspect_ratio(2 * M_SQRT2 * q), q, 1e-11 * q) << q;
  }
}

TEST(Shapes, RefuseNumbersThatWouldOverflow) {
  const SphereGrid grid(4);
  EXPECT_THROW(ellipsoid(grid, Vector3::Constant(1e-200)), std::invalid_argument);
  EXPECT_THROW(ellipsoid(grid, Vector3::Constant(1e200)), std::invalid_argument);
  const std::vector<Harmonic> term{{2, std::numeric_limits<int>::min(), 0.1}};
  EXPECT_THROW(perturbed_sphere(grid, term), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::vesicle::shapes_test
