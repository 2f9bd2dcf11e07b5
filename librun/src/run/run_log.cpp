// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_log.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace vesiflow::run {

void RunLog::say_step(SceneSimulation& simulation) {
  say_start(simulation);
  say_redistributions(simulation);
  progress_.update(simulation);
}

void RunLog::say_start(const SceneSimulation& simulation) {
  if (quiet_ || simulation.steps() != 1 || simulation.start_parts() == 0) return;
  progress_.finish();
  spdlog::info("shapes start far from rest: the first steps are taken in parts, the first of them in {}",
               simulation.start_parts());
}

void RunLog::say_redistributions(const SceneSimulation& simulation) {
  if (quiet_) return;
  for (const auto& [vesicle, report] : simulation.last_redistributions()) {
    progress_.finish();
    spdlog::info(
        "t = {:.6g}: markers of vesicle {} redistributed, aspect ratio {:.3g} -> {:.3g}, spectrum tail {:.1e} -> "
        "{:.1e}, off the old surface by at most {:.1e}",
        simulation.time(), vesicle, report.before.aspect_ratio, report.after.aspect_ratio, report.before.spectrum_tail,
        report.after.spectrum_tail, report.truncation);
  }
}

void RunLog::warn_of_noise(const SceneSimulation& simulation) {
  if (!warned_of_noise_ && !quiet_) {
    progress_.finish();
    spdlog::warn(
        "t = {:.4g}: the velocity of a membrane is more noise than limits.velocity_noise allows; checkpoints wait "
        "until it is less",
        simulation.time());
  }
  warned_of_noise_ = true;
}

void RunLog::warn_of_resolution(SceneSimulation& simulation) {
  constexpr long settling_steps = 10;
  if (warned_of_resolution_ || (simulation.steps() > 0 && simulation.steps() <= settling_steps)) return;
  std::size_t count = 0, worst = 0;
  vesicle::Resolution of_worst;
  for (std::size_t i = 0; i < simulation.vesicle_count(); ++i) {
    const vesicle::Resolution resolution = vesicle::resolution(simulation.membrane(i).surface());
    if (resolution.sufficient()) continue;
    if (count++ > 0 && !(resolution.unresolved > of_worst.unresolved)) continue;
    worst = i;
    of_worst = resolution;
  }
  if (count == 0) return;
  progress_.finish();
  spdlog::warn("vesicle {}{} at t = {:.4g}: {}; see mesh.latitudes", worst,
               count > 1 ? fmt::format(" and {} others", count - 1) : "", simulation.time(),
               vesicle::resolution_warning(of_worst));
  warned_of_resolution_ = true;
}

}  // namespace vesiflow::run
