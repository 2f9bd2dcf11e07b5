// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What the delta functions do to a velocity whose discrete divergence is zero: its divergence between the points, its flux
// through a closed surface, and the volume of a surface that moves with it. The numbers of docs/coupling.md are the
// properties that `coupling_tests --gtest_filter='DivergencePreserving.*' --gtest_output=xml` records.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "coupling/marker_transfer.h"
#include "vesicle/shapes.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling::divergence_preserving_test {
namespace {

using vesicle::ScalarField;
using vesicle::VectorField;

constexpr double pi = std::numbers::pi;
constexpr int cells = 24;
const fluid::Grid grid({0, 0, 0}, {1.0, 1.0, 1.0}, {cells, cells, cells}, {true, true, true});
constexpr double h = 1.0 / cells;

// A vector potential on the edges: component c lies at half points along c and at points across.
class EdgePotential {
 public:
  explicit EdgePotential(const std::function<double(int component, const fluid::Vector3&)>& value) {
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < cells; ++k)
        for (int j = 0; j < cells; ++j)
          for (int i = 0; i < cells; ++i)
            at(c, i, j, k) = value(c, {h * (i + (c == 0) / 2.0), h * (j + (c == 1) / 2.0), h * (k + (c == 2) / 2.0)});
  }
  double& at(int c, int i, int j, int k) {
    const auto wrap = [](int n) { return (n + cells) % cells; };
    return values_[static_cast<std::size_t>(((c * cells + wrap(k)) * cells + wrap(j)) * cells + wrap(i))];
  }

 private:
  std::vector<double> values_ = std::vector<double>(3 * cells * cells * cells);
};

// Its discrete curl: the discrete divergence is zero but for round-off.
fluid::FaceVector curl(EdgePotential a) {
  fluid::FaceVector u(grid);
  for (int k = 0; k < cells; ++k)
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        u.x(i, j, k) = (a.at(2, i, j + 1, k) - a.at(2, i, j, k) - a.at(1, i, j, k + 1) + a.at(1, i, j, k)) / h;
        u.y(i, j, k) = (a.at(0, i, j, k + 1) - a.at(0, i, j, k) - a.at(2, i + 1, j, k) + a.at(2, i, j, k)) / h;
        u.z(i, j, k) = (a.at(1, i + 1, j, k) - a.at(1, i, j, k) - a.at(0, i, j + 1, k) + a.at(0, i, j, k)) / h;
      }
  return u;
}

// Cellular flow of speed 1 and, of a tenth of that, a part that changes from point to point.
fluid::FaceVector frozen_flow(double grid_scale_speed = 0.2) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const auto potential = [&](int c, const fluid::Vector3& x) {
    const std::size_t along = static_cast<std::size_t>(c), next = (along + 1) % 3;
    const double smooth = std::sin(2.0 * pi * x[next]) * std::cos(2.0 * pi * x[along]) / (2.0 * pi);
    return smooth + 0.5 * grid_scale_speed * h * normal(generator);
  };
  return curl(EdgePotential(potential));
}

// Random positions whose distance from all faces and centres is larger than that of the difference stencil below: the
// interpolated field is one polynomial along it.
VectorField points_off_knots(int count) {
  std::mt19937 generator(9);
  std::uniform_int_distribution<int> half_cell(0, 2 * cells - 1);
  std::uniform_real_distribution<double> inside(0.1, 0.9);
  VectorField x(count, 3);
  for (int i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) x(i, axis) = 0.5 * h * (half_cell(generator) + inside(generator));
  return x;
}

VectorField interpolated(MarkerTransfer& transfer, const fluid::FaceVector& u, const VectorField& x) {
  VectorField values = VectorField::Zero(x.rows(), 3);
  transfer.update(x);
  transfer.interpolate(u, values);
  return values;
}

// By differences over five points, which are exact for polynomials of degree four.
ScalarField continuous_divergence(MarkerTransfer& transfer, const fluid::FaceVector& u, const VectorField& x) {
  const double e = 0.02 * h;
  ScalarField divergence = ScalarField::Zero(x.rows());
  for (int axis = 0; axis < 3; ++axis)
    for (const auto& [offset, weight] :
         {std::pair(-2.0, 1.0 / 12.0), {-1.0, -2.0 / 3.0}, {1.0, 2.0 / 3.0}, {2.0, -1.0 / 12.0}}) {
      VectorField moved = x;
      moved.col(axis) += offset * e;
      divergence += weight / e * interpolated(transfer, u, moved).col(axis);
    }
  return divergence;
}

