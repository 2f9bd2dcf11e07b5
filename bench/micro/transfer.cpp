// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Spreading to and interpolating from the grid by each delta function: 8192 markers on 128^3, one thread.
//   build/release/bench/transfer
// The counter ns_per_marker is what a membrane pays per call. `weights` is MarkerTransfer::update. "periodic" is the same
// membrane around the corner of a periodic box.
#include <benchmark/benchmark.h>
#include <omp.h>

#include "coupling/marker_transfer.h"
#include "vesicle/shapes.h"

namespace {

using namespace vesiflow;
using coupling::DeltaKernel;
using coupling::MarkerTransfer;

enum class Box { walls, periodic };

struct Setting {
  explicit Setting(DeltaKernel kernel, Box box)
      : grid({-6, -6, -6}, {6, 6, 6}, {128, 128, 128},
             {box == Box::periodic, box == Box::periodic, box == Box::periodic}),
        markers(vesicle::prolate(vesicle::SphereGrid(64), 0.9)),
        force(markers),
        area(vesicle::ScalarField::Ones(markers.rows())),
        field(grid),
        transfer(grid, kernel) {
    if (box == Box::periodic) markers += 6.0;
    transfer.update(markers);
    transfer.spread(force, area, field);  // touches the pages
    before_ = omp_get_max_threads();
    omp_set_num_threads(1);
  }
  ~Setting() { omp_set_num_threads(before_); }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

  fluid::Grid grid;
  vesicle::VectorField markers, force;
  vesicle::ScalarField area;
  fluid::FaceVector field;
  MarkerTransfer transfer;

 private:
  int before_;
};

void count(benchmark::State& state, const Setting& setting) {
  state.counters["ns_per_marker"] =
      benchmark::Counter(1e-9 * static_cast<double>(setting.markers.rows()) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void weights(benchmark::State& state, DeltaKernel kernel, Box box) {
  Setting setting(kernel, box);
  for (auto _ : state) setting.transfer.update(setting.markers);
  count(state, setting);
}
void spread(benchmark::State& state, DeltaKernel kernel, Box box) {
  Setting setting(kernel, box);
  for (auto _ : state) setting.transfer.spread(setting.force, setting.area, setting.field);
  count(state, setting);
}
void interpolate(benchmark::State& state, DeltaKernel kernel, Box box) {
  Setting setting(kernel, box);
  vesicle::VectorField velocity = setting.markers;
  for (auto _ : state) setting.transfer.interpolate(setting.field, velocity);
  count(state, setting);
}
void clear(benchmark::State& state, DeltaKernel kernel, Box box) {
  Setting setting(kernel, box);
  setting.area.setZero();
  for (auto _ : state) {
    state.PauseTiming();
    setting.transfer.spread(setting.force, setting.area, setting.field);
    state.ResumeTiming();
    setting.transfer.clear(setting.field);
  }
  count(state, setting);
}

const bool registered = [] {
  using Function = void (*)(benchmark::State&, DeltaKernel, Box);
  const std::pair<const char*, Function> functions[] = {
      {"weights", weights}, {"spread", spread}, {"interpolate", interpolate}};
  for (const auto& [what, function] : functions)
    for (const DeltaKernel kernel : coupling::delta_kernels)
      benchmark::RegisterBenchmark((std::string(what) + "/" + std::string(name(kernel))).c_str(), function, kernel,
                                   Box::walls);
  for (const auto& [what, function] : functions)
    benchmark::RegisterBenchmark((std::string(what) + "/smoothed4/periodic").c_str(), function,
                                 DeltaKernel::smoothed_four_point, Box::periodic);
  for (const auto& [box, where] :
       {std::pair(Box::walls, "clear/smoothed4"), {Box::periodic, "clear/smoothed4/periodic"}})
    benchmark::RegisterBenchmark(where, clear, DeltaKernel::smoothed_four_point, box);
  return true;
}();

}  // namespace
