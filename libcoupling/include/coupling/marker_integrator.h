// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "coupling/export.h"
#include "coupling/marker_motion.h"

namespace vesiflow::coupling {

/// Velocity of the markers at a given state; both are flat arrays of the same length. `fraction` is the place in the
/// step, from 0 at its start to 1 at its end: one-stage methods ask at 1, where the fluid velocity is the newest.
using MarkerVelocity = std::function<void(double fraction, std::span<const double> state, std::span<double> velocity)>;

/// What the steps so far took.
struct MarkerStatistics {
  long sub_steps = 0;    ///< accepted ones; one in each step unless the integrator chooses its own
  long rejected = 0;     ///< sub-steps repeated for their error
  long evaluations = 0;  ///< of the velocity
};

/// Advances markers by dX/dt = U(t, X), X a flat array. Knows neither vesicle nor grid. Histories belong to the
/// integrator: it starts itself, follows a changing time step, and its history can be saved and restored.
class VESIFLOW_COUPLING_EXPORT MarkerIntegrator {
 public:
  virtual ~MarkerIntegrator() = default;

  /// Replaces `state` at time t by the state at t + dt. What `velocity` throws comes through, the state is then lost.
  /// \throws std::domain_error when the integrator fails.
  virtual void advance(double dt, const MarkerVelocity& velocity, std::span<double> state) = 0;

  /// What a continued run needs besides the state; empty where there is nothing.
  virtual std::span<const double> history() const { return {}; }
  /// Takes back a history. The first argument is the length of the step that left it, the second what history() gave.
  virtual void restore_history(double /*dt*/, std::span<const double> /*history*/) {}

  /// Forgets the history: it belongs to other markers. The next step starts afresh.
  virtual void restart() {}

  /// What the steps since construction took.
  virtual MarkerStatistics statistics() const = 0;
};

/// The motions that are by a MarkerIntegrator.
inline constexpr std::array marker_integrators{MarkerMotion::euler, MarkerMotion::ab2, MarkerMotion::arkode,
                                               MarkerMotion::strain_relaxation};

/// Tolerances of arkode: the local error of each sub-step is kept below relative |x| + absolute, root mean square over
/// the state.
struct MarkerTolerances {
  double relative = 0.0;   ///< not negative; 0 because positions have no natural origin
  double absolute = 1e-6;  ///< positive
};

/// Makes the integrator of a motion:
///
/// - euler: `X + dt U(X)`, the paper's Step 4, first order; stable for g = dt sigma0/(4 mu h) below 7 to 8;
/// - ab2: `X + dt [(1 + r/2) U^k - r/2 U^{k-1}]`, r = dt over the last dt; second order, first step Euler; stable for
///   about half of that g;
/// - arkode: explicit Runge-Kutta of order three with sub-steps of its own choice (Bogacki-Shampine, SUNDIALS'
///   ERKStep); no history;
/// - strain_relaxation: markers as euler, the rest is in the membrane.
///
/// \param size length of the state.
/// \param tolerances of arkode.
/// \throws std::invalid_argument for any other motion, for tolerances out of range, and for arkode in a build without
/// SUNDIALS.
VESIFLOW_COUPLING_EXPORT std::unique_ptr<MarkerIntegrator> make_marker_integrator(
    MarkerMotion motion, std::size_t size, const MarkerTolerances& tolerances = {});

/// Whether this build has arkode and implicit.
VESIFLOW_COUPLING_EXPORT bool have_sundials();

}  // namespace vesiflow::coupling
