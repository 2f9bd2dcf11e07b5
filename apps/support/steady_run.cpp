// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "steady_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "program.h"
#include "streams.h"

using namespace vesiflow::fluid;

namespace {

// The change and the time step are looked at every so many steps.
constexpr std::int64_t interval = 10;
constexpr double seconds_between_reports = 1.0;
constexpr double usual_speed = 1.0, impossible_speed = 100.0;

class WallClock {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Estimates the time left from the decay of the change since the first report: it is exponential on the whole, with waves.
class Progress {
 public:
  Progress(const SteadyOptions& options, double start) : options_(options), start_(start) {}

  void report(double time, double change, double seconds) {
    if (!options_.progress || seconds < next_) return;
    next_ = seconds + seconds_between_reports;
    double left = options_.end - time;
    if (first_change_ > change && change > 0) {
      const double decay = std::log(first_change_ / change) / (time - first_time_);
      left = std::min(left, std::log(std::max(1.0, change / options_.tolerance)) / decay);
    }
    if (first_change_ == 0) {
      first_time_ = time;
      first_change_ = change;
    }
    say("\r  t = {:<9.4g} change {:.2e}, steady at {:.0e}; about {:.0f} s left   ", time, change, options_.tolerance,
        left * seconds / (time - start_));
    shown_ = true;
  }
  ~Progress() {
    if (shown_) say("\n");
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

 private:
  const SteadyOptions& options_;
  double start_, first_time_ = 0;
  double first_change_ = 0, next_ = seconds_between_reports;
  bool shown_ = false;
};

// Keeps the present step as long as it is allowed and not much too short: another one costs the solver an update.
double choose_time_step(const SteadyOptions& options, const FaceVector& velocity, double present) {
  if (options.time_step) return *options.time_step;
  const double rate = std::max(courant_rate(velocity), usual_speed / velocity.grid().min_spacing());
  const double allowed = std::min(options.courant_number / rate, options.largest_time_step);
  if (present > 0.7 * allowed && present <= allowed) return present;
  const double chosen = std::min(0.9 * allowed, options.largest_time_step);
  return present > 0 ? std::min(chosen, 2 * present) : chosen;  // BDF2 is unstable in steps that grow faster
}

void check_bounded(const NavierStokes& fluid, const SteadyRun& run) {
  if (courant_rate(fluid.velocity()) * fluid.grid().min_spacing() < 3 * impossible_speed) return;
  throw Stopped(
      fmt::format("the velocity has passed {} at time {:g} with time step {:g}: take a smaller --time-step or "
                  "--courant-number, or more cells",
                  impossible_speed, fluid.time(), run.time_step));
}

}  // namespace

double courant_rate(const FaceVector& velocity) {
  const Grid& grid = velocity.grid();
  const std::array<ConstView, 3> u = velocity.points();
  double largest = 0;
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i) {
        const double x = std::max(std::abs(u[0](i, j, k)), std::abs(u[0](i + 1, j, k)));
        const double y = std::max(std::abs(u[1](i, j, k)), std::abs(u[1](i, j + 1, k)));
        const double z = std::max(std::abs(u[2](i, j, k)), std::abs(u[2](i, j, k + 1)));
        largest = std::max(largest, x / grid.spacing(0) + y / grid.spacing(1) + z / grid.spacing(2));
      }
  return largest;
}

double max_difference(const FaceVector& a, const FaceVector& b) {
  double largest = 0;
  for (int component = 0; component < 3; ++component) {
    const ConstView x = a.points()[component], y = b.points()[component];
    for (int k = 0; k < x.extent[2]; ++k)
      for (int j = 0; j < x.extent[1]; ++j)
        for (int i = 0; i < x.extent[0]; ++i) largest = std::max(largest, std::abs(x(i, j, k) - y(i, j, k)));
  }
  return largest;
}

SteadyRun run_to_steady_state(NavierStokes& fluid, const SteadyOptions& options) {
  const WallClock clock;
  Progress progress(options, fluid.time());
  SteadyRun run;
  while (!run.steady && fluid.time() < options.end) {
    if (run.steps % interval == 0) run.time_step = choose_time_step(options, fluid.velocity(), run.time_step);
    fluid.step(run.time_step);
    ++run.steps;
    if (run.steps % interval == 0 || fluid.time() >= options.end) {
      run.change = max_difference(fluid.velocity(), fluid.previous_velocity()) / run.time_step * options.time_scale;
      run.steady = run.change <= options.tolerance;
      check_bounded(fluid, run);
      progress.report(fluid.time(), run.change, clock.seconds());
    }
  }
  run.time = fluid.time();
  run.seconds = clock.seconds();
  return run;
}
