// Spherical-harmonic transforms and the parts of a membrane's step, single-threaded.
//   build/release/bench/membrane
// Times are per call; `per_field` is microseconds per scalar field of a transform of three.
#include <benchmark/benchmark.h>

#include "vesicle/membrane.h"
#include "vesicle/shapes.h"
#include "vesicle/spherical_harmonics.h"

namespace {

using namespace vesiflow::vesicle;

struct Transform {
  explicit Transform(int latitudes)
      : grid(latitudes),
        harmonics(latitudes, grid),
        coefficients(latitudes, 3),
        field(prolate(grid, 0.9)),
        first(field),
        second(field) {
    harmonics.analysis(field, coefficients);
  }
  SphereGrid grid;
  SphericalHarmonics harmonics;
  Coefficients coefficients;
  VectorField field, first, second;
};

void set_per_field(benchmark::State& state) {
  state.counters["per_field"] = benchmark::Counter(3e-6 * static_cast<double>(state.iterations()),
                                                   benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void analysis(benchmark::State& state) {
  Transform t(static_cast<int>(state.range(0)));
  for (auto _ : state) t.harmonics.analysis(t.field, t.coefficients);
  set_per_field(state);
}
void synthesis(benchmark::State& state) {
  Transform t(static_cast<int>(state.range(0)));
  for (auto _ : state) t.harmonics.synthesis(t.coefficients, t.first);
  set_per_field(state);
}
void gradient(benchmark::State& state) {
  Transform t(static_cast<int>(state.range(0)));
  for (auto _ : state) t.harmonics.gradient(t.coefficients, t.first, t.second);
  set_per_field(state);
}

Membrane membrane_of(int latitudes) {
  return {prolate(SphereGrid(latitudes), 0.9), latitudes, MembraneParameters{}};
}

void geometry(benchmark::State& state) {
  Membrane membrane = membrane_of(static_cast<int>(state.range(0)));
  for (auto _ : state) membrane.update_geometry();
}
void forces(benchmark::State& state) {
  Membrane membrane = membrane_of(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(membrane.compute_force().data());
}
void velocity_filter(benchmark::State& state) {
  Membrane membrane = membrane_of(static_cast<int>(state.range(0)));
  const VectorField velocity = membrane.positions();
  VectorField filtered = velocity;
  for (auto _ : state) membrane.filter_velocity(velocity, 1e-3, filtered);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int latitudes : {32, 64, 128}) benchmark->Arg(latitudes);
  benchmark->ArgName("latitudes")->Unit(benchmark::kMicrosecond);
}
BENCHMARK(analysis)->Apply(sizes);
BENCHMARK(synthesis)->Apply(sizes);
BENCHMARK(gradient)->Apply(sizes);
BENCHMARK(geometry)->Apply(sizes);
BENCHMARK(forces)->Apply(sizes);
BENCHMARK(velocity_filter)->Apply(sizes);

}  // namespace
