// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "step/step_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/flow.h"
#include "coupling/validity.h"

namespace vesiflow::coupling {
namespace {

constexpr double safety = 0.9;
constexpr double largest_growth = 1.5, smallest_growth = 0.2;
constexpr double kept_above = 0.9, kept_below = 1.1;  // factors that are not worth a change
constexpr double after_failure = 0.25;                // nothing is known of the error then

// Nothing is known of the error of the first step: it should at least be stable.
double first_step(const SimulationParameters& parameters, const Flow& flow) {
  const double stable = 0.5 * parameters.stable_tension_number();
  const double shortening =
      std::isfinite(stable) ? std::min(1.0, stable / std::max(parameters.tension_number(), stable)) : 1.0;
  return std::max(parameters.time.smallest_step,
                  std::min(parameters.time.step * shortening, stable_convection_step(parameters, flow)));
}

}  // namespace

StepControl::StepControl(const SimulationParameters& parameters, const Flow& flow)
    : tolerance_(parameters.time.tolerance),
      area_limit_(parameters.limits.area_error),
      volume_limit_(parameters.limits.volume_error),
      smallest_(parameters.time.smallest_step),
      largest_(std::max(smallest_, std::min(parameters.time.largest_step, stable_convection_step(parameters, flow)))),
      end_(parameters.time.end),
      step_(first_step(parameters, flow)) {}

double StepControl::next(double time) const {
  const double rest = end_ - time;
  if (!(rest > 0.0) || step_ <= 0.5 * rest) return step_;
  return step_ < rest ? 0.5 * rest : rest;
}

bool StepControl::accepts(double dt, const StepErrors& errors) {
  double ratio = 0.0;
  bool finite = true;
  const auto weigh = [&](double error, double limit, const char* what) {
    finite = finite && std::isfinite(error);
    if (!(error / limit > ratio)) return;
    ratio = error / limit;
    reason_ = fmt::format("the {} {:.3g} where {:.3g} is allowed", what, error, limit);
  };
  if (errors.position) weigh(*errors.position, tolerance_, "position error is");
  weigh(errors.area_change, area_limit_, "area changes by");
  weigh(errors.volume_change, volume_limit_, "volume changes by");
  if (!finite) {
    fail(dt);
    return false;
  }
  if (ratio > 1.0) {
    step_ = std::max(smallest_, dt * std::clamp(safety / std::sqrt(ratio), smallest_growth, safety));
    may_grow_ = false;
    return false;
  }
  if (!errors.position) {  // as in a start: nothing says that the next step may be longer
    may_grow_ = true;
    return true;
  }
  constexpr double least = 1e-6;  // of e, below which steps grow at the largest rate anyhow
  ratio = std::max(ratio, least);
  const double factor = safety * std::pow(ratio, -0.35) * std::pow(last_ratio_, 0.2);
  const double bounded = std::clamp(factor, smallest_growth, may_grow_ ? largest_growth : 1.0);
  // A step that was shortened to end on time.end says little of the longer one.
  if (dt >= step_ && !(bounded >= kept_above && bounded <= kept_below)) step_ = dt * bounded;
  step_ = std::clamp(step_, smallest_, largest_);
  last_ratio_ = ratio;
  may_grow_ = true;
  return true;
}

void StepControl::fail(double dt) {
  step_ = std::max(smallest_, after_failure * dt);
  may_grow_ = false;
}

void StepControl::restore(std::span<const double> state) {
  if (state.size() != 3 || !(state[0] > 0.0) || !(state[1] > 0.0) || !std::isfinite(state[0]) ||
      !std::isfinite(state[1]))
    throw std::invalid_argument("the state of the step control is not one");
  step_ = state[0];
  last_ratio_ = state[1];
  may_grow_ = state[2] != 0.0;
}

}  // namespace vesiflow::coupling
