#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace vesiflow::coupling {

/// Velocity of the markers at a given state; both are flat arrays of the same length.
using MarkerVelocity = std::function<void(std::span<const double> state, std::span<double> velocity)>;

/// Advances markers by dX/dt = U(X), X a flat array. Knows neither vesicle nor grid. Histories belong to the
/// integrator: it starts itself, starts afresh when the time step changes, and its history can be saved and restored.
class MarkerIntegrator {
 public:
  virtual ~MarkerIntegrator() = default;

  /// Replaces `state` at time t by the state at t + dt.
  virtual void advance(double dt, const MarkerVelocity& velocity, std::span<double> state) = 0;

  /// What a continued run needs besides the state; empty where there is nothing.
  virtual std::span<const double> history() const { return {}; }
  virtual void restore_history(double /*dt*/, std::span<const double> /*history*/) {}

  /// Forgets the history: it belongs to other markers. The next step starts afresh.
  virtual void restart() {}
};

/// Integrators a scene can name in `time.markers`.
inline constexpr std::string_view marker_integrators[] = {"euler", "ab2"};

/// "euler": X + dt U(X), the paper's Step 4, first order; stable for g = dt sigma0/(4 mu h) below 7 to 8.
/// "ab2":   X + dt (3/2 U^k - 1/2 U^{k-1}), second order, first step Euler; stable for about half of that g.
/// \throws std::invalid_argument for any other name
std::unique_ptr<MarkerIntegrator> make_marker_integrator(std::string_view name, std::size_t size);

}  // namespace vesiflow::coupling
