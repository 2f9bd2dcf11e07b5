// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coupling/export.h"
#include "coupling/flow.h"
#include "coupling/marker_integrator.h"
#include "coupling/phases.h"
#include "coupling/simulation_parameters.h"
#include "fluid/navier_stokes.h"
#include "vesicle/diagnostics.h"
#include "vesicle/membrane.h"

namespace vesiflow::coupling {

/// A redistribution of the markers of one vesicle at the end of a step.
struct Redistribution {
  std::size_t vesicle = 0;               ///< number of the vesicle
  vesicle::RedistributionReport report;  ///< what was done
};

/// What a vesicle needs to go on as if the run had not been interrupted.
struct VesicleState {
  vesicle::MembraneState membrane;     ///< positions, areas, strain and tension
  std::vector<double> motion_history;  ///< history of what moves the markers
  std::int64_t redistributions = 0;    ///< their number since the start

  /// Velocity of the membrane (markers x 3) where it is sharp and between two viscosities, else empty: what its
  /// iteration begins with in the next step.
  vesicle::VectorField interface_velocity = {};
  vesicle::VectorField previous_interface_velocity = {};  ///< the same one step ago; empty if there was none

  /// Where there is inertia too: mu u inside, continued out of the membrane, in a box of the grid around it. The first point and the
  /// number of points along each axis, then the components as fields of such a grid hold them, with their ghosts. Else, and before
  /// the first step, empty. Now and at the times before of SimulationState::outer_velocities.
  std::vector<std::vector<double>> inner_velocities = {};
};
/// The end of another run that a simulation has started from, for the summary and for continued runs.
struct Start {
  std::string run;                                ///< the checkpoint that was read
  double time = 0.0;                              ///< time of the checkpoint
  std::int64_t steps = 0;                         ///< steps of the other run until then
  std::vector<vesicle::MembraneState> membranes;  ///< on the meshes of this simulation, at its t = 0
};
/// Everything a run needs to go on as if it had not been interrupted.
struct SimulationState {
  fluid::FaceVector velocity,          ///< velocity of the fluid as its solver has it, see fluid_velocity_of()
      previous_velocity;               ///< the same one step ago
  fluid::Field<fluid::Cell> pressure;  ///< pressure of the fluid
  fluid::FluidClock clock;             ///< times of the two velocities
  std::vector<VesicleState> vesicles;  ///< state of each vesicle
  std::vector<double> step_control;    ///< of adaptive steps, and of a start in parts; else empty
  std::shared_ptr<const Start> start;  ///< none where vesicles have started as the parameters say

  /// Sharp membranes between two viscosities in a fluid with inertia: the velocity of the outer fluid, continued into the
  /// membranes, now, one step ago and, but for thin insides and in the second step, two steps ago. Else, and before the first step,
  /// empty.
  std::vector<fluid::FaceVector> outer_velocities = {};
  /// The length of the step before the last one, where there are three of them; else zero.
  double earlier_step = 0.0;

  /// Sharp membranes between two viscosities in a box without walls, without inertia: what `velocity` lacks of being mu u, u
  /// of zero mean. Else zero.
  fluid::Vector3 mean_flow{};
};

/// The velocity of the fluid of a state, which SimulationState::velocity is but for sharp membranes between two
/// viscosities: see Simulation::fluid_velocity(), which knows where the membranes were in the last step, and not only
/// where they are now, of second order in the step next to it.
/// \throws std::invalid_argument when the state is not of the parameters.
VESIFLOW_COUPLING_EXPORT fluid::FaceVector fluid_velocity_of(const SimulationParameters& parameters,
                                                             const SimulationState& state);

/// A force of a program's own on the fluid at the markers of a vesicle, per area of the membrane: adds to `force`
/// (markers x 3). Called in each step, and in each evaluation of an implicit one, by one thread, with the geometry that
/// the membrane's own forces are of.
using MembraneForce =
    std::function<void(double time, std::size_t vesicle, const vesicle::Surface& surface, vesicle::VectorField& force)>;
/// A force of a program's own on the fluid, per volume, at a point and time. Called by one thread.
using FluidForce = std::function<fluid::Vector3(const fluid::Vector3& x, double time)>;

struct ImmersedVesicle;
class ExternalForces;
class ImplicitStep;
class StartControl;
class StepControl;
struct StepErrors;
class ViscosityContrast;
class PhaseInertia;
class PhysicalVelocity;
class BlowUpGuard;

/// Vesicles in a box of fluid: the coupled method of Lai & Seol, one step at a time.
class VESIFLOW_COUPLING_EXPORT Simulation {
 public:
  /// Vesicles as the parameters start them, in a flow.
  /// \throws ParameterError for what cannot be computed.
  Simulation(const SimulationParameters& parameters, const Flow& flow);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Adds a force on the membranes from the next step on. It is no part of checkpoints: a program that restarts adds it
  /// again.
  void add_force(MembraneForce force);
  /// Sets the force on the fluid from the next step on, evaluated at the faces of the grid in each step, or none
  /// (nullptr). Not in checkpoints.
  void set_fluid_force(FluidForce force);

