// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Velocity of a membrane that pushes the fluid with a given force, without thickness and by the delta function: errors
// against the grid, as JSON.
//   OMP_NUM_THREADS=1 build/release/bench/sharp_accuracy [--cells N...] [--reference N...] [--aspect A] [--ratio L...]
//     [--degree N...] [--walls [--wall-gap D]]
// A sphere or a spheroid of the volume of the unit sphere, off the points of the grid, in a box 6 wide, quasi-static.
// The reference is the sharp membrane on one finer grid, or extrapolated from two with an error of second order.
// Tabulated by `validation/run.py sharp_modes` in docs/studies/sharp_membranes.md.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include "coupling/indicator.h"
#include "coupling/marker_transfer.h"
#include "fluid/navier_stokes.h"
#include "motion/following_parameters.h"
#include "transfer/sharp_transfer.h"
#include "vesicle/shapes.h"
#include "vesicle/surface.h"
#include "viscosity/interface_velocity.h"

namespace {

using namespace vesiflow;
using vesicle::ScalarField;
using vesicle::Surface;
using vesicle::Vector3;
using vesicle::VectorField;

const Vector3 centre(0.013, -0.021, 0.037);
constexpr double half_width = 3.0;

// The long axis lies askew in the grid.
VectorField body(const vesicle::SphereGrid& grid, double aspect, const Vector3& at) {
  vesicle::Placement placement;
  placement.rotation = Eigen::AngleAxis<double>(0.6, Vector3(1.0, 2.0, 0.5).normalized()).toRotationMatrix();
  placement.centre = at;
  return vesicle::spheroid(grid, aspect, placement);
}

// On the sphere of the parameters: a harmonic of that degree about an axis and one of order `degree` around another, of
// mean square 1 each.
ScalarField harmonic(const vesicle::SphereGrid& grid, int degree) {
  const Vector3 pole = Vector3(0.5, -0.3, 0.8).normalized(), e1 = Vector3(0.9, 0.2, -0.4).normalized();
  const Vector3 e2 = Vector3(0.3, -1.0, 0.2).cross(e1).normalized();
  ScalarField zonal(grid.size()), around(grid.size()), weight(grid.size());
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const double s = grid.sin_colatitude()[j], phi = grid.longitude(i);
      const Vector3 r(s * std::cos(phi), s * std::sin(phi), grid.cos_colatitude()[j]);
      const Eigen::Index m = grid.index(i, j);
      zonal[m] = std::legendre(static_cast<unsigned>(degree), std::clamp(pole.dot(r), -1.0, 1.0));
      around[m] = std::pow(std::complex<double>(e1.dot(r), e2.dot(r)), degree).real();
      weight[m] = grid.weight()[j];
    }
  weight /= weight.sum();
  return zonal / std::sqrt((zonal.square() * weight).sum()) + around / std::sqrt((around.square() * weight).sum());
}

struct Mode {
  bool is_tension;
  int degree;
  VectorField force;
};

// The harmonic times the normal, and as a tension: grad_s s - 2 H s n.
std::vector<Mode> modes(const Surface& surface, const std::vector<int>& degrees) {
  std::vector<Mode> all;
  for (const bool is_tension : {false, true})
    for (const int degree : degrees) {
      const ScalarField f = harmonic(surface.grid(), degree);
      VectorField force = surface.normal().colwise() * f;
      if (is_tension) {
        force.colwise() *= -2.0 * surface.mean_curvature();
        VectorField gradient(f.size(), 3);
        surface.gradient(f, gradient);
        force += gradient;
      }
      all.push_back({is_tension, degree, force});
    }
  return all;
}

fluid::Grid grid_of(int cells, bool has_walls) {
  return {{-half_width, -half_width, -half_width},
          {half_width, half_width, half_width},
          {cells, cells, cells},
          {.periodic = {true, true, !has_walls}}};
}

fluid::FluidParameters quasi_static() {
  fluid::FluidParameters parameters;
  parameters.inertia = fluid::Inertia::none;
  return parameters;
}

fluid::NavierStokes fluid_in_box(const fluid::Grid& grid, const fluid::FluidParameters& parameters) {
  return {grid, parameters, [](const auto&...) { return fluid::Vector3{}; }};
}

double radius(const Surface& surface) {
  return std::sqrt(surface.area() / (4.0 * M_PI));
}

