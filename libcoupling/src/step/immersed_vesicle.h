// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "coupling/marker_transfer.h"
#include "coupling/phases.h"
#include "coupling/simulation_parameters.h"
#include "fluid/field.h"
#include "motion/membrane_motion.h"
#include "motion/mirror_symmetry.h"
#include "motion/thickness_correction.h"
#include "step/velocity_noise.h"
#include "transfer/sharp_transfer.h"
#include "vesicle/membrane.h"
#include "vesicle/redistribution.h"
#include "viscosity/interface_velocity.h"

namespace vesiflow::coupling {

/// One vesicle in the fluid: its membrane, the transfers between its markers and the grid, and how it moves.
struct ImmersedVesicle {
  /// As the parameters start it, or with a membrane to start from.
  ImmersedVesicle(const SimulationParameters& parameters, const Flow& flow, std::size_t number, const fluid::Grid& grid,
                  const vesicle::MembraneState* start = nullptr);

  /// Geometry and forces at the present state; looking at a vesicle between two steps costs the next step nothing, unless
  /// that predicts.
  void update();

  /// Geometry and forces at the state whose forces drive the step.
  void predict(double dt);

  /// Looks up where the membrane is on the grid, in steps of dt; whether others are so near that their markers read inside it.
  void meet_grid(double dt, bool has_neighbours = false);
  /// Takes off the grid what it has put there before.
  void clear(fluid::NavierStokes& fluid);
  /// Puts its force on it; with `correction`, also that which its motion corrects the fluid by.
  void put_force(fluid::NavierStokes& fluid, bool correction = false);

  /// The velocity of an interface of two viscosities from the fluid's, see InterfaceVelocity; returns how much it changes.
  double improve_interface(const fluid::FaceVector& velocity);

  /// To the end of the step, in the fluid velocities of its two ends. Keeps the accounts in `moving`.
  void advance(double dt, const fluid::FaceVector& previous_velocity, const fluid::FaceVector& velocity);

  /// Velocities at markers that no step has moved yet, in a velocity that no step has made yet: membranes have left no
  /// jumps in it.
  void meet_start(double dt, const fluid::FaceVector& velocity);
  /// The same in the velocity of a step.
  void interpolate(double dt, const fluid::FaceVector& velocity);

  /// Force per area on the fluid (markers x 3).
  const vesicle::VectorField& force() const { return total_force ? *total_force : membrane.force(); }

  /// That of the motion, left by a step of length dt; none if empty.
  void restore_history(double dt, std::span<const double> history);

  /// The velocity of an interface of two viscosities; empty where there is none.
  vesicle::VectorField interface_velocity() const { return two_phase ? two_phase->value() : vesicle::VectorField(); }
  vesicle::VectorField previous_interface_velocity() const {
    return two_phase ? two_phase->previous() : vesicle::VectorField();
  }
  /// To the markers of a new mesh.
  void carry_interface_velocity(const vesicle::MeshRedistribution& redistribution);
  /// \throws std::invalid_argument when there is none and should be, the other way round, or it is not finite.
  void restore_interface_velocity(const vesicle::VectorField& velocity, const vesicle::VectorField& previous);

  vesicle::Membrane membrane;
  MarkerTransfer transfer;
  std::optional<SharpTransfer> sharp;          ///< where it has no thickness
  MirrorSymmetry symmetry;                     ///< about planes that it lies across
  std::optional<InterfaceVelocity> two_phase;  ///< its velocity where the viscosity is another one inside, if sharp
  MarkerVelocities velocities;
  std::optional<vesicle::VectorField> total_force;  ///< of the membrane and from outside, if there are any from outside
  std::unique_ptr<MembraneMotion> motion;
  VelocityNoise noise;  ///< of velocities.membrane
  /// Of the last advance(): all of it under mesh, and what of it are interpolation and thickness correction.
  Phases moving;
  std::int64_t redistributions = 0;
  double area = 0.0, volume = 0.0;  ///< before an adaptive step
  /// Of the whole box, which the velocity of the fluid's solver lacks where some membrane is between two viscosities.
  fluid::Vector3 mean_flow{};
  bool is_current = false;  ///< whether geometry and forces are those of the membrane's state

 private:
  double more_reach(double dt) const;
  void read_sharp(const fluid::FaceVector& velocity, vesicle::VectorField& at_markers) const;

  std::optional<ThicknessCorrection> thickness_;
  vesicle::VectorField mean_velocity_;  // of both sides, of an interface of two viscosities
  vesicle::VectorField all_force_;      // with what the motion owes, where the membrane is sharp
  class FlowAtMarkers final : public VelocityAt {
   public:
    explicit FlowAtMarkers(ImmersedVesicle& vesicle) : vesicle_(vesicle) {}
    void operator()(const Positions& positions, vesicle::VectorField& velocity) const override;
    void operator()(double fraction, const Positions& positions, vesicle::VectorField& velocity) const override;

   private:
    ImmersedVesicle& vesicle_;
  };

  const fluid::FaceVector* previous_velocity_ = nullptr;
  const fluid::FaceVector* velocity_ = nullptr;
  vesicle::VectorField at_start_;  // of the step, where that is asked for
};

/// Degrees of the velocity that shapes the membrane of vesicle number i.
int moving_degrees(const SimulationParameters& parameters, std::size_t i);

}  // namespace vesiflow::coupling
