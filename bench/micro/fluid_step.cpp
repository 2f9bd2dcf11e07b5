// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// A whole step of NavierStokes by phase, as a multiple of the four plain FFTW transform pairs (pressure and three velocity
// components) that it replaces, measured in turn in one run with one thread.
//   OMP_NUM_THREADS=1 build/release/bench/fluid_step [--cells N...] [--repetitions R] [--only CASE...]
//       [--planning measure] [--json]
// Fails if a step allocates.
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <omp.h>
#include <CLI/CLI.hpp>

#include "fluid/navier_stokes.h"
#include "support/allocation_counter.h"
#include "support/four_transforms.h"
#include "support/timing.h"
#include "support/viscous_blob.h"

namespace {

using namespace vesiflow::fluid;
using namespace vesiflow::bench;

struct Case {
  const char* name;
  double ratio;
  ViscousTreatment treatment;
  Precision precision = Precision::double_;
};
const std::vector<Case> all_cases{
    {"ratio 1", 1.0, ViscousTreatment::extrapolated},
    {"ratio 1, mixed", 1.0, ViscousTreatment::extrapolated, Precision::mixed},
    {"ratio 20, explicit", 20.0, ViscousTreatment::explicit_},
    {"ratio 20, extrapolated", 20.0, ViscousTreatment::extrapolated},
    {"ratio 20, extrapolated, mixed", 20.0, ViscousTreatment::extrapolated, Precision::mixed},
    {"ratio 20, implicit", 20.0, ViscousTreatment::implicit},
    {"ratio 20, implicit, mixed", 20.0, ViscousTreatment::implicit, Precision::mixed}};

struct Phase {
  const char* name;
  PhaseAccount FluidTimings::*account;
};
const std::array<Phase, 4> phases{{{"convection", &FluidTimings::convection},
                                   {"viscous", &FluidTimings::viscous},
                                   {"momentum", &FluidTimings::momentum},
                                   {"projection", &FluidTimings::projection}}};

// A blob in a shear flow at Re = 1e-3, with the paper's time step for the mesh width.
class Flow {
 public:
  Flow(const Grid& grid, const Case& c)
      : ratio_(c.ratio),
        mu_(std::make_shared<Field<Cell>>(grid)),
        dt_(2.0 / (3.0 * grid.cells[0])),
        fluid_(grid, parameters(c), [](const Vector3& r, double) {
          return Vector3{r[2], 0.0, 0.0};
        }) {
    fluid_.set_velocity([](const Vector3& r) { return Vector3{r[2], 0.0, 0.0}; });
    set_force(blob(), 1.0, fluid_.force());
    for (int k = 0; k < 3; ++k) fluid_.step(dt_);
    const long before = vesiflow::test::allocation_count();
    for (int k = 0; k < 2; ++k) fluid_.step(dt_);
    allocations_ = vesiflow::test::allocation_count() - before;
  }
  // In two warmed-up steps.
  long allocations() const { return allocations_; }

  struct Step {
    Sample time;
    std::array<double, 4> share;  // of the phases in the wall time
    int iterations;
  };
  // With the field of viscosity where it is by now.
  Step step() {
    set_viscosity(blob(), *mu_);
    const FluidTimings before = fluid_.timings();
    Step result{timed([&] { fluid_.step(dt_); }), {}, 0};
    result.iterations = fluid_.report().momentum.iterations;
    for (std::size_t p = 0; p < phases.size(); ++p) {
      result.share[p] = 1e3 * ((fluid_.timings().*phases[p].account).seconds - (before.*phases[p].account).seconds) /
                        result.time.wall;
    }
    return result;
  }

 private:
  ViscousBlob blob() const { return {ratio_, fluid_.grid().spacing(0), fluid_.time()}; }
  FluidParameters parameters(const Case& c) {
    set_viscosity(ViscousBlob(ratio_, mu_->grid().spacing(0), 0.0), *mu_);
    FluidParameters result;
    result.reynolds_number = 1e-3;
    result.viscous_treatment = c.treatment;
    result.precision = c.precision;
    if (c.ratio != 1.0) result.viscosity = mu_;
    return result;
  }

