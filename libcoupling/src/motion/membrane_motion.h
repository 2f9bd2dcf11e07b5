// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "coupling/flow.h"
#include "coupling/marker_integrator.h"
#include "vesicle/membrane.h"

namespace vesiflow::coupling {

/// Interpolates the fluid velocity: U at the given positions, both of shape (markers, 3).
class VelocityAt {
 public:
  using Positions = Eigen::Ref<const vesicle::VectorField>;

  virtual ~VelocityAt() = default;
  /// At the new time, the end of the step.
  virtual void operator()(const Positions& positions, vesicle::VectorField& velocity) const = 0;
  /// Within the step, linear in time from its start (fraction 0) to its end (1).
  virtual void operator()(double fraction, const Positions& positions, vesicle::VectorField& velocity) const = 0;
};

/// Velocities at the markers, shape (markers, 3).
struct MarkerVelocities {
  vesicle::VectorField fluid;     ///< U, interpolated
  vesicle::VectorField membrane;  ///< U~, with the degrees that this motion keeps of it: what strains the membrane
};

/// Parts of a motion that parameters can switch off, and how often they were entered.
struct MotionEntries {
  std::int64_t strain = 0, conservation = 0;
};

/// How one membrane and its mesh move through a step (Steps 4 and 5 of the paper):
///   predict(dt, membrane);  forces at the predicted state, fluid;  advance(dt, velocity_at, membrane, velocities).
/// Knows a membrane but no grid. Histories belong to the motion: it starts itself, and they can be saved and restored.
class MembraneMotion {
 public:
  virtual ~MembraneMotion() = default;

  /// Brings the membrane to the state whose forces drive the fluid in the coming step of length dt. Returns false if
  /// that is the one it is in: the forces are those of the start of the step.
  virtual bool predict(double /*dt*/, vesicle::Membrane& /*membrane*/) { return false; }

  /// Takes the membrane to the end of the step, its geometry being that of the predicted state and the fluid velocity
  /// that of the new time. Leaves in `velocities` those that it used.
  /// \throws std::domain_error when the result is not usable
  virtual void advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
                       MarkerVelocities& velocities) = 0;

  /// Force per area, shape (markers, 3), that the fluid must feel in the coming step beside that of the predicted
  /// state: what past corrections of this motion owe to its momentum. Null if nothing.
  virtual const vesicle::VectorField* owed_force() const { return nullptr; }

  /// Force per area, shape (markers, 3) of the predicted state, that the implicit terms of the last advance() stand for:
  /// with it the fluid would have moved the membrane as it has been moved. Null where the fluid is not to hear of it,
  /// or hears of it later (owed_force).
  virtual const vesicle::VectorField* correcting_force() const { return nullptr; }

  /// U~ of an interpolated U at the membrane's present state, before any step has made it.
  virtual void mesh_velocity(double dt, vesicle::Membrane& membrane, MarkerVelocities& velocities) = 0;

  /// Error of the positions that the last step added, root mean square over the markers; nothing where it is not
  /// known, as in a first step. What adaptive steps are chosen by.
  virtual std::optional<double> position_error() const { return std::nullopt; }

  /// How often the motion has followed the strain, and kept volume and area, by itself: beside what the membrane has
  /// counted.
  virtual MotionEntries entries() const { return {}; }

  /// What moving the markers took so far.
  virtual MarkerStatistics statistics() const { return {}; }

  /// What a continued run needs besides the membrane's state; empty where there is nothing. `dt` is the length of the
  /// step that left it.
  virtual std::span<const double> history() const { return {}; }
  virtual void restore_history(double /*dt*/, std::span<const double> /*history*/) {}

  /// Forgets the history: it belongs to other markers. The next step starts afresh.
  virtual void restart() {}
};

}  // namespace vesiflow::coupling
