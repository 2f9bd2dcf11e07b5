// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/plan_totals.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "plan/available_memory.h"
#include "plan/cost_model.h"
#include "plan/memory_plan.h"

namespace vesiflow::run {
namespace {

// Of the time of a step that more threads share. By Amdahl's law two threads gain 1.4, as was measured on grids from 64^3 cells and
// with several vesicles (docs/performance.md, how cost grows: 1.1 to 1.6).
constexpr double shared = 4.0 / 7.0;

// Of files: a row of the table, a marker and a cell of a snapshot; and the seven fields of a checkpoint, with what a marker has there.
constexpr double of_row = 370.0, of_marker = 108.0, of_cell = 16.0, of_restarted_marker = 130.0;

double checkpoint_bytes(const Scene& scene, double markers) {
  const auto& n = scene.domain.cells;
  return 7.0 * sizeof(double) * (n[0] + 2.0) * (n[1] + 2.0) * (n[2] + 2.0) + of_restarted_marker * markers;
}

std::string line(const char* label, const std::string& text) {
  return fmt::format("  {:<32}{}\n", label, text);
}

std::string against(double needed, double available, const std::string& of_what) {
  if (!std::isfinite(available)) return "";
  return fmt::format("; {} has {:.0f} MB{}", of_what, 1e-6 * available,
                     needed > available ? "  <- WARNING: too little" : "");
}

std::string describe_time(const Scene& scene, int threads) {
  double seconds = 0.0;
  for (const PhaseCost& cost : estimate_costs(scene)) seconds += cost.seconds;
  const double alone = seconds * planned_steps(scene);
  const int running = std::min(threads, omp_get_num_procs());
  std::string text = fmt::format("about {}", duration(alone * (1.0 - shared + shared / running)));
  text +=
      fmt::format(" by {}: {:.0f} steps of {} by one", running == 1 ? "one thread" : fmt::format("{} threads", running),
                  planned_steps(scene), duration(seconds));
  return text + (scene.time.adaptive ? ", if they stay as long as the first" : "");
}

// What the file system has free where the directory is, or its first ancestor that exists.
double free_bytes(std::filesystem::path directory) {
  std::error_code error;
  directory = std::filesystem::absolute(directory, error).lexically_normal();
  while (!std::filesystem::exists(directory, error) && directory != directory.root_path())
    directory = directory.parent_path();
  const std::filesystem::space_info space = std::filesystem::space(directory, error);
  return error ? INFINITY : static_cast<double>(space.available);
}

}  // namespace

std::string duration(double seconds) {
  constexpr double minute = 60.0, hour = 60.0 * minute, day = 24.0 * hour;
  if (seconds < 0.1) return fmt::format("{:.2g} ms", 1e3 * seconds);
  if (seconds < 1.5 * minute) return fmt::format("{:.2g} s", seconds);
  if (seconds < 1.5 * hour) return fmt::format("{:.2g} min", seconds / minute);
  return seconds < 2.0 * day ? fmt::format("{:.2g} h", seconds / hour) : fmt::format("{:.0f} days", seconds / day);
}

double output_bytes(const Scene& scene) {
  const Scene::Output& o = scene.output;
  const auto& n = scene.domain.cells;
  const double cells = 1.0 * n[0] * n[1] * n[2];
  double markers = 0.0;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) markers += 2.0 * scene.latitudes(i) * scene.latitudes(i);
  const double rows = times_due(scene, o.diagnostics_every, true) * static_cast<double>(scene.vesicles.size());
  const double checkpoints = o.checkpoint_every > 0.0 ? 2.0 * checkpoint_bytes(scene, markers) : 0.0;
  return of_row * rows + of_marker * markers * times_due(scene, o.vesicle_every, true) +
         of_cell * cells * times_due(scene, o.fluid_every, true) + checkpoints;
}

std::string describe_totals(const Scene& scene, int threads, const std::filesystem::path& directory) {
  const double memory = plan_memory(scene).total(), disk = output_bytes(scene);
  const AvailableMemory available = available_memory();
  return "In all\n" + line("time", describe_time(scene, threads)) +
         line("memory",
              fmt::format("about {:.0f} MB{}", 1e-6 * memory, against(memory, available.bytes, available.of))) +
         line("disk",
              fmt::format(
                  "about {} MB{}", disk < 1e8 ? fmt::format("{:.2g}", 1e-6 * disk) : fmt::format("{:.0f}", 1e-6 * disk),
                  against(disk, free_bytes(directory), fmt::format("the file system of {}", directory.string()))));
}

}  // namespace vesiflow::run
