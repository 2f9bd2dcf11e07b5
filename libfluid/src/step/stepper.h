// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The state of NavierStokes and its time step.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "fluid/navier_stokes.h"
#include "operators/stencil.h"
#include "operators/step_passes.h"

namespace vesiflow::fluid {

// The velocity problem of a step: a u - mu Lap u, or the coupled operator where a field of viscosity is implicit.
// mu_reference is used where a field is explicit in part.
EllipticProblem momentum_problem(const Grid& grid, const FluidParameters& parameters, double a, double mu_reference);

// These options with single precision where they have fast transforms, if the precision is mixed.
SolverOptions in_precision(Precision precision, const EllipticProblem& problem, SolverOptions options);

class Stepper {
 public:
  Stepper(const Grid& grid, const FluidParameters& parameters, BoundaryVelocity boundary, WallMotion motion);

  void set_velocity(const std::function<Vector3(const Vector3&)>& function);
  void start_from(const FaceVector& velocity, const Field<Cell>& pressure);
  void restore(const FaceVector& velocity, const FaceVector& previous_velocity, const Field<Cell>& pressure,
               const FluidClock& clock);
  void step(double dt);
  void keep_force();
  void solve_again();
  void remember();
  void forget();
  void retry();
  std::string velocity_solver_name() const;

  Grid grid;
  FluidParameters parameters;
  WallVelocity walls;
  FaceVector velocity, previous, force;
  Vector3 uniform_force{};
  std::optional<Field<Cell>> source;            // of the divergence, where a program has asked for it
  std::optional<Field<Cell>> given_divergence;  // and what div u is by it: without the mean
  Field<Cell> pressure;
  FluidClock clock;
  FluidTimings timings;
  FluidReport report;
  std::unique_ptr<EllipticSolver> velocity_solver, pressure_solver;

 private:
  // What a step overwrites; it leaves the velocity that it starts from.
  struct Remembered {
    FaceVector previous;
    Field<Cell> pressure;
    FluidClock clock;
  };
  // What solve_again() starts from where there is inertia.
  struct Driven {
    FaceVector
        force;  // at inner faces, else zero: of the last step; while that is solved again, the change of the velocity
    Vector3 uniform_force{};
    long step = -1;        // whose forces they are
    WallVelocity at_rest;  // the walls of a change
  };

  bool variable_viscosity() const { return !parameters.viscosity.is_constant(); }
  double previous_step() const { return clock.steps > 0 ? clock.time_step : 0.0; }
  bool implicit_stress() const {
    return variable_viscosity() && parameters.viscous_treatment == ViscousTreatment::implicit;
  }
  // Whether the velocity solve is for the change of the velocity.
  bool solves_for_change() const { return parameters.precision == Precision::mixed && !implicit_stress(); }
  void advance_with_inertia(double dt);
  void extrapolate_and_solve_stokes(double dt);
  void solve_stokes(FaceVector& solution);
  void add_change();
  void check_given();
  void give_divergence();
  void believe_divergence();
  void start();
  void make_divergence_free();
  void recompute_convection();
  void update_velocity_solver(double a);
  void form_right_hand_side(const StepCoefficients& coefficients, double dt);
  void add_explicit_stress();
  void solve_momentum();
  void solve_pressure();
  void finish(FaceVector& u);

  CoefficientView unit_, viscosity_;
  double reference_viscosity_ = 0.0;        // mu, or its largest value
  std::optional<FaceVector> convection_;    // N(previous velocity), if there is convection
  std::optional<FaceVector> extrapolated_;  // velocity at the new time, if a field of viscosity needs it
  std::optional<FaceVector> lift_;          // zero but for walls and ghosts, if the stress is implicit
  std::optional<StokesSolver> stokes_;      // if there is no inertia
  Field<Cell> chi_;                         // what is too much of the divergence, and the potential that takes it away
  double source_mean_ = 0.0;
  std::optional<Remembered> remembered_;
  std::optional<Driven> driven_;
  bool is_remembered_ = false;  // whether remembered_ is of this run, and not of one before set_velocity() or restore()
};

}  // namespace vesiflow::fluid
