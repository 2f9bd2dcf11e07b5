// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Temporal error against time spent, of the treatments of a field of viscosity in NavierStokes.
//   OMP_NUM_THREADS=1 build/release/bench/viscosity_treatments [--cells N] [--ratio R...] [--reynolds Re...]
//       [--treatment explicit extrapolated implicit loose stokes stokes_loose] [--steps 24 48...] [--reference-steps M]
//       [--time-limit S]
// Prints JSON.
//
// A viscous blob with forces on it moves and turns as told in an oscillating shear flow between t = 0, at rest, and t = 1.
// The reference is the flow on the same grid with a very small step, so that errors are those of the time step alone; its
// own error is estimated from half as many steps.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <omp.h>
#include <CLI/CLI.hpp>

#include "fluid/navier_stokes.h"
#include "support/timing.h"
#include "support/viscous_blob.h"

namespace {

using namespace vesiflow::fluid;
using namespace vesiflow::bench;

struct Setting {
  int cells;
  double ratio, reynolds_number;
};

// Half its greatest strength at t = 1, and falling.
double strength(double t) {
  const double s = std::sin(0.75 * std::numbers::pi * t);
  return s * s;
}

// "explicit", "extrapolated", "implicit" (tolerance 1e-10), "loose" (implicit, tolerance 1e-5), "stokes" (no inertia),
// "stokes_loose" (the same, tolerance 1e-4).
FluidParameters parameters_of(const std::string& treatment, double reynolds_number, std::shared_ptr<Field<Cell>> mu) {
  FluidParameters p;
  p.reynolds_number = reynolds_number;
  p.viscosity = std::move(mu);
  p.viscous_treatment = treatment == "explicit"       ? ViscousTreatment::explicit_
                        : treatment == "extrapolated" ? ViscousTreatment::extrapolated
                                                      : ViscousTreatment::implicit;
  if (treatment == "loose") p.velocity_solver = PcgOptions{.tolerance = 1e-5};
  if (treatment == "implicit") p.velocity_solver = PcgOptions{};
  if (treatment.starts_with("stokes")) p.inertia = Inertia::none;
  if (treatment == "stokes_loose") p.stokes.tolerance = 1e-4;
  return p;
}

struct Run {
  std::optional<FaceVector> velocity;  // if it got to the end
  double time = 0.0;                   // that it got to
  double cpu_seconds = 0.0;            // of the steps alone
  double iterations = 0.0;             // mean per step
};

double max_abs(const FaceVector& u) {
  double largest = 0.0;
  for (const ConstView& field : u.points()) {
    for (int k = 0; k < field.extent[2]; ++k) {
      for (int j = 0; j < field.extent[1]; ++j) {
        for (int i = 0; i < field.extent[0]; ++i) largest = std::max(largest, std::abs(field(i, j, k)));
      }
    }
  }
  return largest;
}

Run run(const Setting& s, const std::string& treatment, int steps) {
  const Grid grid({-3, -3, -3}, {3, 3, 3}, {s.cells, s.cells, s.cells});
  const auto mu = std::make_shared<Field<Cell>>(grid);
  set_viscosity(ViscousBlob(s.ratio, grid.spacing(0), 0.0), *mu);
  const auto walls = [](const Vector3& r, double t) { return Vector3{r[2] * strength(t), 0.0, 0.0}; };
  NavierStokes fluid(grid, parameters_of(treatment, s.reynolds_number, mu), walls, WallMotion::unsteady);
  Run result;
  for (int k = 1; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    const ViscousBlob blob(s.ratio, grid.spacing(0), t);
    set_viscosity(blob, *mu);
    set_force(blob, 5.0 * strength(t), fluid.force());
    try {
      result.cpu_seconds += 1e-3 * timed([&] { fluid.step(1.0 / steps); }).cpu;
    } catch (const std::runtime_error&) {
      return result;
    }
    const FluidReport& report = fluid.report();
    result.iterations +=
        (fluid.parameters().inertia == Inertia::none ? report.stokes.iterations : report.momentum.iterations) /
        (1.0 * steps);
    if (!(max_abs(fluid.velocity()) < 1e3)) return result;  // the walls move by at most 3
    result.time = t;
  }
  result.velocity = fluid.velocity().clone();
  return result;
}

struct Errors {
  double all, interface;  // relative, in the 2-norm: everywhere, and within two cells from the surface
};

Errors errors(const Setting& s, const FaceVector& u, const FaceVector& exact) {
  const Grid& grid = u.grid();
  const ViscousBlob blob(s.ratio, grid.spacing(0), 1.0);
  double difference = 0.0, size = 0.0, near_difference = 0.0, near_size = 0.0;
  for (int c = 0; c < 3; ++c) {
    const ConstView x = u.points()[c];
    const ConstView y = exact.points()[c];
    for (int k = 0; k < x.extent[2]; ++k) {
      for (int j = 0; j < x.extent[1]; ++j) {
        for (int i = 0; i < x.extent[0]; ++i) {
          const double d = x(i, j, k) - y(i, j, k);
          difference += d * d;
          size += y(i, j, k) * y(i, j, k);
          const Vector3 r = point_position(grid, face_centrings[c], i, j, k);
          if (std::abs(blob.distance(r)) > 2.0 * grid.spacing(0)) continue;
          near_difference += d * d;
          near_size += y(i, j, k) * y(i, j, k);
        }
      }
    }
  }
  return {std::sqrt(difference / size), std::sqrt(near_difference / near_size)};
}

struct Plan {
  std::vector<std::string> treatments;
  std::vector<int> steps;
  std::string reference;
  int reference_steps;
  double time_limit;  // seconds: no more steps of a treatment after a run that took longer
};

void study(const Setting& s, const Plan& plan) {
  const Run reference = run(s, plan.reference, plan.reference_steps);
  const Run half = run(s, plan.reference, plan.reference_steps / 2);
  if (!reference.velocity || !half.velocity) throw std::runtime_error("the reference blew up");
  const double own_error = errors(s, *half.velocity, *reference.velocity).all / 3.0;
  std::printf(
      " {\"cells\": %d, \"ratio\": %g, \"reynolds_number\": %g, \"reference\": \"%s\", \"reference_steps\": %d, "
      "\"reference_error\": %.3g, \"reference_seconds\": %.3f, \"runs\": [",
      s.cells, s.ratio, s.reynolds_number, plan.reference.c_str(), plan.reference_steps, own_error,
      reference.cpu_seconds);
  bool first = true;
  for (const std::string& treatment : plan.treatments) {
    double treatment_seconds = 0.0;
    for (const int steps : plan.steps) {
      if (treatment_seconds > plan.time_limit) continue;
      const Run result = run(s, treatment, steps);
      treatment_seconds = result.cpu_seconds;
      std::printf("%s\n  {\"treatment\": \"%s\", \"steps\": %d, \"cpu_seconds\": %.4f, \"iterations\": %.1f, ",
                  first ? "" : ",", treatment.c_str(), steps, result.cpu_seconds, result.iterations);
      first = false;
      if (result.velocity) {
        const Errors e = errors(s, *result.velocity, *reference.velocity);
        std::printf("\"error\": %.4g, \"error_interface\": %.4g}", e.all, e.interface);
      } else {
        std::printf("\"blew_up_after\": %.4f}", result.time);
      }
      std::fflush(stdout);
    }
  }
  std::printf("]}");
}

}  // namespace

