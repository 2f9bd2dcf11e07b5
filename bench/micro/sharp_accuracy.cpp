// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Velocity of a membrane that pushes the fluid with a given force, by the delta function and without thickness: errors against the grid.
//   OMP_WAIT_POLICY=passive build/release/bench/sharp_accuracy [--cells N...] [--reference N] [--aspect A] [--ratio L] [--walls]
// A sphere or an ellipsoid of the volume of the unit sphere, off the points of the grid, in a box 6 wide, quasi-static. Tabulated in
// docs/jump_conditions.md.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "coupling/marker_transfer.h"
#include "fluid/navier_stokes.h"
#include "transfer/sharp_transfer.h"
#include "vesicle/surface.h"
#include "viscosity/interface_velocity.h"

namespace {

using namespace vesiflow;
using vesicle::ScalarField;
using vesicle::Surface;
using vesicle::VectorField;

const vesicle::Vector3 centre(0.013, -0.021, 0.037);
constexpr double half_width = 3.0;

VectorField ellipsoid(const vesicle::SphereGrid& grid, double aspect) {
  const double across = std::cbrt(1.0 / aspect), along = aspect * across;
  VectorField x(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const double s = grid.sin_colatitude()[j], phi = grid.longitude(i);
      x.row(grid.index(i, j)) << across * s * std::cos(phi), across * s * std::sin(phi),
          along * grid.cos_colatitude()[j];
    }
  x.rowwise() += centre.transpose().array();
  return x;
}

struct Mode {
  std::string name;
  VectorField force;
};

// A harmonic of the direction times the normal, and as a tension: grad_s s - 2 H s n.
std::vector<Mode> modes(const Surface& surface) {
  std::vector<Mode> all;
  for (const bool is_tension : {false, true})
    for (const int degree : {2, 4}) {
      ScalarField f(surface.positions().rows());
      for (Eigen::Index m = 0; m < f.size(); ++m) {
        const vesicle::Vector3 r = (vesicle::Vector3(surface.positions().row(m).transpose()) - centre).normalized();
        const double x = r[0], y = r[1], z = r[2];
        f[m] = degree == 2 ? x * z + 0.3 * (x * x - y * y) : 4.0 * x * z * (x * x - z * z) + x * y * (x * x - y * y);
      }
      VectorField force = surface.normal().colwise() * f;
      if (is_tension) {
        force.colwise() *= -2.0 * surface.mean_curvature();
        VectorField gradient(f.size(), 3);
        surface.gradient(f, gradient);
        force += gradient;
      }
      all.push_back({(is_tension ? "tension " : "normal ") + std::to_string(degree), force});
    }
  return all;
}

struct Problem {
  const Surface& surface;
  double ratio;
  bool has_walls;

  fluid::Grid grid(int cells) const {
    return {{-half_width, -half_width, -half_width},
            {half_width, half_width, half_width},
            {cells, cells, cells},
            {.periodic = {true, true, !has_walls}}};
  }

  static fluid::FluidParameters quasi_static() {
    fluid::FluidParameters parameters;
    parameters.inertia = fluid::Inertia::none;
    return parameters;
  }

  // Only for equal viscosities: the other way needs an indicator.
  VectorField by_delta(int cells, const VectorField& force) const {
    fluid::NavierStokes fluid(grid(cells), quasi_static());
    coupling::MarkerTransfer transfer(fluid.grid());
    transfer.update(surface.positions());
    transfer.spread(force, surface.area_weight(), fluid.force());
    fluid.step(1.0);
    VectorField velocity(force.rows(), 3);
    transfer.interpolate(fluid.velocity(), velocity);
    return velocity;
  }

  VectorField sharp(int cells, const VectorField& force, int& solves) const {
    fluid::NavierStokes fluid(grid(cells), quasi_static());
    coupling::MarkerTransfer delta(fluid.grid());
    delta.update(surface.positions());
    coupling::SharpTransfer transfer(fluid.grid(), surface.grid(), {});
    transfer.update(surface);
    VectorField velocity(force.rows(), 3);
    coupling::InterfaceVelocity interface(ratio, force.rows());
    for (solves = 1;; ++solves) {
      transfer.set_force(force, ratio == 1.0 ? nullptr : &interface.jump());
      transfer.clear(fluid.force(), fluid.divergence_source());
      transfer.add_to(fluid.force(), fluid.divergence_source(), delta);
      solves == 1 ? fluid.step(1.0) : fluid.solve_again();
      transfer.interpolate(fluid.velocity(), velocity);
      if (ratio == 1.0) return velocity;
      if (!fluid.grid().has_walls()) velocity.rowwise() += mean_flow(interface).transpose().array();
      if (interface.improve(surface, velocity) < 1e-7 || solves == 200) return interface.value();
    }
  }

  // That of mu u, where the mean of u is zero.
  vesicle::Vector3 mean_flow(coupling::InterfaceVelocity& interface) const {
    const ScalarField flux = (interface.jump() * surface.normal()).rowwise().sum();
    const double volume = 8.0 * half_width * half_width * half_width;
    VectorField x = surface.positions();
    x.rowwise() -= centre.transpose().array();
    return -surface.integral(VectorField(x.colwise() * flux)) / volume;
  }
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes{32, 48, 64, 96};
  int reference = 128, latitudes = 32;
  double aspect = 1.0, ratio = 1.0;
  bool has_walls = false;
  CLI::App app{"Velocity of a membrane that pushes the fluid with a given force: errors against the finest grid."};
  app.add_option("--cells", sizes, "cells along the box of width 6")->check(CLI::Range(16, 256))->capture_default_str();
  app.add_option("--reference", reference, "cells of the reference")->check(CLI::Range(16, 384))->capture_default_str();
  app.add_option("--latitudes", latitudes, "of the markers")->check(CLI::Range(8, 128))->capture_default_str();
  app.add_option("--aspect", aspect, "length over width of the body")
      ->check(CLI::Range(0.2, 4.0))
      ->capture_default_str();
  app.add_option("--ratio", ratio, "viscosity inside over that outside")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  app.add_flag("--walls", has_walls, "at z = -3 and 3; else all is periodic");
  CLI11_PARSE(app, argc, argv);

  Surface surface(latitudes);
  surface.update(ellipsoid(surface.grid(), aspect), vesicle::GeometryDetail::curvature);
  const Problem problem{surface, ratio, has_walls};
  const auto size = [&](const VectorField& field) {
    return std::sqrt((field.square().rowwise().sum() * surface.area_weight()).sum());
  };
  std::printf("%-10s %6s %10s %7s %10s %7s %7s\n", "force", "R/h", "delta, %", "order", "sharp, %", "order", "solves");
  for (const Mode& mode : modes(surface)) {
    int solves = 0;
    const VectorField exact = problem.sharp(reference, mode.force, solves);
    double last_delta = NAN, last_sharp = NAN, last_cells = NAN;
    for (const int cells : sizes) {
      const double off = 100.0 * size(problem.sharp(cells, mode.force, solves) - exact) / size(exact);
      const double delta = ratio == 1.0 ? 100.0 * size(problem.by_delta(cells, mode.force) - exact) / size(exact) : NAN;
      const double finer = std::log(cells / last_cells);
      std::printf("%-10s %6.2f %10.3f %7.2f %10.4f %7.2f %7d\n", mode.name.c_str(), cells / (2.0 * half_width), delta,
                  std::log(last_delta / delta) / finer, off, std::log(last_sharp / off) / finer, solves);
      std::fflush(stdout);
      last_delta = delta, last_sharp = off, last_cells = cells;
    }
  }
}