class SharpMembrane {
 public:
  SharpMembrane(const Surface& surface, int cells, bool has_walls)
      : surface_(surface),
        fluid_(fluid_in_box(grid_of(cells, has_walls), quasi_static())),
        delta_(fluid_.grid()),
        transfer_(fluid_.grid(), surface.grid(), {.degrees = degrees(surface, cells)}) {
    delta_.update(surface.positions());
    transfer_.update(surface);
  }

  // Those of a force that a run leaves to the grid are below.
  static int degrees(const Surface& surface, int cells) {
    return std::min(surface.grid().latitudes(), coupling::sharp_degrees(radius(surface), 2.0 * half_width / cells));
  }

  VectorField velocity(const VectorField& force, double ratio, int& solves) {
    VectorField velocity(force.rows(), 3);
    coupling::InterfaceVelocity interface(ratio, force.rows());
    for (solves = 1;; ++solves) {
      transfer_.set_force(force, ratio == 1.0 ? nullptr : &interface.jump());
      delta_.clear(fluid_.force());
      transfer_.clear(fluid_.force(), fluid_.divergence_source());
      transfer_.add_to(fluid_.force(), fluid_.divergence_source(), delta_);
      solves == 1 ? fluid_.step(1.0) : fluid_.solve_again();
      transfer_.interpolate(fluid_.velocity(), velocity);
      if (ratio == 1.0) return velocity;
      if (!fluid_.grid().has_walls()) velocity.rowwise() += mean_flow(interface).transpose().array();
      if (interface.improve(surface_, velocity) < 3e-6 || solves == 100) return interface.value();
    }
  }

 private:
  // That of mu u, where the mean of u is zero.
  Vector3 mean_flow(coupling::InterfaceVelocity& interface) const {
    return -(interface.displaced(surface_) + transfer_.integral_beyond_sum()) / std::pow(2.0 * half_width, 3);
  }

  const Surface& surface_;
  fluid::NavierStokes fluid_;
  coupling::MarkerTransfer delta_;
  coupling::SharpTransfer transfer_;
};

class DeltaMembrane {
 public:
  DeltaMembrane(const Surface& surface, int cells, bool has_walls, double ratio)
      : surface_(surface),
        fluid_(fluid_in_box(grid_of(cells, has_walls), parameters(surface, grid_of(cells, has_walls), ratio))),
        transfer_(fluid_.grid()) {
    transfer_.update(surface.positions());
  }

  VectorField velocity(const VectorField& force) {
    transfer_.clear(fluid_.force());
    transfer_.spread(force, surface_.area_weight(), fluid_.force());
    fluid_.step(1.0);
    VectorField velocity(force.rows(), 3);
    transfer_.interpolate(fluid_.velocity(), velocity);
    return velocity;
  }

 private:
  static fluid::FluidParameters parameters(const Surface& surface, const fluid::Grid& grid, double ratio) {
    fluid::FluidParameters all = quasi_static();
    if (ratio == 1.0) return all;
    const auto mu = std::make_shared<fluid::Field<fluid::Cell>>(grid);
    coupling::Indicator indicator(grid, 1);
    indicator.add(0, surface, ratio - 1.0);
    indicator.solve(*mu);
    for (int k = 0; k < mu->extent(2); ++k)
      for (int j = 0; j < mu->extent(1); ++j)
        for (int i = 0; i < mu->extent(0); ++i)
          mu->row(j, k)[i] = std::clamp(1.0 + mu->row(j, k)[i], std::min(1.0, ratio), std::max(1.0, ratio));
    fluid::extend_to_ghosts(*mu);
    all.viscosity = mu;
    all.stokes.tolerance = 1e-6;
    return all;
  }

  const Surface& surface_;
  fluid::NavierStokes fluid_;
  coupling::MarkerTransfer transfer_;
};

struct Result {
  VectorField velocity;
  int solves = 0;
};