bool preserves(DeltaKernel kernel) {
  return interpolation(kernel) == Interpolation::divergence_preserving;
}

void record(const char* what, DeltaKernel kernel, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2e", value);
  ::testing::Test::RecordProperty(std::string(what) + "_" + std::string(name(kernel)), text);
}

// d/dx of the B-spline of order k+1 is the difference of two of order k, so for any velocity at all the divergence of the
// interpolated field is the discrete one, interpolated with the tangential function in every direction.
TEST(DivergencePreserving, InterpolatedDivergenceIsTheDiscreteOneSmoothed) {
  std::mt19937 generator(21);
  std::normal_distribution<double> normal;
  fluid::FaceVector u(grid);
  for (const fluid::View& component : u.points())
    for (int k = 0; k < cells; ++k)
      for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) component(i, j, k) = normal(generator);
  const auto next = [](int i) { return (i + 1) % cells; };
  const VectorField x = points_off_knots(50);
  for (const DeltaKernel kernel : delta_kernels) {
    if (!preserves(kernel)) continue;
    MarkerTransfer transfer(grid, kernel);
    const ScalarField found = continuous_divergence(transfer, u, x);
    const auto phi = [&](double coordinate, int cell) {
      const double r = coordinate / h - cell - 0.5;
      return delta(kernel, r - cells * std::round(r / cells), Direction::tangential);
    };
    for (Eigen::Index m = 0; m < x.rows(); ++m) {
      double expected = 0.0;
      for (int k = 0; k < cells; ++k) {
        const double z = phi(x(m, 2), k);
        for (int j = 0; z != 0.0 && j < cells; ++j) {
          const double yz = z * phi(x(m, 1), j);
          for (int i = 0; yz != 0.0 && i < cells; ++i)
            expected += yz * phi(x(m, 0), i) *
                        (u.x(next(i), j, k) - u.x(i, j, k) + u.y(i, next(j), k) - u.y(i, j, k) + u.z(i, j, next(k)) -
                         u.z(i, j, k)) /
                        h;
        }
      }
      EXPECT_NEAR(found(m), expected, 1e-10) << name(kernel);  // of size 20; the differences divide round-off by 8e-4
    }
  }
}

TEST(DivergencePreserving, InterpolatedVelocityHasNoDivergenceWhereTheDiscreteOneHasNone) {
  const fluid::FaceVector u = frozen_flow();
  const VectorField x = points_off_knots(2000);
  for (const DeltaKernel kernel : delta_kernels) {
    MarkerTransfer transfer(grid, kernel);
    const double rms = std::sqrt(continuous_divergence(transfer, u, x).square().mean());
    record("divergence", kernel, rms);
    if (preserves(kernel)) {
      EXPECT_LT(rms, 1e-11) << name(kernel);
    } else {
      EXPECT_GT(rms, 1e-3) << name(kernel);
    }
  }
}

constexpr double radius = 0.2;  // 4.8 h
const fluid::Vector3 centres[] = {{0.51, 0.53, 0.48}, {0.27, 0.66, 0.91}, {0.84, 0.15, 0.39}};

VectorField sphere_of(int latitudes, const fluid::Vector3& centre) {
  VectorField x = radius * vesicle::sphere(vesicle::SphereGrid(latitudes));
  for (Eigen::Index axis = 0; axis < 3; ++axis) x.col(axis) += centre[static_cast<std::size_t>(axis)];
  return x;
}

// Root of the mean square over the spheres: signs and chance cancellations do not count.
template <class Value>
double mean_over_spheres(const Value& value) {
  double sum = 0.0;
  for (const fluid::Vector3& centre : centres) sum += std::pow(value(centre), 2);
  return std::sqrt(sum / std::size(centres));
}

