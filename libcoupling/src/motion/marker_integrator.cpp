// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/marker_integrator.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "motion/arkode_integrator.h"

namespace vesiflow::coupling {
namespace {

class Euler final : public MarkerIntegrator {
 public:
  explicit Euler(std::size_t size) : velocity_(size) {}

  void advance(double dt, const MarkerVelocity& velocity, std::span<double> state) override {
    velocity(1.0, state, velocity_);
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += dt * velocity_[i];
    ++steps_;
  }

  MarkerStatistics statistics() const override { return {steps_, 0, steps_}; }

 private:
  std::vector<double> velocity_;
  long steps_ = 0;
};

class AdamsBashforth2 final : public MarkerIntegrator {
 public:
  explicit AdamsBashforth2(std::size_t size) : velocity_(size), previous_(size) {}

  void advance(double dt, const MarkerVelocity& velocity, std::span<double> state) override {
    velocity(1.0, state, velocity_);
    if (previous_dt_ > 0.0) {
      const double half_ratio = 0.5 * dt / previous_dt_;
      for (std::size_t i = 0; i < state.size(); ++i)
        state[i] += dt * ((1.0 + half_ratio) * velocity_[i] - half_ratio * previous_[i]);
    } else {
      for (std::size_t i = 0; i < state.size(); ++i) state[i] += dt * velocity_[i];
    }
    std::swap(velocity_, previous_);
    previous_dt_ = dt;
    ++steps_;
  }

  std::span<const double> history() const override {
    if (previous_dt_ == 0.0) return {};
    return previous_;
  }

  void restore_history(double dt, std::span<const double> history) override {
    if (history.size() != previous_.size())
      throw std::invalid_argument("ab2: history of " + std::to_string(history.size()) + " values, expected " +
                                  std::to_string(previous_.size()));
    std::ranges::copy(history, previous_.begin());
    previous_dt_ = dt;
  }

  void restart() override { previous_dt_ = 0.0; }

  MarkerStatistics statistics() const override { return {steps_, 0, steps_}; }

 private:
  std::vector<double> velocity_, previous_;
  double previous_dt_ = 0.0;  // of the step that made previous_; 0 before the first
  long steps_ = 0;
};

}  // namespace

std::unique_ptr<MarkerIntegrator> make_marker_integrator(MarkerMotion motion, std::size_t size,
                                                         const MarkerTolerances& tolerances) {
  switch (motion) {
    case MarkerMotion::euler:
    case MarkerMotion::strain_relaxation:
      return std::make_unique<Euler>(size);
    case MarkerMotion::ab2:
      return std::make_unique<AdamsBashforth2>(size);
    case MarkerMotion::arkode:
      return make_arkode_integrator(size, tolerances);
    case MarkerMotion::shape_following:
    case MarkerMotion::implicit:
      break;
  }
  throw std::invalid_argument(
      "not a marker integrator: allowed are MarkerMotion::euler, ab2, arkode and strain_relaxation");
}

}  // namespace vesiflow::coupling
