// One coupled step of the tank-treading scene, by phase, for several resolutions and numbers of threads.
//   OMP_WAIT_POLICY=passive build/release/bench/step
// Counters are milliseconds per step. Compare them within one run: machines and their load differ.
#include <benchmark/benchmark.h>
#include <omp.h>

#include "coupling/simulation.h"

namespace {

using vesiflow::coupling::PhaseSeconds;

vesiflow::coupling::Scene scene_of(int cells, int latitudes) {
  vesiflow::coupling::Scene scene;
  scene.domain.cells.fill(cells);
  scene.mesh.latitudes = latitudes;
  scene.time.step = 1.0 / (3.0 * cells);
  scene.vesicles.resize(1);
  scene.vesicles[0].reduced_volume = 0.9;
  return scene;
}

void coupled_step(benchmark::State& state) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(static_cast<int>(state.range(2)));
  vesiflow::coupling::Simulation simulation(
      scene_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1))));
  for (int i = 0; i < 3; ++i) simulation.step();  // first step and histories
  const PhaseSeconds start = simulation.phase_seconds();
  for (auto _ : state) simulation.step();
  const PhaseSeconds end = simulation.phase_seconds();
  const auto counter = [&](const char* name, double PhaseSeconds::*phase) {
    state.counters[name] = 1e3 * (end.*phase - start.*phase) / static_cast<double>(state.iterations());
  };
  counter("membrane", &PhaseSeconds::membrane);
  counter("spread", &PhaseSeconds::spread);
  counter("convection", &PhaseSeconds::fluid_convection);
  counter("momentum", &PhaseSeconds::fluid_momentum);
  counter("projection", &PhaseSeconds::fluid_projection);
  counter("interpolate", &PhaseSeconds::interpolate);
  counter("mesh", &PhaseSeconds::mesh);
  omp_set_num_threads(before);
}

BENCHMARK(coupled_step)
    ->ArgNames({"cells", "latitudes", "threads"})
    ->Args({64, 32, 1})
    ->Args({64, 32, 2})
    ->Args({128, 64, 1})
    ->Args({128, 64, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
