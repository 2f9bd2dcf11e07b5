// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// One run of a scene in memory, for studies of time integration: what it costs, how well it keeps area and volume, and its course.
//   OMP_NUM_THREADS=1 build/release/bench/integrators SCENE [--set key=value]... [--every T] [--steps N]
// Prints one JSON object. CPU seconds are those of the steps alone, over all threads. validation/studies/integrators.py makes the tables of
// validation/studies/integrators.md and validation/studies/tumbling.md with it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "run/errors.h"
#include "run/scene_simulation.h"
#include "support/timing.h"

namespace {

using namespace vesiflow::run;
using vesiflow::coupling::Phases, vesiflow::coupling::SimulationStopped, vesiflow::coupling::visit_phases;
using Json = nlohmann::ordered_json;

// Of the first vesicle.
class Course {
 public:
  void record(SceneSimulation& simulation) {
    const auto d = simulation.measure().at(0);
    const auto add = [this](const char* name, double value) { series_[name].push_back(value); };
    add("t", simulation.time());
    add("inclination", d.inclination_angle);
    add("frequency", d.tank_treading_frequency);
    add("reduced_volume", d.reduced_volume);
    add("area_error", d.area_error);
    add("volume_error", d.volume_error);
    add("local_area_error", d.max_local_area_error);
    add("surface_divergence", d.surface_divergence_max);
    add("spectrum_tail", d.spectrum_tail);
    add("mesh_aspect_ratio", d.mesh_aspect_ratio);
    add("tension_max", d.tension_max);
    for (const char* name : {"area_error", "volume_error", "local_area_error"}) {
      double& largest = largest_[name];
      largest = std::max(largest, std::abs(series_[name].back().get<double>()));
    }
  }

  Json series_;
  std::map<std::string, double> largest_;
};

Json phases_of(const Phases& phases) {
  Json all;
  visit_phases(phases, [&](const char* name, const auto& account) { all[name] = account.seconds; });
  return all;
}

Json run(const Scene& scene, double every, long most_steps) {
  SceneSimulation simulation(scene);
  Course course;
  double cpu = 0.0, next = every;
  Json result{{"status", "completed"}};
  try {
    while (!simulation.finished() && simulation.steps() < most_steps) {
      const double start = vesiflow::bench::seconds(CLOCK_PROCESS_CPUTIME_ID);
      simulation.step();
      cpu += vesiflow::bench::seconds(CLOCK_PROCESS_CPUTIME_ID) - start;
      if (simulation.time() < next - 1e-9) continue;
      course.record(simulation);
      next += every;
    }
  } catch (const SimulationStopped& stop) {
    result["status"] = "stopped";
    result["reason"] = std::string(stop.what()).substr(0, 200);
  }
  result["time"] = simulation.time();
  result["steps"] = simulation.steps();
  result["redistributions"] = simulation.redistributions(0);
  result["cpu_seconds"] = cpu;
  result["phase_wall_seconds"] = phases_of(simulation.phases());
  result["largest"] = course.largest_;
  result["series"] = course.series_;
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  std::string file;
  std::vector<std::string> overrides;
  double every = 0.5;
  long steps = std::numeric_limits<long>::max();
  CLI::App app{"Runs a scene in memory and prints its cost, its errors and its course as JSON."};
  app.add_option("scene", file, "scene file")->required();
  app.add_option("--set", overrides, "key=value, as in scenes")->take_all()->expected(1, -1);
  app.add_option("--every", every, "time between records")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--steps", steps, "no more steps than these")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    const Scene scene = load_scene(file, overrides);
    Json result{{"step", scene.time.step}, {"g", scene.tension_number()}};
    result.update(run(scene, every, steps));
    std::printf("%s\n", result.dump().c_str());
    return 0;
  } catch (const SceneError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