int main(int argc, char** argv) {
  int cells = 32;
  std::vector<double> ratios{5, 20, 100};
  std::vector<double> reynolds_numbers{1e-3, 1.0};
  Plan plan{{"explicit", "extrapolated", "implicit", "loose"}, {12, 24, 48, 96, 192, 384}, "extrapolated", 6144, 15.0};
  CLI::App app("Temporal error of the treatments of a field of viscosity against time spent");
  app.add_option("--cells", cells, "cells along each axis");
  app.add_option("--ratio", ratios, "of viscosities");
  app.add_option("--reynolds", reynolds_numbers, "Reynolds numbers");
  const auto known = CLI::IsMember({"explicit", "extrapolated", "implicit", "loose", "stokes", "stokes_loose"});
  app.add_option("--treatment", plan.treatments, "treatments")->check(known);
  app.add_option("--steps", plan.steps, "time steps from 0 to 1");
  app.add_option("--reference", plan.reference, "treatment of the reference")->check(known);
  app.add_option("--reference-steps", plan.reference_steps, "its time steps");
  app.add_option("--time-limit", plan.time_limit, "seconds: no more steps of a treatment after a run that took longer");
  CLI11_PARSE(app, argc, argv);

  omp_set_num_threads(1);
  std::printf("[\n");
  bool first = true;
  for (const double ratio : ratios) {
    for (const double reynolds_number : reynolds_numbers) {
      if (!first) std::printf(",\n");
      first = false;
      study({cells, ratio, reynolds_number}, plan);
    }
  }
  std::printf("\n]\n");
  return 0;
}