  /// Takes one time step (Steps 1 to 5 of the paper), of length time.step or, if time.adaptive, as long as its errors
  /// allow: a step whose errors are too large is taken back and repeated, shorter. Every sixteenth step ends with a
  /// look at the meshes and, where one has passed a limit of `mesh`, its redistribution along the membrane. With
  /// markers that follow the shape, the first of equal steps are taken in parts where shapes start far from rest; each
  /// ends when it would have ended.
  /// \throws SimulationStopped when the state is not finite or grows by itself, a limit is passed or a marker meets a
  /// wall, with adaptive steps when that happens, or the errors are too large, at time.smallest_step: the state is then
  /// that before the step.
  void step();

  /// Whether time.end is reached.
  bool finished() const;
  /// Length of the last step; before the first step, the length of that one.
  double time_step() const;
  /// Number of the step that reaches time.end, if steps stay as long as they are. For equal steps.
  long last_step() const { return last_step_; }
  /// Takes steps of that length from now on: time.step of parameters() becomes dt. For equal steps.
  /// \throws std::invalid_argument when it is not positive and finite, or steps are adaptive.
  void set_time_step(double dt);
  /// Number of adaptive steps that were taken back.
  long rejected_steps() const { return rejected_steps_; }
  /// Parts in which equal steps were taken as shapes started far from rest (shape_following, implicit); 0 where they
  /// were whole.
  long start_parts() const;
  /// What moving the markers took.
  MarkerStatistics marker_statistics(std::size_t vesicle) const;

  double time() const { return fluid_.time(); }                                    ///< time of the state
  long steps() const { return static_cast<long>(fluid_.steps()) - extra_steps_; }  ///< number of steps since t = 0

  /// The parameters, with the time step of set_time_step().
  const SimulationParameters& parameters() const { return parameters_; }
  const Flow& flow() const { return flow_; }  ///< the flow

  /// Redistributions that the last step ended with.
  std::span<const Redistribution> last_redistributions() const { return last_redistributions_; }
  /// Their number since the start of the simulation.
  long redistributions(std::size_t vesicle) const;

  /// Measures of every vesicle at the present time.
  std::vector<vesicle::Diagnostics> measure();
  /// For each vesicle the least distance between its markers and those of any other, see nearest_distances().
  std::vector<double> nearest_distances() const;
  /// Greatest |div u| of the fluid; round-off when all is well.
  double max_divergence() const;

  /// The velocity u of the fluid now. It is that of fluid() but for sharp membranes between two viscosities, with which
  /// the fluid's solver has w = mu u: then it is w outside of the membranes, w/ratio at points of the grid inside, with
  /// the mean flow of fully periodic boxes, in an array that the next call of this and the next step overwrite.
  const fluid::FaceVector& fluid_velocity() const;
  /// The fluid as it is solved for; see fluid_velocity().
  const fluid::NavierStokes& fluid() const { return fluid_; }
  std::size_t vesicle_count() const { return vesicles_.size(); }  ///< number of vesicles

  /// Membrane with its geometry and forces at the present time.
  const vesicle::Membrane& membrane(std::size_t vesicle);
  /// Interpolated fluid velocity that moved the markers in the last step (markers x 3).
  const vesicle::VectorField& marker_velocity(std::size_t vesicle) const;
  /// Part of the membrane's velocity that changes from step to step and back: max |U_n - 2 U_(n-1) + U_(n-2)|/4 over
  /// the markers.
  double velocity_noise(std::size_t vesicle) const;
  /// Greatest speed of the membrane in the last step.
  double membrane_speed(std::size_t vesicle) const;
  /// Whether the noise of some membrane is above limits.velocity_noise: it may be the start of a blow-up.
  bool suspects_blow_up() const;
  /// Solves of the fluid in the last step for the velocities of sharp membranes between two viscosities, those of steps
  /// that were taken back included; 0 without such membranes.
  int interface_passes() const { return interface_passes_; }
  /// The field of viscosity that the fluid was solved with in the last step (1 before the first). nullptr where there is
  /// none: if it is 1 everywhere, and with sharp membranes, whose fluid is solved for mu u with viscosity 1.
  const fluid::Field<fluid::Cell>* viscosity() const;
  Phases phases() const;             ///< time that the phases of the steps have taken
  PartEntries part_entries() const;  ///< how often parts of them were entered