  double ratio_;
  std::shared_ptr<Field<Cell>> mu_;
  double dt_;
  NavierStokes fluid_;
  long allocations_;
};

struct Row {
  std::vector<Sample> steps;
  std::array<std::vector<double>, 4> shares;
  int iterations = 0;
};

void print(const Case& c, int cells, const Row& row, long allocations, const std::vector<Sample>& transforms, bool json,
           bool first) {
  const double milliseconds = median(row.steps, &Sample::cpu);
  const double ratio = median_ratio(row.steps, transforms, &Sample::cpu);
  const double wall_ratio = median_ratio(row.steps, transforms, &Sample::wall);
  std::array<double, 4> phase{};
  for (std::size_t p = 0; p < phases.size(); ++p) phase[p] = median(row.shares[p]) * milliseconds;
  const char* format =
      json ? "%s\n {\"cells\": %d, \"case\": \"%s\", \"step_ms\": %.3f, \"convection_ms\": %.3f, \"viscous_ms\": %.3f, "
             "\"momentum_ms\": %.3f, \"projection_ms\": %.3f, \"transforms_ms\": %.3f, \"ratio\": %.3f, "
             "\"ratio_wall\": %.3f, \"iterations\": %d, \"allocations\": %ld}"
           : "%s%5d  %-30s %9.2f %10.2f %9.2f %9.2f %10.2f %10.2f %7.3f %7.3f %10d %11ld\n";
  std::printf(format, json && !first ? "," : "", cells, c.name, milliseconds, phase[0], phase[1], phase[2], phase[3],
              median(transforms, &Sample::cpu), ratio, wall_ratio, row.iterations, allocations);
  std::fflush(stdout);
}

// The number of allocations in all flows. They are counted with two threads: a team of one is allocated by the OpenMP
// runtime (libgomp) at every parallel region.
long measure(int cells, const std::vector<Case>& cases, int repetitions, unsigned planning, bool json, bool& first) {
  const Grid grid({-6, -6, -6}, {6, 6, 6}, {cells, cells, cells});
  FourTransforms reference(grid, planning);
  std::vector<std::unique_ptr<Flow>> flows;
  omp_set_num_threads(2);
  for (const Case& c : cases) flows.push_back(std::make_unique<Flow>(grid, c));
  omp_set_num_threads(1);
  std::vector<Row> rows(flows.size());
  std::vector<Sample> transforms;
  for (int r = 0; r < repetitions; ++r) {
    transforms.push_back(reference.measure());
    for (std::size_t i = 0; i < flows.size(); ++i) {
      const Flow::Step step = flows[i]->step();
      rows[i].steps.push_back(step.time);
      for (std::size_t p = 0; p < phases.size(); ++p) rows[i].shares[p].push_back(step.share[p]);
      rows[i].iterations = step.iterations;
    }
  }
  long allocations = 0;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    print(cases[i], cells, rows[i], flows[i]->allocations(), transforms, json, first);
    first = false;
    allocations += flows[i]->allocations();
  }
  return allocations;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes{64, 128};
  int repetitions = 15;
  unsigned planning = FFTW_MEASURE;
  bool json = false;
  std::vector<std::string> only;
  CLI::App app("Times of a step of NavierStokes, by phase");
  app.add_option("--cells", sizes, "cells along each axis");
  app.add_option("--repetitions", repetitions, "interleaved repetitions of each measurement")
      ->check(CLI::PositiveNumber);
  app.add_option("--planning", planning, "of FFTW's transforms")
      ->transform(CLI::CheckedTransformer(std::map<std::string, unsigned>{
          {"estimate", FFTW_ESTIMATE}, {"measure", FFTW_MEASURE}, {"patient", FFTW_PATIENT}}));
  app.add_flag("--json", json, "print JSON instead of a table");
  app.add_option("--only", only, "cases to measure, by name");
  CLI11_PARSE(app, argc, argv);
  std::vector<Case> cases;
  for (const Case& c : all_cases) {
    if (only.empty() || std::find(only.begin(), only.end(), c.name) != only.end()) cases.push_back(c);
  }

  if (json) {
    std::printf("[");
  } else {
    std::printf(
        "CPU milliseconds with one thread, medians: a step, its phases (their shares of its wall time), the four pairs "
        "of\n"
        "transforms; medians of the ratios step / transforms by CPU and by wall time; solver iterations; allocations "
        "in two steps.\n"
        "%5s  %-30s %9s %10s %9s %9s %10s %10s %7s %7s %10s %11s\n",
        "cells", "", "step", "convection", "viscous", "momentum", "projection", "transforms", "ratio", "wall",
        "iterations", "allocations");
  }
  bool first = true;
  long allocations = 0;
  for (const int cells : sizes) allocations += measure(cells, cases, repetitions, planning, json, first);
  if (json) std::printf("\n]\n");
  if (!vesiflow::test::allocations_are_counted()) std::fprintf(stderr, "allocations are not counted in this build\n");
  return allocations == 0 ? 0 : 1;
}
