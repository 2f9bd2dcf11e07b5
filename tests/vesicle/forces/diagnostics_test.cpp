// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/diagnostics.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support.h"

namespace vesiflow::vesicle::diagnostics_test {
namespace {

using std::numbers::pi;
using testing::cross;

constexpr int latitudes = 32;

/// Takes the polar axis z to the direction at `angle` from x in the xz-plane.
Eigen::Matrix3d inclined(double angle) {
  return Eigen::AngleAxisd(pi / 2 - angle, Vector3::UnitY()).toRotationMatrix();
}

TEST(Diagnostics, MomentsOfAPlacedEllipsoid) {
  Surface surface(latitudes);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.7, Vector3(1, -1, 2).normalized()).toRotationMatrix();
  const Vector3 centre(30, -20, 10);
  surface.update(ellipsoid(surface.grid(), {1, 2, 4}, {2, rotation, centre}));
  const VolumeMoments moments = volume_moments(surface);
  EXPECT_NEAR(moments.volume, 32 * pi / 3, 1e-11);
  EXPECT_LT((moments.centroid - centre).norm(), 1e-12);
  EXPECT_LT((moments.semi_axes - Vector3(4, 2, 1)).norm(), 1e-11);
  EXPECT_NEAR(std::abs(moments.directions.col(0).dot(rotation.col(2))), 1, 1e-13);
  const Eigen::Matrix3d exact = moments.volume / 5 * rotation * Vector3(1, 4, 16).asDiagonal() * rotation.transpose();
  EXPECT_LT((moments.second_moments - exact).norm(), 1e-10);
  EXPECT_NEAR(deformation(moments), 0.6, 1e-12);
  // A solid ellipsoid turning about its longest axis: V (a^2 + b^2) / 5.
  EXPECT_NEAR(rotation.col(2).dot(moments.inertia() * rotation.col(2)), moments.volume * (1 + 4) / 5, 1e-10);
}

TEST(Diagnostics, InclinationOfARotatedProlate) {
  Surface surface(latitudes);
  for (double angle : {-1.5, -0.4, 0.0, 0.3, pi / 4, 1.5, pi / 2}) {
    surface.update(prolate(surface.grid(), 0.9, {.rotation = inclined(angle)}));
    EXPECT_NEAR(std::remainder(inclination_angle(volume_moments(surface)) - angle, pi), 0, 1e-12) << angle;
  }
}

/// A reduced volume of 0.95 is an excess area of 0.437.
TEST(Diagnostics, ExcessAreaAndReducedVolumeAgree) {
  Surface surface(latitudes);
  surface.update(prolate(surface.grid(), 0.95, {.effective_radius = 1.7}));
  const double delta = excess_area(surface.area(), surface.volume());
  EXPECT_NEAR(delta, 0.437, 5e-4);
  EXPECT_NEAR(std::pow(1 + delta / (4 * pi), -1.5), reduced_volume(surface.area(), surface.volume()), 1e-13);
}

TEST(Diagnostics, InclinationIsUndefinedWithoutALongestAxisInThePlane) {
  Surface surface(latitudes);
  const Eigen::Matrix3d along_y = Eigen::AngleAxisd(pi / 2, Vector3::UnitX()).toRotationMatrix();
  for (const VectorField& x :
       {sphere(surface.grid()), oblate(surface.grid(), 0.9), prolate(surface.grid(), 0.9, {.rotation = along_y})}) {
    surface.update(x);
    EXPECT_TRUE(std::isnan(inclination_angle(volume_moments(surface))));
  }
}

TEST(Diagnostics, RigidRotationGivesItsAngularVelocity) {
  Surface surface(latitudes);
  for (const VectorField& x : {sphere(surface.grid()), prolate(surface.grid(), 0.8, {.centre = {1, 2, 3}})}) {
    surface.update(x);
    VectorField velocity = cross({0, 0.5, 0}, x);
    velocity.rowwise() += Eigen::Array3d(4, 5, 6).transpose();
    EXPECT_NEAR(tank_treading_frequency(surface, volume_moments(surface).centroid, velocity), 0.5, 1e-13);
  }
}

TEST(Diagnostics, TheFrequencyDoesNotDependOnTheUnitOfLength) {
  Surface surface(latitudes);
  const VectorField x = prolate(surface.grid(), 0.9);
  VectorField velocity = VectorField::Zero(x.rows(), 3);
  velocity.col(0) = x.col(2);  // shear: the share of each marker counts
  const auto frequency = [&](double scale) {
    surface.update(scale * x);
    return tank_treading_frequency(surface, Vector3::Zero(), scale * velocity);
  };
  const double one = frequency(1);
  for (const double scale : {1e-3, 3e-6, 1e5}) EXPECT_NEAR(frequency(scale), one, 1e-13) << scale;
  EXPECT_EQ(frequency(std::ldexp(1, -20)), one);
}

TEST(Diagnostics, SpectrumTailOfSmoothAndRoughShapes) {
  Surface surface(latitudes);
  surface.update(ellipsoid(surface.grid(), {1, 2, 4}));
  EXPECT_LT(spectrum_tail(surface), 1e-28);
  const VectorField rough = surface.positions() + 1e-3 * testing::smooth_vector(surface.grid(), latitudes, 81);
  surface.update(rough);
  EXPECT_GT(spectrum_tail(surface), 1e-9);
}

TEST(Diagnostics, MeasuresAStretchedMembrane) {
  const SphereGrid grid(latitudes);
  const VectorField start = sphere(grid);
  Membrane membrane(start, latitudes, {.sigma0 = 10});
  const VectorField still = VectorField::Zero(grid.size(), 3);
  const VectorField expansion = start;
  membrane.advance(1.1 * start, still, still, 0.1);
  membrane.update_geometry();
  membrane.compute_force();
  const Diagnostics d = measure(membrane, cross({0, 0.5, 0}, start), expansion);
  EXPECT_NEAR(d.area, 4 * pi * 1.21, 1e-12);
  EXPECT_NEAR(d.area_error, 0.21, 1e-13);
  EXPECT_NEAR(d.volume_error, 0.331, 1e-13);
  EXPECT_NEAR(d.reduced_volume, 1, 1e-13);
  EXPECT_NEAR(d.max_local_area_error, 0.21, 1e-12);
  EXPECT_NEAR(d.max_label_area_error, 0.21, 1e-12);
  EXPECT_NEAR(d.bending_energy, 2 * pi, 1e-12);
  EXPECT_NEAR(d.excess_area, 0, 1e-12);
  EXPECT_NEAR(d.deformation, 0, 1e-12);
  EXPECT_NEAR(d.elastic_energy, 5 * std::pow(std::log(1.21), 2) * 4 * pi, 1e-10);
  EXPECT_TRUE(d.resolution.sufficient());
  EXPECT_NEAR(d.tension_min, 10 / 1.21 * std::log(1.21), 1e-11);
  EXPECT_NEAR(d.tension_max, d.tension_min, 1e-11);
  EXPECT_NEAR(d.surface_divergence_max, 2 / 1.1, 1e-11);
  EXPECT_NEAR(d.tank_treading_frequency, 0.5 / 1.1, 1e-13);
  EXPECT_TRUE(std::isnan(d.inclination_angle));
}

TEST(Diagnostics, ClosedFormsRefuseWhatNoBodyHas) {
  for (const double wrong : {0.0, -1.0, std::nan(""), double{INFINITY}}) {
    EXPECT_THROW(reduced_volume(1, wrong), std::invalid_argument);
    EXPECT_THROW(reduced_volume(wrong, 1), std::invalid_argument);
    EXPECT_THROW(excess_area(1, wrong), std::invalid_argument);
    EXPECT_THROW(excess_area(wrong, 1), std::invalid_argument);
  }
  VolumeMoments moments;
  EXPECT_THROW(deformation(moments), std::invalid_argument);
  for (const double wrong : {-1.0, 3.0, std::nan("")}) {
    moments.semi_axes = {2, 1, wrong};
    EXPECT_THROW(deformation(moments), std::invalid_argument);
  }
  moments.semi_axes = {2, 1, 0};  // a disc
  EXPECT_EQ(deformation(moments), 1);
}

TEST(Diagnostics, RefuseVelocitiesThatAreNotFinite) {
  const SphereGrid grid(8);
  const VectorField x = ellipsoid(grid, {1, 1.2, 1.5});
  Membrane membrane(x, 8, {.sigma0 = 10});
  const Surface& surface = membrane.surface();
  using Field = const VectorField&;
  testing::expect_refused_if_not_finite(x, [&](Field u) { tank_treading_frequency(surface, Vector3::Zero(), u); });
  testing::expect_refused_if_not_finite(x, [&](Field u) { surface.max_divergence(u); });
  testing::expect_refused_if_not_finite(x, [&](Field u) { measure(membrane, u, x); });
  testing::expect_refused_if_not_finite(x, [&](Field u) { measure(membrane, x, u); });
  EXPECT_THROW(tank_treading_frequency(surface, {0, 0, std::nan("")}, x), std::invalid_argument);
}

TEST(Diagnostics, OfAMembraneTurnedInsideOut) {
  const SphereGrid grid(latitudes);
  VectorField x = ellipsoid(grid, {1, 1.2, 1.5});
  Membrane membrane(x, latitudes, {.sigma0 = 0});
  const double volume = membrane.initial_volume();
  const VectorField still = VectorField::Zero(grid.size(), 3);
  x.col(0) *= -1;
  membrane.advance(x, still, still, 0.1);
  membrane.update_geometry();
  const Diagnostics d = measure(membrane, still, still);
  EXPECT_NEAR(d.volume, -volume, 1e-12 * volume);
  EXPECT_NEAR(d.volume_error, -2, 1e-12);
  EXPECT_TRUE(std::isnan(d.reduced_volume) && std::isnan(d.excess_area) && std::isnan(d.deformation));
}

}  // namespace
}  // namespace vesiflow::vesicle::diagnostics_test