  /// Starts anew from the end of another run, see run::start_from(). For a simulation that has taken no step.
  /// \param start the membranes, one for each vesicle, in the place of those of the parameters.
  /// \param velocity of the fluid, on the grid of this simulation; its divergence-free part is taken.
  /// \param pressure of the fluid, on the same grid.
  /// \throws std::invalid_argument when sizes differ or a number is not finite.
  /// \throws std::domain_error for a membrane without a geometry.
  /// \throws SimulationStopped for a marker at a wall.
  void start(std::shared_ptr<const Start> start, const fluid::FaceVector& velocity,
             const fluid::Field<fluid::Cell>& pressure);
  /// The run it has started from, or nullptr.
  const Start* started_from() const { return start_.get(); }

  SimulationState state() const;  ///< what restore() takes

  /// Goes on from a state.
  /// \throws std::invalid_argument when the state belongs to another grid or mesh.
  void restore(const SimulationState& state);

 private:
  void make_vesicles();
  void take_step(double dt);
  void take_adaptive_step();
  bool try_step(double dt, std::string& failure);
  void take_start_step();
  bool try_part(double dt, double& change);
  double rate_of(std::size_t vesicle);
  void weigh_step(std::size_t vesicle, StepErrors& errors);
  void remember();
  void take_back();
  void solve_step(double dt);
  void compute_forces(double dt);
  void spread_forces(double dt);
  void clear_forces();
  void put_forces(bool correction = false);
  void put_fluid_force();
  void hold_the_fluid();
  void update_viscosity();
  void advance_fluid(double dt);
  void correct_fluid();
  void find_neighbours();
  void iterate_interfaces();
  double improve_interfaces();
  void prepare_inertia(double dt);
  void keep_phases();
  void restore_phases(const SimulationState& state);
  fluid::Vector3 mean_flow() const;
  void read_velocity(ImmersedVesicle& vesicle);
  void move_markers(double dt);
  void redistribute_markers();
  void check_limits(std::size_t vesicle) const;
  void check_mirrors(std::size_t vesicle) const;
  void check_growth();
  void plan_last_step();

  SimulationParameters parameters_;
  Flow flow_;
  std::unique_ptr<ViscosityContrast> contrast_;  // where there is one
  fluid::NavierStokes fluid_;
  std::shared_ptr<const Start> start_;
  std::vector<std::unique_ptr<ImmersedVesicle>> vesicles_;
  std::vector<MembraneForce> own_forces_;  // those that the program has added
  FluidForce fluid_force_;                 // the same
  std::unique_ptr<ExternalForces> external_forces_;
  std::map<int, vesicle::MeshRedistribution> redistributions_;  // by latitudes; none if none are wanted
  std::vector<Redistribution> last_redistributions_;
  Phases phases_;
  std::unique_ptr<ImplicitStep> implicit_step_;          // of time.markers = "implicit"
  std::unique_ptr<StepControl> step_control_;            // of adaptive steps
  std::unique_ptr<StartControl> start_control_;          // of equal steps that start in parts where they must
  std::vector<VesicleState> remembered_;                 // before the step that is tried
  std::vector<vesicle::ScalarField> curvatures_;         // the same, in a start
  std::unique_ptr<PhysicalVelocity> physical_velocity_;  // where it is not that of the fluid
  std::unique_ptr<PhaseInertia> phase_inertia_;          // where two viscosities and inertia meet, if sharp
  fluid::Vector3 mean_flow_{};                           // which the fluid's velocity lacks, of the last solve
  std::vector<std::vector<std::size_t>> neighbours_;  // of each sharp membrane, those that its markers may read inside
  int interface_passes_ = 0;                          // of the last step
  long extra_steps_ = 0;                              // of the fluid, by parts of steps
  long rejected_steps_ = 0;
  long last_step_ = 0;
  std::unique_ptr<BlowUpGuard> guard_;
};

}  // namespace vesiflow::coupling
