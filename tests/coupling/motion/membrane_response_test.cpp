// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/membrane_response.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "coupling/marker_transfer.h"
#include "fluid/navier_stokes.h"
#include "transfer/sharp_body.h"
#include "vesicle/shapes.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling::membrane_response_test {
namespace {

constexpr int degrees = 24;
constexpr double radius = 1.3;
const MembraneResponse::SecondMoments smoothed = MembraneResponse::second_moments(DeltaKernel::smoothed_four_point);

MembraneResponse response(double spacing, double a, double mu) {
  MembraneResponse modes(degrees, radius, spacing, smoothed);
  modes.update(a, mu);
  return modes;
}

/// By the degree that (n + 1/2)/R belongs to.
TEST(MembraneResponse, OfAStokesFluidIsTheClosedForm) {
  const double mu = 3.0;
  const MembraneResponse modes = response(0.0, 0.0, mu);
  for (int n = 0; n < degrees; ++n) {
    const double k = (n + 0.5) / radius;
    EXPECT_DOUBLE_EQ(modes.wavenumber(n), k);
    // The integrands are cos^2 and sin^2 of the angle, for which the midpoint rule is exact.
    EXPECT_NEAR(modes[n].normal.velocity * 4 * mu * k, 1, 1e-13);
    EXPECT_NEAR(modes[n].along.velocity * 4 * mu * k, 1, 1e-13);
    // The answer is proportional to 1/mu.
    EXPECT_NEAR(modes[n].normal.viscosity, 1 / mu, 1e-13);
    EXPECT_NEAR(modes[n].along.viscosity, 1 / mu, 1e-13);
  }
}

/// The integrals over k_z, by residues at i k and i m: m = sqrt(k^2 + a/mu). The error of the midpoint rule in the angle decays like
/// exp(-2 N k/m) for N = 200 points, its integrands having poles at a distance k/m from the real axis: for all these, 400 k/m > 20.
TEST(MembraneResponse, OfAFluidWithInertiaIsTheClosedForm) {
  for (const double mu : {1.0, 5.0})
    for (const double a : {0.01, 1.0, 30.0}) {
      const MembraneResponse modes = response(0.0, a, mu);
      for (int n = 0; n < degrees; ++n) {
        const double k = modes.wavenumber(n), m = std::sqrt(k * k + a / mu);
        const double along = 1 / (2 * mu * (m + k)), normal = k / (2 * mu * m * (m + k));
        EXPECT_NEAR(modes[n].along.velocity / along, 1, 1e-9) << n << ' ' << a << ' ' << mu;
        EXPECT_NEAR(modes[n].normal.velocity / normal, 1, 1e-9) << n << ' ' << a << ' ' << mu;
      }
    }
}

/// The pressure takes up the part of a force that the momentum alone would answer to with 1/(2 mu m).
TEST(MembraneResponse, PartsAddUpToTheAnswerWithoutPressure) {
  const double a = 7.0, mu = 2.0;
  const MembraneResponse modes = response(0.0, a, mu);
  for (int n = 0; n < degrees; ++n) {
    const double k = modes.wavenumber(n), m = std::sqrt(k * k + a / mu);
    EXPECT_NEAR((modes[n].along.velocity + modes[n].normal.velocity) * 2 * mu * m, 1, 1e-9);
  }
}

/// Of a thin sheet exactly; of a thick one times exp(b (k h)^2), with one b > 0 for both parts, all a, degrees and
/// widths: what the model overestimates within the sheet, no more than the exp(0.25 (k h)^2) that a sphere in a fluid
/// shows (below).
TEST(MembraneResponse, MemoryIsTheDerivativeOfTheAnswer) {
  const double mu = 1.7, step = 1e-4;
  double b = 0.0;
  for (const double spacing : {0.0, 0.1, 0.25})
    for (const double a : {0.5, 20.0}) {
      const MembraneResponse modes = response(spacing, a, mu);
      const MembraneResponse more_a = response(spacing, a + step, mu), less_a = response(spacing, a - step, mu);
      const MembraneResponse more_mu = response(spacing, a, mu + step), less_mu = response(spacing, a, mu - step);
      const auto slope = [&](double more, double less) { return -(std::log(more) - std::log(less)) / (2 * step); };
      for (int n = degrees - 1; n >= 0; --n)  // b is told best by the shortest wave
        for (const auto part : {&MembraneResponse::Mode::along, &MembraneResponse::Mode::normal}) {
          const auto& answer = modes[n].*part;
          // The answer is homogeneous of degree -1 in a and mu together: without more, 1.
          const double owed = a * answer.inertia + mu * answer.viscosity;
          // Truncation step^2, and round-off over the step.
          EXPECT_NEAR(answer.inertia, owed * slope((more_a[n].*part).velocity, (less_a[n].*part).velocity),
                      1e-7 * answer.inertia + 1e-11);
          EXPECT_NEAR(answer.viscosity, owed * slope((more_mu[n].*part).velocity, (less_mu[n].*part).velocity),
                      1e-7 * answer.viscosity + 1e-11);
          const double in_plane = std::pow(modes.wavenumber(n) * spacing, 2);
          if (b == 0.0 && spacing > 0.0) b = std::log(owed) / in_plane;
          EXPECT_NEAR(std::log(owed), b * in_plane, 1e-12);
        }
    }
  EXPECT_GT(b, 0.0);
  EXPECT_LT(b, 0.25);
}

/// A force grad Y or Y n on a sphere of radius 1, spread into a fluid at rest for one step of Re/dt = a, and the
/// velocity that comes back: below the model's by about exp(-0.25 (k h)^2), which is read off the numbers of this test.
/// It is 0.84 to 1.06 of it at low degrees, a sphere being no plane, and the layer of a larger viscosity (Re = 1) blurs
/// the tangential answer less (0.16 more is seen): hence 0.2.
TEST(MembraneResponse, IsThatOfTheFluidToASphereRegression) {
  constexpr int latitudes = 32, cells = 32;
  constexpr double half = 3.0, spacing = 2 * half / cells, dt = 1.0 / 24;
  const fluid::Grid grid({-half, -half, -half}, {half, half, half}, {cells, cells, cells});
  const vesicle::SphereGrid mesh(latitudes);
  vesicle::Surface surface(mesh);
  const vesicle::VectorField positions = vesicle::sphere(mesh);
  surface.update(positions);
  vesicle::SphericalHarmonics harmonics(latitudes / 2, mesh, 1);
  MarkerTransfer transfer(grid);
  transfer.update(positions);
  MembraneResponse model(latitudes / 2, 1.0, spacing, smoothed);
  for (const double reynolds_number : {1.0, 20.0}) {
    model.update(reynolds_number / dt, 1.0);
    for (const int n : {2, 5, 9})
      for (const bool normal : {true, false}) {
        vesicle::Coefficients one(latitudes / 2, 1);
        one.set_zero();
        one(0, n, 1) = 1e-6;  // no convection
        Eigen::ArrayXXd values(positions.rows(), 1);
        harmonics.synthesis(one, values);
        const vesicle::ScalarField y = values.col(0);
        vesicle::VectorField force(positions.rows(), 3), velocity(positions.rows(), 3);
        if (normal)
          force = surface.normal().colwise() * y;
        else
          surface.gradient(y, force);
        fluid::FluidParameters parameters;
        parameters.reynolds_number = reynolds_number;
        fluid::NavierStokes fluid(grid, parameters, [](const fluid::Vector3&, double) { return fluid::Vector3{}; });
        transfer.spread(force, surface.area_weight(), fluid.force());
        fluid.step(dt);
        transfer.interpolate(fluid.velocity(), velocity);
        const auto product = [&](const vesicle::VectorField& a) {
          return ((a * force).rowwise().sum() * surface.area_weight()).sum();
        };
        const auto& answer = normal ? model[n].normal : model[n].along;
        const double kh = model.wavenumber(n) * spacing;
        EXPECT_NEAR(product(velocity) / product(force) / answer.velocity, std::exp(-0.25 * kh * kh), 0.2)
            << "degree " << n << (normal ? " normal" : " along") << ", Re " << reynolds_number;
      }
  }
}

/// A sharp membrane on a sphere, for one step from rest in which Re h^2 a0/dt is `cell`: what is read of a force grad Y or
/// Y n over the force.
double answer_of_sharp_sphere(const test::SphereInBox& sphere, int n, bool normal, double cell) {
  const fluid::Grid grid = sphere.grid();
  test::SharpBody body = sphere.body();
  const Eigen::Index markers = body.surface.positions().rows();
  vesicle::SphericalHarmonics harmonics(12, body.surface.grid(), 1);
  vesicle::Coefficients one(12, 1);
  one.set_zero();
  one(0, n, 1) = 1e-6;  // no convection
  Eigen::ArrayXXd values(markers, 1);
  harmonics.synthesis(one, values);
  const vesicle::ScalarField y = values.col(0);
  vesicle::VectorField force(markers, 3);
  if (normal)
    force = body.surface.normal().colwise() * y;
  else
    body.surface.gradient(y, force);
  fluid::FluidParameters parameters;
  parameters.reynolds_number = 1.0;
  fluid::NavierStokes fluid(grid, parameters, [](const fluid::Vector3&, double) { return fluid::Vector3{}; });
  body.put(force, fluid);
  fluid.step(std::pow(grid.min_spacing(), 2) / cell);
  const vesicle::VectorField velocity = body.read(fluid.velocity());
  const auto product = [&](const vesicle::VectorField& a) {
    return ((a * force).rowwise().sum() * body.surface.area_weight()).sum();
  };
  return product(velocity) / product(force);
}

/// For steps of any length, of which the shortest have layers of a twentieth of a cell: there the closed form is far too
/// low. A normal force of degree 4 answers less than a plane's, and degree 7, which the grid hardly resolves, less still.
TEST(MembraneResponse, IsThatOfTheGridToASharpSphere) {
  const test::SphereInBox sphere{5.33};
  const double spacing = sphere.grid().min_spacing();
  MembraneResponse model(12, 1.0, spacing, {}, true);
  for (const double cell : {0.3, 3.0, 30.0, 100.0, 300.0}) {
    const double a = cell / (spacing * spacing);
    model.update(a, 1.0);
    for (const int n : {2, 4, 7}) {
      const double k = model.wavenumber(n), m = std::sqrt(k * k + a);
      const double along = answer_of_sharp_sphere(sphere, n, false, cell) / model[n].along.velocity;
      const double normal = answer_of_sharp_sphere(sphere, n, true, cell) / model[n].normal.velocity;
      EXPECT_GT(along, n < 7 ? 0.85 : 0.6) << cell << ' ' << n;
      EXPECT_LT(along, 1.1) << cell << ' ' << n;
      EXPECT_LT(normal, 1.1) << cell << ' ' << n;
      if (n < 7) {
        EXPECT_GT(normal, 0.55) << cell << ' ' << n;
        if (cell > 200.0) {
          EXPECT_GT(along * model[n].along.velocity, 3.0 / (2.0 * (m + k)));
          EXPECT_GT(normal * model[n].normal.velocity, 3.0 * k / (2.0 * m * (m + k)));
        }
      }
    }
  }
}

/// Without inertia, or with little, it is that of a sheet without thickness.
TEST(MembraneResponse, OfASharpMembraneTendsToThatOfAThinSheet) {
  MembraneResponse sharp(degrees, radius, 0.2, {}, true), thin(degrees, radius, 0.0, {});
  for (const double a : {0.0, 1e-3}) {
    sharp.update(a, 1.0);
    thin.update(a, 1.0);
    for (int n = 0; n < 10; ++n) {
      EXPECT_NEAR(sharp[n].along.velocity / thin[n].along.velocity, 1.0, a == 0.0 ? 1e-15 : 0.01) << n;
      EXPECT_NEAR(sharp[n].normal.velocity / thin[n].normal.velocity, 1.0, a == 0.0 ? 1e-15 : 0.13) << n;
    }
  }
}

/// The wider the delta function, the less a membrane moves; the shortest waves most of all.
TEST(MembraneResponse, FallsWithTheWidthOfTheDeltaFunction) {
  for (const double a : {0.0, 20.0}) {
    const MembraneResponse sharp = response(0.0, a, 1.0);
    double last_width = 0.0;
    for (const double h : {0.05, 0.1, 0.2, 0.4}) {
      const MembraneResponse wide = response(h, a, 1.0), narrower = response(last_width, a, 1.0);
      double last = 1.0;
      for (int n = 0; n < degrees; ++n)
        for (const auto part : {&MembraneResponse::Mode::along, &MembraneResponse::Mode::normal})
          EXPECT_LT((wide[n].*part).velocity, (narrower[n].*part).velocity);
      for (int n = 0; n < degrees; ++n) {
        const double ratio = wide[n].normal.velocity / sharp[n].normal.velocity;
        EXPECT_LT(ratio, last);
        last = ratio;
      }
      last_width = h;
    }
  }
}

/// The integrals over k_z by a fine trapezium rule, for second moments of no kernel. What is left within the sheet is
/// exp(-c (k h)^2) with one c for both parts and all degrees, fluids and widths: more than nothing, and less than the
/// second moment of the kernels, with which short waves were underestimated and unstable.
TEST(MembraneResponse, IsTheIntegralAcrossTheSheetTimesADecayWithin) {
  const MembraneResponse::SecondMoments moments{.along = 0.3, .normal = 0.6};
  double c = 0.0;
  for (const double h : {0.25, 0.4})
    for (const auto& [a, mu] : {std::pair{20.0, 1.0}, {0.5, 3.0}}) {
      MembraneResponse modes(degrees, radius, h, moments);
      modes.update(a, mu);
      for (const int n : {16, 8, 2, 0}) {
        const double k = modes.wavenumber(n), step = k / 200, in_plane = k * k * h * h;
        double along = 0, normal = 0;
        for (double kz = 0.5 * step; kz < 60 / h; kz += step) {
          const double qq = k * k + kz * kz, inverse = step / (qq * (a + mu * qq)) / M_PI;
          along += inverse * kz * kz * std::exp(-moments.along * h * h * kz * kz);
          normal += inverse * k * k * std::exp(-moments.normal * h * h * kz * kz);
        }
        for (const double lost : {along / modes[n].along.velocity, normal / modes[n].normal.velocity}) {
          if (c == 0.0) c = std::log(lost) / in_plane;
          EXPECT_NEAR(std::log(lost), c * in_plane, 1e-6) << n;
        }
      }
    }
  EXPECT_GT(c, 0.0);
  EXPECT_LT(c, smoothed.along);
}

/// int r^2 phi dr of what a component in a direction is spread with across a sheet, in the mean over sheets that are turned at random: of a
/// force normal to it and of one along it. A component's function along itself is the normal one.
TEST(MembraneResponse, SecondMomentsAreThoseOfTheKernel) {
  const auto integral = [](DeltaKernel kernel, Direction direction) {
    constexpr int points = 40000;
    const double half = 0.5 * support_width(kernel, direction), step = 2 * half / points;
    double sum = 0;
    for (int i = 0; i < points; ++i) {
      const double r = -half + (i + 0.5) * step;
      sum += step * r * r * delta(kernel, r, direction);
    }
    return sum;
  };
  vesicle::Surface directions(8);  // exact for polynomials of degree 4
  directions.update(vesicle::sphere(directions.grid()));
  const vesicle::VectorField& normals = directions.normal();
  const vesicle::ScalarField weights = directions.area_weight() / directions.area();
  for (const DeltaKernel kernel : delta_kernels) {
    const double along_itself = integral(kernel, Direction::normal), across = integral(kernel, Direction::tangential);
    double normal = 0, along = 0;
    for (Eigen::Index k = 0; k < normals.rows(); ++k) {
      const vesicle::Vector3 n = normals.row(k).matrix().transpose();
      const vesicle::Vector3 t = n.unitOrthogonal(), s = n.cross(t);
      for (int i = 0; i < 3; ++i) {
        const double moment = n(i) * n(i) * along_itself + (1 - n(i) * n(i)) * across;
        normal += weights(k) * n(i) * n(i) * moment;
        along += weights(k) * 0.5 * (t(i) * t(i) + s(i) * s(i)) * moment;
      }
    }
    const MembraneResponse::SecondMoments found = MembraneResponse::second_moments(kernel);
    EXPECT_NEAR(found.normal, normal, 1e-6) << name(kernel);
    EXPECT_NEAR(found.along, along, 1e-6) << name(kernel);
  }
}

TEST(MembraneResponse, IsUpdatedWhenAnythingChanges) {
  MembraneResponse modes(degrees, radius, 0.2, smoothed);
  for (const auto& [a, mu] : {std::pair{1.0, 1.0}, {1.0, 2.0}, {3.0, 2.0}, {0.0, 2.0}}) {
    modes.update(a, mu);
    const MembraneResponse fresh = response(0.2, a, mu);
    EXPECT_EQ(modes[5].along.velocity, fresh[5].along.velocity);
    EXPECT_EQ(modes[5].normal.inertia, fresh[5].normal.inertia);
  }
}

}  // namespace
}  // namespace vesiflow::coupling::membrane_response_test
