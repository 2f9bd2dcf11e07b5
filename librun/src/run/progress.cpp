// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "standard_streams.h"

namespace vesiflow::run {
namespace {

std::string time_left(double seconds) {
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{}:{:02d} min", s / 60, s % 60);
  return fmt::format("{}:{:02d} h", s / 3600, s / 60 % 60);
}

std::string bar(double fraction) {
  constexpr int width = 24;
  const int full = std::clamp(static_cast<int>(fraction * width), 0, width);
  return fmt::format("[{:#<{}}{:.<{}}]", "", full, "", width - full);
}

// The vesicle that drifts most speaks for all.
std::string drift(SceneSimulation& simulation) {
  double area = 0.0, volume = 0.0;
  for (std::size_t i = 0; i < simulation.vesicle_count(); ++i) {
    const vesicle::Membrane& m = simulation.membrane(i);
    const double a = m.surface().area() / m.initial_area() - 1.0, v = m.surface().volume() / m.initial_volume() - 1.0;
    if (!(std::abs(a) <= std::abs(area))) area = a;
    if (!(std::abs(v) <= std::abs(volume))) volume = v;
  }
  return fmt::format("area {:+.1e}, volume {:+.1e}", area, volume);
}

// Of adaptive steps, whose number is not known, the present length instead.
std::string steps_in_all(const SceneSimulation& simulation) {
  const Scene& scene = simulation.scene();
  return scene.time.adaptive ? fmt::format(" of {:.2g}", simulation.time_step())
                             : fmt::format("/{}", simulation.last_step());
}

}  // namespace

Progress::Progress(bool quiet, const SceneSimulation& simulation)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      first_step_(simulation.steps()),
      first_time_(simulation.time()),
      start_(Clock::now()),
      last_shown_(start_) {}

void Progress::update(SceneSimulation& simulation) {
  if (quiet_) return;
  const Clock::time_point now = Clock::now();
  const bool last = simulation.finished();
  const auto interval = terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(5000);
  if (last || now - last_shown_ >= interval) show(simulation, now);
}

void Progress::show(SceneSimulation& simulation, Clock::time_point now) {
  last_shown_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double end = simulation.scene().time.end;
  const double per_step = seconds / static_cast<double>(simulation.steps() - first_step_);
  const double per_time = seconds / (simulation.time() - first_time_);
  const std::string text = fmt::format("step {}{}, t = {:.3f}, {:.3g} s/step, {} left, {}", simulation.steps(),
                                       steps_in_all(simulation), simulation.time(), per_step,
                                       time_left(per_time * std::max(0.0, end - simulation.time())), drift(simulation));
  if (terminal_) {
    const double fraction = std::min(1.0, simulation.time() / end);
    say(fmt::format("\r{} {:3.0f} % {}\033[K", bar(fraction), 100.0 * fraction, text));
    bar_shown_ = true;
  } else {
    say(text + "\n");
  }
}

void Progress::finish() {
  if (bar_shown_) say("\n");
  bar_shown_ = false;
}

}  // namespace vesiflow::run
