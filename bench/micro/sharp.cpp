// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What a membrane and the grid do for each other, sharp and by the delta function, beside a step of the fluid: a sphere
// of radius 1 that moves through a periodic box of width 6, of 32, 64, 96 or 128 cells; one thread.
//   OMP_NUM_THREADS=1 build/release/bench/sharp
// `shape`: for a new shape; `force`: for a force on it, the jumps of the sharp membrane; `put`: what acts on the fluid;
// `read`: the velocity at the markers; `clear`; `all`: these one after the other, as in a step.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "coupling/marker_transfer.h"
#include "fluid/navier_stokes.h"
#include "transfer/sharp_transfer.h"
#include "vesicle/shapes.h"

namespace {

using namespace vesiflow;

fluid::Grid box(int cells) {
  return {{-3, -3, -3}, {3, 3, 3}, {cells, cells, cells}, {.periodic = {true, true, true}}};
}

/// Markers about as far apart as points of the grid.
vesicle::SphereGrid markers(int cells) {
  return vesicle::SphereGrid(std::max(32, cells / 2));
}

std::vector<vesicle::Surface> places_on_the_way(const vesicle::SphereGrid& mesh, double spacing) {
  std::vector<vesicle::Surface> places;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d centre = 0.13 * i * spacing * Eigen::Vector3d(1.0, 0.4, -0.7);
    places.emplace_back(mesh).update(vesicle::sphere(mesh, {.centre = centre}), vesicle::GeometryDetail::curvature);
  }
  return places;
}

vesicle::VectorField force_at(const vesicle::VectorField& x) {
  vesicle::VectorField force(x.rows(), 3);
  force.col(0) = x.col(0) * x.col(1) + 0.3 * x.col(2);
  force.col(1) = 0.5 - x.col(2).square() * x.col(0);
  force.col(2) = x.col(0).square() - x.col(1) + 0.2 * x.col(2) * x.col(1);
  return force;
}

struct Body {
  explicit Body(int cells)
      : grid(box(cells)),
        mesh(markers(cells)),
        places(places_on_the_way(mesh, grid.spacing(0))),
        force(force_at(places[0].positions())),
        at_markers(force),
        density(grid),
        velocity(grid),
        source(grid),
        delta(grid),
        sharp(grid, mesh, {}) {
    velocity.fill(0.5);
    for (int i = 0; i < 2; ++i) all_of_sharp();  // touches the pages
  }

  const vesicle::Surface& surface() const { return places[place]; }

  void shape_of_delta() {
    place = (place + 1) % places.size();
    delta.update(surface().positions());
  }
  void shape_of_sharp() {
    shape_of_delta();  // which spreads what lacks of the force
    sharp.update(surface());
  }
  void force_of_sharp() { sharp.set_force(force); }
  void put_delta() { delta.spread(force, surface().area_weight(), density); }
  void put_sharp() { sharp.add_to(density, source, delta); }
  void read_delta() { delta.interpolate(velocity, at_markers); }
  void read_sharp() { sharp.interpolate(velocity, at_markers); }
  void clear_delta() { delta.clear(density); }
  void clear_sharp() {
    delta.clear(density);
    sharp.clear(density, source);
  }
  void all_of_delta() {
    clear_delta();
    shape_of_delta();
    put_delta();
    read_delta();
  }
  void all_of_sharp() {
    clear_sharp();
    shape_of_sharp();
    force_of_sharp();
    put_sharp();
    read_sharp();
  }

  fluid::Grid grid;
  vesicle::SphereGrid mesh;
  std::vector<vesicle::Surface> places;
  std::size_t place = 0;
  vesicle::VectorField force, at_markers;
  fluid::FaceVector density, velocity;
  fluid::Field<fluid::Cell> source;
  coupling::MarkerTransfer delta;
  coupling::SharpTransfer sharp;
};

using Phase = void (Body::*)();

void measure(benchmark::State& state, Phase phase) {
  Body body(static_cast<int>(state.range(0)));
  for (auto _ : state) (body.*phase)();
}

void measure_clear(benchmark::State& state, Phase put, Phase clear) {
  Body body(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    state.PauseTiming();
    (body.*put)();
    state.ResumeTiming();
    (body.*clear)();
  }
}

void fluid_step(benchmark::State& state) {
  fluid::NavierStokes fluid(box(static_cast<int>(state.range(0))), {});
  fluid.step(1e-3);
  for (auto _ : state) fluid.step(1e-3);
}

const bool registered = [] {
  const auto with_sizes = [](benchmark::internal::Benchmark* one) {
    for (const int cells : {32, 64, 96, 128}) one->Arg(cells);
    one->Unit(benchmark::kMillisecond);
  };
  const std::pair<const char*, Phase> phases[] = {
      {"delta/shape", &Body::shape_of_delta}, {"sharp/shape", &Body::shape_of_sharp},
      {"sharp/force", &Body::force_of_sharp}, {"delta/put", &Body::put_delta},
      {"sharp/put", &Body::put_sharp},        {"delta/read", &Body::read_delta},
      {"sharp/read", &Body::read_sharp},      {"delta/all", &Body::all_of_delta},
      {"sharp/all", &Body::all_of_sharp}};
  for (const auto& [name, phase] : phases) with_sizes(benchmark::RegisterBenchmark(name, measure, phase));
  with_sizes(benchmark::RegisterBenchmark("delta/clear", measure_clear, &Body::put_delta, &Body::clear_delta));
  with_sizes(benchmark::RegisterBenchmark("sharp/clear", measure_clear, &Body::put_sharp, &Body::clear_sharp));
  with_sizes(benchmark::RegisterBenchmark("fluid/step", fluid_step));
  return true;
}();

}  // namespace