void print(const char* name, const std::vector<double>& values, const char* end) {
  std::printf("\"%s\": [", name);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const char* comma = i == 0 ? "" : ", ";
    std::isfinite(values[i]) ? std::printf("%s%.5g", comma, values[i]) : std::printf("%snull", comma);
  }
  std::printf("]%s", end);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes{32, 48, 64, 96}, references{128}, degrees{2, 3, 4, 6, 8, 10};
  std::vector<double> ratios{1.0};
  int latitudes = 48, delta_cells = 48;
  double aspect = 1.0;
  bool has_walls = false;
  CLI::App app{
      "Velocity of a membrane that pushes the fluid with a given force: errors against a finer grid, as JSON."};
  app.add_option("--cells", sizes, "cells along the box of width 6")->check(CLI::Range(16, 256))->capture_default_str();
  app.add_option("--reference", references,
                 "cells of the reference: one grid, or two to extrapolate from, the coarser first")
      ->expected(1, 2)
      ->check(CLI::Range(16, 384))
      ->capture_default_str();
  app.add_option("--latitudes", latitudes, "of the markers")->check(CLI::Range(8, 128))->capture_default_str();
  app.add_option("--aspect", aspect, "length over width of the body")
      ->check(CLI::Range(0.2, 4.0))
      ->capture_default_str();
  app.add_option("--ratio", ratios, "viscosities inside over that outside")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  app.add_option("--degree", degrees, "degrees of the forces")->check(CLI::Range(2, 40))->capture_default_str();
  app.add_option("--delta-cells", delta_cells, "most cells of the delta function at ratios other than 1")
      ->capture_default_str();
  CLI::Option* walls = app.add_flag("--walls", has_walls, "at z = -3 and 3; else all is periodic");
  double gap = 0.0;
  CLI::Option* near = app.add_option("--wall-gap", gap, "from a sphere to the lower wall; else it is in the middle")
                          ->check(CLI::Range(0.01, 2.0))
                          ->needs(walls);
  CLI11_PARSE(app, argc, argv);

  Surface surface(latitudes);
  Vector3 at = centre;
  if (near->count() > 0) at[2] = gap + 1.0 - half_width;
  surface.update(body(surface.grid(), aspect, at), vesicle::GeometryDetail::curvature);
  const std::vector<Mode> all = modes(surface, degrees);
  const auto size = [&](const VectorField& field) {
    return std::sqrt((field.square().rowwise().sum() * surface.area_weight()).sum());
  };
  // By grid, ratio and mode.
  const auto sharp_on = [&](int cells) {
    SharpMembrane membrane(surface, cells, has_walls);
    std::vector<std::vector<Result>> found(ratios.size(), std::vector<Result>(all.size()));
    for (std::size_t r = 0; r < ratios.size(); ++r)
      for (std::size_t m = 0; m < all.size(); ++m)
        if (all[m].degree < SharpMembrane::degrees(surface, cells))
          found[r][m].velocity = membrane.velocity(all[m].force, ratios[r], found[r][m].solves);
    return found;
  };
  const auto delta_on = [&](int cells) {
    std::vector<std::vector<Result>> found(ratios.size(), std::vector<Result>(all.size()));
    for (std::size_t r = 0; r < ratios.size(); ++r) {
      if (ratios[r] != 1.0 && cells > delta_cells) continue;
      DeltaMembrane membrane(surface, cells, has_walls, ratios[r]);
      for (std::size_t m = 0; m < all.size(); ++m) found[r][m].velocity = membrane.velocity(all[m].force);
    }
    return found;
  };
  std::map<int, std::vector<std::vector<Result>>> sharp, delta;
  for (const auto& grids : {sizes, references})
    for (const int cells : grids)
      if (!sharp.contains(cells)) sharp[cells] = sharp_on(cells);
  for (const int cells : sizes) delta[cells] = delta_on(cells);

  std::printf("{\"radius\": %.6g, \"modes\": [\n", radius(surface));
  for (std::size_t r = 0; r < ratios.size(); ++r)
    for (std::size_t m = 0; m < all.size(); ++m) {
      VectorField exact = sharp[references.back()][r][m].velocity;
      if (references.size() == 2) {
        const double weight = std::pow(static_cast<double>(references[1]) / references[0], 2);
        exact = (weight * exact - sharp[references.front()][r][m].velocity) / (weight - 1.0);
      }
      const auto error = [&](const Result& result) {
        return result.velocity.size() == 0 ? NAN : size(result.velocity - exact) / size(exact);
      };
      std::vector<double> of_sharp, of_delta, solves;
      for (const int cells : sizes) {
        of_sharp.push_back(error(sharp[cells][r][m]));
        of_delta.push_back(error(delta[cells][r][m]));
        solves.push_back(sharp[cells][r][m].solves);
      }
      std::printf("  {\"force\": \"%s\", \"degree\": %d, \"ratio\": %g, ", all[m].is_tension ? "tension" : "normal",
                  all[m].degree, ratios[r]);
      print("sharp", of_sharp, ", ");
      print("delta", of_delta, ", ");
      print("solves", solves, r + 1 == ratios.size() && m + 1 == all.size() ? "}\n" : "},\n");
    }
  std::printf("]}\n");
}
