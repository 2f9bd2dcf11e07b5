// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The geometry of a surface and the parts of a membrane's step. Transforms alone: bench/sht.
//   OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive build/release/bench/membrane
#include <benchmark/benchmark.h>

#include "vesicle/membrane.h"
#include "vesicle/membrane_jumps.h"
#include "vesicle/shapes.h"

namespace {

using namespace vesiflow::vesicle;

struct Shape {
  explicit Shape(int latitudes) : surface(latitudes), positions(prolate(surface.grid(), 0.9)) {
    surface.update(positions, GeometryDetail::curvature);
  }
  Surface surface;
  VectorField positions;
};

void first_form(benchmark::State& state) {
  Shape shape(static_cast<int>(state.range(0)));
  for (auto _ : state) shape.surface.update(shape.positions);
}
void curvatures(benchmark::State& state) {
  Shape shape(static_cast<int>(state.range(0)));
  for (auto _ : state) shape.surface.update(shape.positions, GeometryDetail::curvature);
}

void laplacian_of_h(benchmark::State& state, LaplacianForm form, Upsampling upsampling) {
  Shape shape(static_cast<int>(state.range(0)));
  const LaplaceBeltrami laplacian(shape.surface.grid(), {form, upsampling, form == LaplacianForm::paper});
  ScalarField result;
  laplacian.of_mean_curvature(shape.surface, result);  // makes the tables
  for (auto _ : state) laplacian.of_mean_curvature(shape.surface, result);
}

void tension_force(benchmark::State& state) {
  Shape shape(static_cast<int>(state.range(0)));
  TensionForce tension({});
  VectorField force = shape.positions;
  tension.add_to(shape.surface, shape.surface.mean_curvature(), force);
  for (auto _ : state) tension.add_to(shape.surface, shape.surface.mean_curvature(), force);
}

Membrane membrane_of(int latitudes) {
  return {prolate(SphereGrid(latitudes), 0.9), latitudes, MembraneParameters{}};
}

void forces(benchmark::State& state) {
  Membrane membrane = membrane_of(static_cast<int>(state.range(0)));
  membrane.compute_force();
  for (auto _ : state) benchmark::DoNotOptimize(membrane.compute_force().data());
}
void velocity_filter(benchmark::State& state) {
  Membrane membrane = membrane_of(static_cast<int>(state.range(0)));
  const VectorField velocity = membrane.positions();
  VectorField filtered = velocity;
  membrane.filter_velocity(velocity, 1e-3, filtered);
  for (auto _ : state) membrane.filter_velocity(velocity, 1e-3, filtered);
}

void jumps_of_shape(benchmark::State& state) {
  Shape shape(static_cast<int>(state.range(0)));
  MembraneJumps jumps(shape.surface.grid());
  for (auto _ : state) jumps.update(shape.surface);
}
void jumps_of_force(benchmark::State& state) {
  Shape shape(static_cast<int>(state.range(0)));
  MembraneJumps jumps(shape.surface.grid());
  jumps.update(shape.surface);
  jumps.compute(shape.positions);
  for (auto _ : state) jumps.compute(shape.positions);
}
void jumps_of_force_and_velocity(benchmark::State& state) {
  Shape shape(static_cast<int>(state.range(0)));
  MembraneJumps jumps(shape.surface.grid());
  jumps.update(shape.surface);
  jumps.compute(shape.positions, shape.positions);
  for (auto _ : state) jumps.compute(shape.positions, shape.positions);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int latitudes : {32, 64, 128, 256}) benchmark->Arg(latitudes);
  benchmark->ArgName("latitudes")->Unit(benchmark::kMicrosecond);
}
BENCHMARK(first_form)->Apply(sizes);
BENCHMARK(curvatures)->Apply(sizes);
BENCHMARK_CAPTURE(laplacian_of_h, cartesian, LaplacianForm::cartesian, Upsampling::twice)->Apply(sizes);
BENCHMARK_CAPTURE(laplacian_of_h, cartesian_one_and_a_half, LaplacianForm::cartesian, Upsampling::three_halves)
    ->Apply(sizes);
BENCHMARK_CAPTURE(laplacian_of_h, christoffel, LaplacianForm::christoffel, Upsampling::twice)->Apply(sizes);
BENCHMARK_CAPTURE(laplacian_of_h, paper, LaplacianForm::paper, Upsampling::twice)->Apply(sizes);
BENCHMARK(tension_force)->Apply(sizes);
BENCHMARK(forces)->Apply(sizes);
BENCHMARK(velocity_filter)->Apply(sizes);
BENCHMARK(jumps_of_shape)->Apply(sizes);
BENCHMARK(jumps_of_force)->Apply(sizes);
BENCHMARK(jumps_of_force_and_velocity)->Apply(sizes);

}  // namespace