// Net flux through a sphere over its area, by the quadrature of a surface; the speed of the flow is about 1.
double flux(DeltaKernel kernel, const fluid::FaceVector& u, const vesicle::Surface& surface) {
  return mean_over_spheres([&](const fluid::Vector3& centre) {
    MarkerTransfer transfer(grid, kernel);
    const VectorField velocity = interpolated(transfer, u, sphere_of(surface.grid().latitudes(), centre));
    return ((surface.normal() * velocity).rowwise().sum() * surface.area_weight()).sum() / surface.area();
  });
}

TEST(DivergencePreserving, FluxThroughAClosedSurfaceFallsToTheErrorOfTheQuadrature) {
  const fluid::FaceVector u = frozen_flow();
  std::map<DeltaKernel, double> coarse, fine;
  vesicle::Surface of_32(32), of_128(128);
  of_32.update(sphere_of(32, {0, 0, 0}));
  of_128.update(sphere_of(128, {0, 0, 0}));
  for (const DeltaKernel kernel : delta_kernels) {
    coarse[kernel] = flux(kernel, u, of_32);
    fine[kernel] = flux(kernel, u, of_128);
    record("flux_32_latitudes", kernel, coarse[kernel]);
    record("flux_128_latitudes", kernel, fine[kernel]);
  }
  // The flux of a plain kernel is its own and stays; that of a composite is the quadrature's, which falls as fast as the
  // smoothness of the interpolated velocity lets it.
  for (const DeltaKernel kernel : delta_kernels)
    EXPECT_TRUE(preserves(kernel) || fine[kernel] > 0.5 * coarse[kernel]) << name(kernel);
  EXPECT_LT(fine[DeltaKernel::composite_bspline_32], 0.1 * coarse[DeltaKernel::composite_bspline_32]);
  EXPECT_LT(fine[DeltaKernel::composite_bspline_43], 0.03 * coarse[DeltaKernel::composite_bspline_43]);
  EXPECT_LT(fine[DeltaKernel::composite_bspline_54], 0.03 * coarse[DeltaKernel::composite_bspline_54]);
  EXPECT_LT(fine[DeltaKernel::composite_bspline_43], 0.01 * fine[DeltaKernel::smoothed_four_point]);
  EXPECT_LT(fine[DeltaKernel::composite_bspline_54], 1e-3 * fine[DeltaKernel::smoothed_four_point]);
}

// Relative change of volume of spheres of markers that move with the flow for 2.4 h: 200 steps of second order, the
// two-step rule after one midpoint step.
double volume_drift(DeltaKernel kernel, const fluid::FaceVector& u, int latitudes) {
  return mean_over_spheres([&](const fluid::Vector3& centre) {
    MarkerTransfer transfer(grid, kernel);
    VectorField x = sphere_of(latitudes, centre);
    vesicle::Surface surface(latitudes);
    surface.update(x);
    const double before = surface.volume(), dt = 0.1 / 200;
    VectorField last = interpolated(transfer, u, x), present = last;
    x += dt * interpolated(transfer, u, x + 0.5 * dt * last);
    for (int step = 1; step < 200; ++step) {
      transfer.update(x);
      transfer.interpolate(u, present);
      x += dt * (1.5 * present - 0.5 * last);
      last.swap(present);
    }
    surface.update(x);
    return surface.volume() / before - 1.0;
  });
}

TEST(DivergencePreserving, MarkersThatMoveWithTheFluidKeepTheirVolume) {
  const fluid::FaceVector u = frozen_flow();
  std::map<DeltaKernel, double> drift;
  for (const DeltaKernel kernel : delta_kernels) {
    drift[kernel] = volume_drift(kernel, u, 32);
    record("volume_drift", kernel, drift[kernel]);
  }
  double best_plain = 1.0;
  for (const DeltaKernel kernel : delta_kernels)
    if (!preserves(kernel)) best_plain = std::min(best_plain, drift[kernel]);
  EXPECT_GT(best_plain, 2e-5);
  // The quadratic and linear pair makes the membrane too rough for its 32 latitudes.
  EXPECT_LT(drift[DeltaKernel::composite_bspline_43], 0.2 * best_plain);
  EXPECT_LT(drift[DeltaKernel::composite_bspline_54], 0.05 * best_plain);
}

}  // namespace
}  // namespace vesiflow::coupling::divergence_preserving_test
