// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// One coupled step of a vesicle in shear flow by phase, as a multiple of the four plain FFTW transform pairs (pressure and three
// velocity components) that it replaces, all measured in turn in one run, with one and with two threads.
//   OMP_WAIT_POLICY=passive build/release/bench/step [--cells N...] [--ratio L...] [--markers NAME...] [--repetitions R] [--json]
// Fails if a warmed-up step allocates.
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <omp.h>
#include <CLI/CLI.hpp>

#include "coupling/flow.h"
#include "coupling/simulation.h"
#include "support/allocation_counter.h"
#include "support/four_transforms.h"
#include "support/timing.h"

namespace {

using namespace vesiflow::coupling;
using namespace vesiflow::bench;

struct Phase {
  const char* name;
  vesiflow::fluid::PhaseAccount Phases::*account;
  bool is_coupling;  // of membrane and coupling, not of the fluid
};
const std::array<Phase, 9> all_phases{{{"membrane", &Phases::membrane, true},
                                       {"spread", &Phases::spread, true},
                                       {"interpolate", &Phases::interpolate, true},
                                       {"mesh", &Phases::mesh, true},
                                       {"indicator", &Phases::indicator, false},
                                       {"convection", &Phases::fluid_convection, false},
                                       {"viscous", &Phases::fluid_viscous, false},
                                       {"momentum", &Phases::fluid_momentum, false},
                                       {"projection", &Phases::fluid_projection, false}}};

int latitudes_for(int cells) {
  return cells < 256 ? cells / 2 : 96;
}

MarkerMotion motion_of(const std::string& name) {
  const auto found = std::ranges::find(marker_motion_names, name);
  if (found == marker_motion_names.end()) throw std::invalid_argument("--markers " + name + ": no such motion");
  return static_cast<MarkerMotion>(found - marker_motion_names.begin());
}

// Steps as one would take them with this integrator.
SimulationParameters parameters_of(int cells, double ratio, MarkerMotion markers) {
  SimulationParameters parameters;
  parameters.domain.cells.fill(cells);
  parameters.fluid.viscosity_ratio = ratio;
  parameters.mesh.latitudes = latitudes_for(cells);
  parameters.time.markers = markers;
  if (markers == MarkerMotion::shape_following) {
    parameters.time.step = ratio == 1.0 ? 1.0 / 24.0 : 1.0 / 48.0;
    parameters.membrane.sigma0 = ratio == 1.0 ? 6000.0 : 2000.0;
  } else {
    parameters.time.step = 1.0 / (3.0 * cells);
    parameters.membrane.sigma0 = 600.0;
  }
  parameters.vesicles.resize(1);
  parameters.vesicles[0].reduced_volume = 0.9;
  return parameters;
}

// Of times, disturbed by other programs. Not the least one: after a look at the meshes the next step finds its geometry done.
double lower_quartile(std::vector<double> values) {
  const auto quarter = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
  std::nth_element(values.begin(), quarter, values.end());
  return *quarter;
}

class Case {
 public:
  Case(int cells, double ratio, const std::string& markers)
      : cells_(cells),
        ratio_(ratio),
        markers_(markers),
        simulation_(parameters_of(cells, ratio, motion_of(markers)),
                    shear_flow(1.0, parameters_of(cells, ratio, motion_of(markers)).domain)) {
    for (int k = 0; k < 4; ++k) simulation_.step();  // first step and histories
    const long before = vesiflow::test::allocation_count();
    for (int k = 0; k < 2; ++k) simulation_.step();
    allocations_ = vesiflow::test::allocation_count() - before;
  }
  // In two warmed-up steps.
  long allocations() const { return allocations_; }

  // One step with one thread and one with two.
  void measure() {
    for (int threads = 1; threads <= 2; ++threads) {
      omp_set_num_threads(threads);
      const Phases before = simulation_.phases();
      Row& row = rows_[threads - 1];
      row.steps.push_back(timed([&] { simulation_.step(); }));
      const Phases after = simulation_.phases();
      for (std::size_t p = 0; p < all_phases.size(); ++p) {
        const double milliseconds =
            1e3 * ((after.*all_phases[p].account).seconds - (before.*all_phases[p].account).seconds);
        row.phases[p].push_back(milliseconds);
      }
    }
  }

  // transforms: in the same repetitions.
  void print(const std::vector<Sample>& transforms, bool json, bool first) const {
    for (int threads = 1; threads <= 2; ++threads) print(threads, transforms, json, first && threads == 1);
  }

 private:
  struct Row {
    std::vector<Sample> steps;
    std::array<std::vector<double>, all_phases.size()> phases;
  };

