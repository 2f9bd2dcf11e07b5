// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/mesh_control.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support.h"

namespace vesiflow::vesicle::mesh_control_test {
namespace {

using testing::cross;
using testing::smooth_scalar;
using testing::smooth_vector;

constexpr int latitudes = 32;

MeshFilter default_filter(const SphereGrid& grid, FilterOrder order) {
  return MeshFilter(grid, order, two_thirds_degrees(grid.latitudes()), 15);
}

TEST(MeshFilter, TwoThirdsRule) {
  EXPECT_EQ(two_thirds_degrees(32), 22);
  EXPECT_EQ(two_thirds_degrees(33), 22);
  EXPECT_EQ(two_thirds_degrees(64), 43);
}

TEST(MeshFilter, RigidMotionsOfASpherePassBothOrders) {
  Surface surface(latitudes);
  surface.update(sphere(surface.grid()));
  VectorField rigid = cross({0.3, -0.2, 0.5}, surface.positions());
  rigid.rowwise() += Eigen::Array3d(0.1, 0.7, -0.4).transpose();
  for (const FilterOrder order : {FilterOrder::velocity_first, FilterOrder::components}) {
    VectorField filtered;
    default_filter(surface.grid(), order).apply(surface, rigid, filtered);
    EXPECT_LT((filtered - rigid).abs().maxCoeff(), 1e-13);
  }
}

TEST(MeshFilter, VelocityFirstPassesLowDegreesOnAnyShape) {
  Surface surface(latitudes);
  surface.update(prolate(surface.grid(), 0.8));
  const VectorField velocity = smooth_vector(surface.grid(), 15, 61);
  VectorField filtered;
  default_filter(surface.grid(), FilterOrder::velocity_first).apply(surface, velocity, filtered);
  EXPECT_LT((filtered - velocity).abs().maxCoeff(), 1e-13);
}

/// On a sphere (n of degree 1) a normal velocity below and a tangential velocity above the cuts.
TEST(MeshFilter, KeepsNormalAndCutsTangentialVelocity) {
  Surface surface(latitudes);
  surface.update(sphere(surface.grid()));
  const SphereGrid& grid = surface.grid();
  Coefficients mode(21, 1);
  mode.set_zero();
  mode(0, 18, 5) = 1;
  ScalarField y(grid.size());
  SphericalHarmonics(21, grid).synthesis(mode, y);
  VectorField gradient;
  surface.gradient(y, gradient);  // components of degrees 17 and 19
  const VectorField normal = surface.normal().colwise() * y;
  VectorField filtered;
  for (const FilterOrder order : {FilterOrder::velocity_first, FilterOrder::components}) {
    default_filter(grid, order).apply(surface, normal, filtered);
    EXPECT_LT((filtered - normal).abs().maxCoeff(), 1e-11);
    default_filter(grid, order).apply(surface, gradient, filtered);
    EXPECT_LT(filtered.abs().maxCoeff(), 1e-11 * gradient.abs().maxCoeff());
  }
}

/// F is a sharp projection on a sphere once the tangential and normal cuts agree.
TEST(MeshFilter, EqualCutsAreIdempotent) {
  Surface surface(latitudes);
  surface.update(prolate(surface.grid(), 0.9));
  MeshFilter filter(surface.grid(), FilterOrder::velocity_first, 12, 12);
  VectorField once, twice;
  filter.apply(surface, smooth_vector(surface.grid(), 30, 62), once);
  filter.apply(surface, once, twice);
  EXPECT_LT((once - twice).abs().maxCoeff(), 1e-13);
}

TEST(MeshFilter, RefusesBadArguments) {
  const SphereGrid grid(8);
  EXPECT_THROW(MeshFilter(grid, FilterOrder::components, 0, 15), std::invalid_argument);
  EXPECT_THROW(MeshFilter(grid, FilterOrder::components, 5, 0), std::invalid_argument);
  Surface surface(8);
  surface.update(sphere(grid));
  VectorField filtered;
  EXPECT_THROW(MeshFilter(grid, FilterOrder::components, 5, 5).apply(surface, VectorField(3, 3), filtered),
               std::invalid_argument);
}

TEST(TargetAreaUpdate, ConservesTheTotalAndIgnoresNormalSlip) {
  Surface surface(latitudes);
  surface.update(prolate(surface.grid(), 0.8));
  const VectorField velocity = smooth_vector(surface.grid(), 5, 71);
  const VectorField filtered = smooth_vector(surface.grid(), 5, 72);
  const double total = surface.area();
  ScalarField areas = surface.area_weight();
  TargetAreaUpdate update(surface.grid(), SlipReference::interpolated);
  update.apply(surface, velocity, filtered, 0.01, total, areas);
  EXPECT_NEAR(areas.sum(), total, 1e-13 * total);
  EXPECT_GT((areas - surface.area_weight()).abs().maxCoeff(), 0);

  ScalarField unchanged = surface.area_weight();
  const VectorField pressed = velocity + surface.normal().colwise() * smooth_scalar(surface.grid(), 5, 73);
  update.apply(surface, velocity, pressed, 0.01, total, unchanged);
  EXPECT_LT((unchanged / surface.area_weight() - 1).abs().maxCoeff(), 1e-13);
}

/// What dealiasing removes from U is no slip: the dealiased reference does not see it, the interpolated one does.
TEST(TargetAreaUpdate, DealiasedSlipIgnoresHighDegrees) {
  Surface surface(latitudes);
  surface.update(prolate(surface.grid(), 0.8));
  const VectorField motion = smooth_vector(surface.grid(), 5, 75);
  VectorField noise = smooth_vector(surface.grid(), latitudes, 76), kept(noise.rows(), 3);
  const SphericalHarmonics low(two_thirds_degrees(latitudes), surface.grid());
  Coefficients coefficients(latitudes, 3);
  low.analysis(noise, coefficients);
  low.synthesis(coefficients, kept);
  noise -= kept;
  const auto change = [&](SlipReference reference) {
    ScalarField areas = surface.area_weight();
    TargetAreaUpdate(surface.grid(), reference).apply(surface, motion + noise, motion, 0.01, surface.area(), areas);
    return (areas / surface.area_weight() - 1).abs().maxCoeff();
  };
  EXPECT_LT(change(SlipReference::dealiased), 1e-12);
  EXPECT_GT(change(SlipReference::interpolated), 1e-6);
}

TEST(MeshFilter, RefusesAVelocityThatIsNotFinite) {
  Surface surface(8);
  surface.update(ellipsoid(surface.grid(), {1, 1.2, 1.5}));
  for (const FilterOrder order : {FilterOrder::velocity_first, FilterOrder::components}) {
    MeshFilter filter(surface.grid(), order, 6, 1);
    VectorField filtered;
    filter.apply(surface, smooth_vector(surface.grid(), 4, 1), filtered);
    const VectorField before = filtered;
    testing::expect_refused_if_not_finite(surface.normal(),
                                          [&](const VectorField& u) { filter.apply(surface, u, filtered); });
    EXPECT_TRUE((filtered == before).all());
  }
}

/// Markers sliding on a membrane at rest keep their strain: dA0 follows dA with an O(dt^2) error per step.
TEST(TargetAreaUpdate, FollowsTheSlidingMesh) {
  const auto strain = [](double dt) {
    Surface surface(latitudes);
    surface.update(sphere(surface.grid()));
    VectorField slip;
    surface.gradient(smooth_scalar(surface.grid(), 4, 74), slip);
    ScalarField areas = surface.area_weight();
    const double total = surface.area();
    TargetAreaUpdate(surface.grid(), SlipReference::dealiased)
        .apply(surface, VectorField::Zero(slip.rows(), 3), slip, dt, total, areas);
    VectorField moved = surface.positions() + dt * slip;
    const ScalarField radius = moved.square().rowwise().sum().sqrt();
    surface.update(moved.colwise() / radius);
    return (surface.area_weight() / areas - 1).abs().maxCoeff();
  };
  EXPECT_NEAR(std::log2(strain(2e-3) / strain(1e-3)), 2, 0.1);
}

TEST(TargetAreaUpdate, RefusesWhatWouldNotBeFinite) {
  Surface surface(8);
  surface.update(ellipsoid(surface.grid(), {1, 1.2, 1.5}));
  TargetAreaUpdate update(surface.grid(), SlipReference::dealiased);
  const VectorField u = testing::smooth_vector(surface.grid(), 4, 1), zero = VectorField::Zero(u.rows(), 3);
  VectorField broken = u;
  broken(9, 2) = std::numeric_limits<double>::quiet_NaN();
  ScalarField areas = surface.area_weight();
  EXPECT_THROW(update.apply(surface, broken, u, 0.1, surface.area(), areas), std::domain_error);
  EXPECT_THROW(update.apply(surface, u, zero, 1e6, surface.area(), areas), std::domain_error);
  EXPECT_TRUE((areas == surface.area_weight()).all());
  for (const double wrong : {0.0, -1.0, std::nan("")}) {  // an area of zero stays zero, beside others that are finite
    areas = surface.area_weight();
    areas[3] = wrong;
    EXPECT_THROW(update.apply(surface, u, u, 0.1, surface.area(), areas), std::domain_error);
  }
  areas = surface.area_weight();
  for (const double wrong : {0.0, -1.0, std::nan(""), double{INFINITY}})
    EXPECT_THROW(update.apply(surface, u, u, 0.1, wrong, areas), std::domain_error);
  EXPECT_TRUE((areas == surface.area_weight()).all());
}

}  // namespace
}  // namespace vesiflow::vesicle::mesh_control_test
