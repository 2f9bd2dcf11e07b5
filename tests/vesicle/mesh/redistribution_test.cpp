// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/redistribution.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support.h"
#include "vesicle/bending.h"
#include "vesicle/diagnostics.h"
#include "vesicle/membrane.h"

namespace vesiflow::vesicle::redistribution_test {
namespace {

constexpr int latitudes = 32;

/// Smooth one-to-one maps of the sphere that spoil a mesh.
Vector3 sheared(const Vector3& d) {  // longitudes turned by 3 cos(theta)
  const double turn = 3 * d[2];
  return {std::cos(turn) * d[0] - std::sin(turn) * d[1], std::sin(turn) * d[0] + std::cos(turn) * d[1], d[2]};
}
Vector3 clustered(const Vector3& d) {  // towards +x
  return (d + Vector3(0.5, 0, 0)).normalized();
}
Vector3 wound(const Vector3& d) {  // about y, the more the further from the plane y = 0, as tank-treading does
  const double turn = d[1] * d[1];
  return {std::cos(turn) * d[0] - std::sin(turn) * d[2], d[1], std::sin(turn) * d[0] + std::cos(turn) * d[2]};
}
Vector3 unchanged(const Vector3& d) {
  return d;
}

using Map = Vector3 (*)(const Vector3&);

template <class Function>
auto at_nodes(const SphereGrid& grid, Map map, Function function) {
  const VectorField nodes = sphere(grid);
  Eigen::ArrayXXd values;
  for (Eigen::Index k = 0; k < nodes.rows(); ++k) {
    const auto value = function(map(nodes.row(k).matrix().transpose()));
    values.conservativeResize(nodes.rows(), value.size());
    values.row(k) = value.transpose().array();
  }
  return values;
}

const Vector3 semi_axes{1.3, 0.7, 1.6};

VectorField ellipsoid_under(const SphereGrid& grid, Map map) {
  return at_nodes(grid, map, [](const Vector3& d) { return Vector3(semi_axes.cwiseProduct(d)); });
}

/// | |x/a|^2 - 1 |, twice the relative distance from the ellipsoid.
double off_ellipsoid(const VectorField& x) {
  return ((x.col(0) / semi_axes[0]).square() + (x.col(1) / semi_axes[1]).square() + (x.col(2) / semi_axes[2]).square() -
          1)
      .abs()
      .maxCoeff();
}

TEST(MeshQuality, OfEllipsoidsInClosedForm) {
  Surface surface(latitudes);
  surface.update(sphere(surface.grid()));
  EXPECT_NEAR(mesh_quality(surface).aspect_ratio, 1, 1e-6);  // the square root of round-off
  EXPECT_NEAR(mesh_quality(surface).area_ratio, 1, 1e-12);
  // A prolate of aspect 2: stretches 2 and 1 at the equator, 1 and 1 at the poles. No marker is at either.
  surface.update(spheroid(surface.grid(), 2));
  const double s = surface.grid().sin_colatitude()[latitudes / 2], c = surface.grid().cos_colatitude()[latitudes / 2];
  EXPECT_NEAR(mesh_quality(surface).aspect_ratio, std::sqrt(4 * s * s + c * c), 1e-12);
  const auto area = [&](int j) {
    const double sine = surface.grid().sin_colatitude()[j], cosine = surface.grid().cos_colatitude()[j];
    return std::sqrt(4 * sine * sine + cosine * cosine);
  };
  EXPECT_NEAR(mesh_quality(surface).area_ratio, area(latitudes / 2) / area(0), 1e-12);
}

/// A shear of the longitudes of the unit sphere by a cos(theta) is, at the equator, a simple shear by a: its principal
/// stretches have the ratio k^2 with k - 1/k = a.
TEST(MeshQuality, OfAShearedSphere) {
  Surface surface(33);  // a latitude on the equator
  surface.update(at_nodes(surface.grid(), sheared, [](const Vector3& d) { return d; }));
  const double k = (3 + std::sqrt(13.0)) / 2;
  EXPECT_NEAR(mesh_quality(surface).aspect_ratio, k * k, 1e-9);
  EXPECT_NEAR(mesh_quality(surface).area_ratio, 1, 1e-9);
}

class MeshRedistributionOf : public ::testing::TestWithParam<Map> {};
INSTANTIATE_TEST_SUITE_P(SpoiltMeshes, MeshRedistributionOf, ::testing::Values(sheared, clustered, wound));

/// The shape stays, and the mesh becomes the one of the linear image of the sphere, of which a_1 = 0 knows nothing.
TEST_P(MeshRedistributionOf, AnEllipsoidKeepsItsShapeAndGainsItsBestMesh) {
  Surface before(latitudes), after(latitudes), best(latitudes);
  before.update(ellipsoid_under(before.grid(), GetParam()));
  best.update(ellipsoid_under(before.grid(), unchanged));
  MeshRedistribution redistribution(latitudes);
  const RedistributionReport report = redistribution.redistribute(before);
  ASSERT_TRUE(report.moved);
  after.update(redistribution.positions());

  const MeshQuality ideal = mesh_quality(best);
  EXPECT_GT(std::max(report.before.aspect_ratio / ideal.aspect_ratio, report.before.area_ratio / ideal.area_ratio),
            1.3);
  EXPECT_NEAR(report.after.aspect_ratio, ideal.aspect_ratio, 0.01 * ideal.aspect_ratio);
  EXPECT_NEAR(report.after.area_ratio, ideal.area_ratio, 0.02 * ideal.area_ratio);
  EXPECT_LT(report.energy_after, 1e-6 * report.energy_before);

  // The old expansion is off the ellipsoid by its truncation, which clustered feels; the new markers are on it.
  const double truncation = GetParam() == clustered ? 1e-8 : 1e-12;
  EXPECT_LT(off_ellipsoid(redistribution.positions()), truncation);
  EXPECT_NEAR(after.area() / best.area(), 1, 1e-8);
  EXPECT_NEAR(after.volume() / best.volume(), 1, 1e-8);
  EXPECT_NEAR(bending_energy(after) / bending_energy(best), 1, 1e-6);
  const Eigen::Matrix3d moments = volume_moments(best).second_moments;
  EXPECT_LT((volume_moments(after).second_moments - moments).norm(), 1e-8 * moments.norm());
}

/// field o y at the new markers is the field at their place on the surface.
TEST_P(MeshRedistributionOf, FieldsStayWithTheMaterial) {
  Surface before(latitudes);
  before.update(ellipsoid_under(before.grid(), GetParam()));
  const auto at = [](const VectorField& x) { return ScalarField(x.col(0) * x.col(1) + x.col(2)); };
  MeshRedistribution redistribution(latitudes);
  ASSERT_TRUE(redistribution.redistribute(before).moved);
  ScalarField field = at(before.positions());
  redistribution.carry(field);
  EXPECT_LT((field - at(redistribution.positions())).abs().maxCoeff(),
            1e-7);  // truncation of the field on the old mesh
}

TEST(MeshRedistribution, LeavesAGoodMeshAlone) {
  Surface surface(latitudes);
  MeshRedistribution redistribution(latitudes);
  for (const VectorField& positions :
       {sphere(surface.grid()), prolate(surface.grid(), 0.7), ellipsoid_under(surface.grid(), unchanged)}) {
    surface.update(positions);
    const RedistributionReport report = redistribution.redistribute(surface);
    // The energy of these meshes is round-off; what can be gained of that is round-off too.
    EXPECT_LT(report.energy_before, 1e-20);
    EXPECT_LT((redistribution.positions() - positions).abs().maxCoeff(), 1e-9);
    EXPECT_NEAR(report.after.aspect_ratio, report.before.aspect_ratio, 1e-6);
  }
}

/// A second redistribution finds nothing left to gain on a shape that is no ellipsoid.
TEST(MeshRedistribution, ASecondOneHardlyMoves) {
  Surface surface(latitudes);
  surface.update(testing::y32_surface(surface.grid()));
  MeshRedistribution redistribution(latitudes);
  const RedistributionReport first = redistribution.redistribute(surface);
  EXPECT_LE(first.energy_after, first.energy_before);
  surface.update(VectorField(redistribution.positions()));
  EXPECT_FALSE(redistribution.redistribute(surface).moved);
  EXPECT_TRUE((redistribution.positions() == surface.positions()).all());
}

/// Fewer degrees: the new positions have them and no more, and the report says how far off the surface that is.
TEST(MeshRedistribution, KeepsTheDegreesAskedFor) {
  Surface before(latitudes), after(latitudes);
  before.update(ellipsoid_under(before.grid(), wound));
  MeshRedistribution all(latitudes), few(latitudes, 22);
  ASSERT_TRUE(all.redistribute(before).moved);
  const RedistributionReport report = few.redistribute(before);
  ASSERT_TRUE(report.moved);
  after.update(few.positions());
  const Coefficients& c = after.position_coefficients();
  EXPECT_LT(c.energy(22, latitudes), 1e-28 * c.energy(0, 22));
  const double distance = std::sqrt((few.positions() - all.positions()).square().rowwise().sum().maxCoeff());
  EXPECT_DOUBLE_EQ(report.truncation, distance);
  EXPECT_LT(off_ellipsoid(few.positions()), 4 * distance);  // 2 distance / (shortest semi-axis 0.7)
}

TEST(MeshRedistribution, TheMapIsOneToOne) {
  Surface surface(latitudes), map(latitudes);
  surface.update(ellipsoid_under(surface.grid(), wound));
  MeshRedistribution redistribution(latitudes);
  ASSERT_TRUE(redistribution.redistribute(surface).moved);
  map.update(redistribution.map());
  EXPECT_NEAR(map.area(), 4 * M_PI, 1e-6);  // covers the sphere once
  EXPECT_GT((map.normal() * redistribution.map()).rowwise().sum().minCoeff(), 0.999);
}

TEST(MeshRedistribution, RefusesAnotherMesh) {
  Surface surface(latitudes);
  surface.update(sphere(surface.grid()));
  MeshRedistribution redistribution(latitudes + 1);
  EXPECT_THROW(redistribution.redistribute(surface), std::invalid_argument);
  EXPECT_THROW(MeshRedistribution(latitudes, latitudes + 1), std::invalid_argument);
  ScalarField field(3);
  EXPECT_THROW(redistribution.carry(field), std::invalid_argument);
  testing::expect_refused_if_not_finite(ScalarField(redistribution.map().col(0)),
                                        [&](ScalarField& f) { redistribution.carry(f); });
}

TEST(RedistributionLimits, EitherCounts) {
  const RedistributionLimits limits{.aspect_ratio = 3, .spectrum_tail = 1e-6};
  EXPECT_FALSE(limits.passed_by({.aspect_ratio = 2.9, .spectrum_tail = 9e-7}));
  EXPECT_TRUE(limits.passed_by({.aspect_ratio = 3.1, .spectrum_tail = 0}));
  EXPECT_TRUE(limits.passed_by({.aspect_ratio = 1, .spectrum_tail = 2e-6}));
}

/// Strain and strain since the start stay with the material, totals stay, and the tension's energy with them.
TEST(Membrane, RedistributionKeepsStrainsTotalsAndEnergy) {
  Membrane membrane(ellipsoid_under(SphereGrid(latitudes), wound), latitudes, {.sigma0 = 10});
  const auto strain = [](const VectorField& x) { return ScalarField(0.02 * (x.col(0) + 0.5 * x.col(1) * x.col(2))); };
  MembraneState state = membrane.state();
  state.target_areas = membrane.surface().area_weight() * (-strain(state.positions)).exp();
  state.target_areas *= state.initial_areas.sum() / state.target_areas.sum();
  const double mean =
      std::log(state.initial_areas.sum() / (membrane.surface().area_weight() * (-strain(state.positions)).exp()).sum());
  membrane.restore(state);
  membrane.compute_force();
  const double energy = membrane.energy();
  MeshRedistribution redistribution(latitudes);
  ASSERT_TRUE(membrane.redistribute(redistribution).moved);
  const ScalarField& areas = membrane.surface().area_weight();
  EXPECT_LT(((areas / membrane.target_areas()).log() - strain(membrane.positions()) + mean).abs().maxCoeff(), 1e-7);
  EXPECT_LT((areas / membrane.initial_areas() - 1).abs().maxCoeff(), 1e-7);
  EXPECT_NEAR(membrane.target_areas().sum(), membrane.initial_area(), 1e-12);
  EXPECT_NEAR(membrane.initial_areas().sum(), membrane.initial_area(), 1e-12);
  EXPECT_NEAR(membrane.energy(), energy, 1e-6 * energy);
}

/// There is nothing to gain from energies that are rounding.
TEST(MeshRedistribution, DoesNotChaseRounding) {
  for (const int size : {4, 7, 16, 24, 33}) {
    Surface surface(size);
    MeshRedistribution redistribution(size);
    for (const VectorField& x : {sphere(surface.grid()), prolate(surface.grid(), 0.3), oblate(surface.grid(), 0.3)}) {
      surface.update(x);
      const RedistributionReport report = redistribution.redistribute(surface);
      EXPECT_FALSE(report.moved) << size;
      EXPECT_EQ(report.iterations, 0) << size;
    }
  }
}

/// Moving the markers of a surface of noise makes another surface of them.
TEST(MeshRedistribution, LeavesAnUnresolvedSurfaceAlone) {
  for (const double noise : {0.3, 3.0}) {
    Surface surface(16);
    surface.update(sphere(surface.grid()) + noise * testing::smooth_vector(surface.grid(), 16, 4));
    MeshRedistribution redistribution(16);
    const RedistributionReport report = redistribution.redistribute(surface);
    EXPECT_FALSE(report.moved) << noise;
    EXPECT_TRUE((redistribution.positions() == surface.positions()).all());
    EXPECT_EQ(report.energy_after, report.energy_before);
  }
}

}  // namespace
}  // namespace vesiflow::vesicle::redistribution_test