  void print(int threads, const std::vector<Sample>& transforms, bool json, bool first) const {
    const Row& row = rows_[threads - 1];
    const double cpu_ratio = threads == 1 ? median_ratio(row.steps, transforms, &Sample::cpu) : 0.0;
    const double wall_ratio = median_ratio(row.steps, transforms, &Sample::wall);
    double coupling = 0.0, all = 0.0;
    for (std::size_t p = 0; p < all_phases.size(); ++p) {
      all += lower_quartile(row.phases[p]);
      if (all_phases[p].is_coupling) coupling += lower_quartile(row.phases[p]);
    }
    const double gain = minimum(rows_[0].steps, &Sample::wall) / minimum(row.steps, &Sample::wall);
    std::printf(
        json ? "%s\n {\"cells\": %d, \"ratio\": %g, \"markers\": \"%s\", \"threads\": %d, \"step_wall_ms\": %.2f"
             : "%s%5d %5g %-16s %7d %9.2f",
        json && !first ? "," : "", cells_, ratio_, markers_.c_str(), threads, minimum(row.steps, &Sample::wall));
    for (std::size_t p = 0; p < all_phases.size(); ++p) {
      if (json) std::printf(", \"%s_ms\"", all_phases[p].name);
      std::printf(json ? ": %.2f" : " %11.2f", lower_quartile(row.phases[p]));
    }
    std::printf(
        json ? ", \"coupling_share\": %.3f, \"transforms_cpu_ms\": %.2f, \"cpu_ratio\": %.3f, \"wall_ratio\": %.3f, "
               "\"gain\": %.2f, \"allocations\": %ld}"
             : " %8.3f %10.2f %6.3f %6.3f %5.2f %11ld\n",
        coupling / all, minimum(transforms, &Sample::cpu), cpu_ratio, wall_ratio, gain, allocations_);
    std::fflush(stdout);
  }

  int cells_;
  double ratio_;
  std::string markers_;
  Simulation simulation_;
  long allocations_;
  std::array<Row, 2> rows_;  // with one and with two threads
};

// The number of allocations in all cases. They are counted with two threads: a team of one is allocated by the OpenMP runtime
// (libgomp) at every parallel region.
long measure(int cells, const std::vector<double>& ratios, const std::vector<std::string>& markers, int repetitions,
             bool json, bool& first) {
  FourTransforms reference(grid_of(parameters_of(cells, 1.0, MarkerMotion::euler)), FFTW_MEASURE);
  omp_set_num_threads(2);
  std::vector<std::unique_ptr<Case>> cases;
  for (const double ratio : ratios)
    for (const std::string& name : markers) cases.push_back(std::make_unique<Case>(cells, ratio, name));
  std::vector<Sample> transforms;
  for (int r = 0; r < repetitions; ++r) {
    transforms.push_back(reference.measure());
    for (const auto& c : cases) c->measure();
  }
  long allocations = 0;
  for (const auto& c : cases) {
    c->print(transforms, json, first);
    first = false;
    allocations += c->allocations();
  }
  return allocations;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes{64, 128};
  std::vector<double> ratios{1.0, 20.0};
  std::vector<std::string> markers{"euler", "shape_following"};
  int repetitions = 15;
  bool json = false;
  CLI::App app("Times of a coupled step, by phase");
  app.add_option("--cells", sizes, "cells along each axis")->check(CLI::Range(16, 512));
  app.add_option("--ratio", ratios, "viscosity ratios")->check(CLI::PositiveNumber);
  app.add_option("--markers", markers, "time.markers of a scene");
  app.add_option("--repetitions", repetitions, "interleaved repetitions of each measurement")
      ->check(CLI::PositiveNumber);
  app.add_flag("--json", json, "print JSON instead of a table");
  CLI11_PARSE(app, argc, argv);

  if (json) {
    std::printf("[");
  } else {
    std::printf(
        "Wall milliseconds: a step (least) and its phases (lower quartiles); share of membrane, spread, interpolate "
        "and mesh in these;\n"
        "the four pairs of transforms (least CPU, one thread); medians of the ratios step / transforms by CPU (one "
        "thread\n"
        "only) and by wall time; least step with one thread / least of these; allocations in two steps.\n"
        "%5s %5s %-16s %7s %9s",
        "cells", "ratio", "markers", "threads", "step");
    for (const Phase& phase : all_phases) std::printf(" %11s", phase.name);
    std::printf(" %8s %10s %6s %6s %5s %11s\n", "share", "transforms", "cpu", "wall", "gain", "allocations");
  }
  bool first = true;
  long allocations = 0;
  for (const int cells : sizes) allocations += measure(cells, ratios, markers, repetitions, json, first);
  if (json) std::printf("\n]\n");
  if (!vesiflow::test::allocations_are_counted()) std::fprintf(stderr, "allocations are not counted in this build\n");
  return allocations == 0 ? 0 : 1;
}
