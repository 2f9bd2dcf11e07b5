// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "fluid/boundary.h"
#include "fluid/elliptic_solver.h"
#include "fluid/export.h"
#include "fluid/field.h"
#include "fluid/grid.h"
#include "fluid/phase_account.h"
#include "fluid/stokes.h"
#include "fluid/viscosity.h"

namespace vesiflow::fluid {

class Stepper;

/// Which terms of Re [du/dt + (u.grad)u] are kept. Nothing is spent on what is left out.
enum class Inertia {
  full,      ///< both
  unsteady,  ///< the first (unsteady Stokes)
  none       ///< none (quasi-steady Stokes flow: every step is a Stokes problem by itself)
};

/// How the viscous term div(mu (grad u + grad u^T)) is taken where mu is a field; mu_ref is its largest value.
///
/// At Reynolds numbers of 1e-3 the pressure, which lags by a step, limits all three: take inertia = none there, which
/// treats the stress implicitly always. Measured: validation/studies/viscosity_treatments.md.
enum class ViscousTreatment {
  /// mu_ref Lap u* + div((mu - mu_ref)(grad u^k + grad u^k^T)), the paper's: an error O(ratio dt)
  explicit_,
  /// the same with (1+r) u^k - r u^{k-1} in the place of u^k: second order where inertia counts; with steps above about
  /// 1 / (10 sqrt(ratio)) its errors ring, and are larger than those of explicit_
  extrapolated,
  /// div(mu (grad u* + grad u*^T)): a coupled solve, by a variable-coefficient solver; for large steps
  implicit
};

/// In which numbers the velocity of a step is solved for.
enum class Precision {
  double_,  ///< double precision

  /// Single precision within fast transforms, for what changes: the solve is for u* - u^k, from a residual in double
  /// precision. All else stays double, the pressure too: its second derivatives would turn round-off of single
  /// precision into divergence, and it is a quarter of the solves only. Errors: docs/performance.md
  mixed
};
/// The names, by Precision.
inline constexpr std::array<std::string_view, 2> precision_names{"double", "mixed"};

/// The fluid, and how its equations are solved.
struct FluidParameters {
  double reynolds_number = 1.0;  ///< Re

  /// mu, in units of the reference viscosity. The values of a field are read in every step, ghosts included: the owner
  /// may change them between steps.
  Viscosity viscosity = 1.0;
  ViscousTreatment viscous_treatment = ViscousTreatment::extrapolated;  ///< read where viscosity is a field
  Inertia inertia = Inertia::full;                                      ///< terms that are kept
  SolverOptions pressure_solver = FftOptions{};                         ///< for the pressure correction
  SolverOptions velocity_solver = AutoOptions{};                        ///< for the velocity
  Precision precision = Precision::double_;  ///< of the velocity solve; mixed is of steps with inertia
  StokesOptions stokes = {};  ///< of inertia = none, which uses neither of the two solvers above in its steps
};

/// The time levels of a state: velocity() is at time, previous_velocity() at previous_time.
struct FluidClock {
  double time = 0.0;           ///< time of velocity() and pressure()
  double previous_time = 0.0;  ///< time of previous_velocity()
  double time_step = 0.0;      ///< length of the last step (zero before the first)
  std::int64_t steps = 0;      ///< number of steps
};

/// What the steps have taken since construction.
struct FluidTimings {
  PhaseAccount convection;  ///< the explicit right-hand side, convection included
  PhaseAccount viscous;     ///< what a field of viscosity costs beside its solves: explicit term, updates of the solver
  PhaseAccount momentum;    ///< the velocity solve
  PhaseAccount projection;  ///< divergence, pressure solve, correction, walls
};

/// The solves of the last step.
struct FluidReport {
  SolveReport momentum,  ///< velocity solve
      pressure;          ///< pressure solve
  StokesReport stokes;   ///< if inertia = none, instead of the two
};

/// Incompressible Navier-Stokes equations in a box: semi-implicit BDF2 with rotational incremental pressure correction.
///
/// Solves
///
///     Re [du/dt + (u.grad)u] = -grad p + div(mu (grad u + grad u^T)) + f,   div u = 0,
///
/// u given on the walls, all fields repeating across periodic axes and symmetric about mirrors (Grid).
///
/// One step (paper, Section 3.3, Step 3; Guermond, Minev & Shen 2006, doi:10.1016/j.cma.2005.10.010), equal steps:
///
///     Re [(3u* - 4u^k + u^{k-1}) / (2dt) + 2N(u^k) - N(u^{k-1})] = -grad p^k + mu Lap u* + f,
///     u* = u^{k+1} on the walls,   Lap phi = a div u*,   a = 3Re / (2dt),
///     u^{k+1} = u* - grad phi / a,   p^{k+1} = p^k + phi - mu div u*
///
/// with N = convection(). The step may change: the coefficients are those of variable-step BDF2 (stable while it grows
/// by less than a factor 1 + sqrt 2 at a time), with r = dt / previous dt
///
///     [(1+2r)/(1+r) u* - (1+r) u^k + r^2/(1+r) u^{k-1}] / dt,   (1+r) N(u^k) - r N(u^{k-1}),
///     a = Re (1+2r) / ((1+r) dt).
///
/// The first step is backward Euler: `Re [(u* - u^0)/dt + N(u^0)]`, a = Re / dt. The pressure starts at zero, and its
/// mean stays zero.
///
/// With a field mu the viscous term is that of ViscousTreatment, and the last term of the pressure is -mu_ref div u* if
/// it is explicit in part, -mu div u* if it is implicit. For dt to infinity or Re to 0 the latter is a Richardson
/// iteration
///
///     p <- p - mu D L^-1 (...)
///
/// on the Stokes problem. As (div v)^2 <= 3 |grad v + grad v^T|^2 / 4 in every cell, the eigenvalues of mu D L^-1 G are
/// at most 3/2, and it converges whatever the ratio of viscosities; with 2 mu, which is exact where mu is constant,
/// they reach 3, and it does not (seen to blow up at ratio 20, Re = 1e-3).
///
/// With inertia = none a step solves `-div(mu (grad u + grad u^T)) + grad p = f`, div u = 0 with the force given and
/// the walls at the new time (StokesSolver, from the extrapolated velocity and the last pressure).
///
/// Where a program states a divergence, div u = r (divergence_source()), r takes its place in all of this: Lap phi = a
/// (div u* - r), and p^{k+1} = p^k + phi - mu (div u* - r). N is (u.grad)u + r u / 2 then. The viscous term of a number
/// mu is mu Lap u; the stress has mu grad r beside it, which a pressure that is higher by mu r would balance.
///
/// Second order in space and, for u, in time. div u = 0, or what was stated, to round-off. Same bits for every number of
/// threads.
class VESIFLOW_FLUID_EXPORT NavierStokes {
 public:
  /// At rest inside, moving as told on the walls (if there are any), at time zero. The velocity solver is made, or
  /// refused, in the first step.
  /// \throws std::invalid_argument for parameters out of range, wall data with a net flux (WallVelocity), a pressure
  /// solver that is not available, and a grid that would take more memory than the machine has.
  NavierStokes(const Grid& grid, const FluidParameters& parameters, BoundaryVelocity boundary = nullptr,
               WallMotion motion = WallMotion::steady);
  ~NavierStokes();
  NavierStokes(NavierStokes&&) noexcept;             ///< what is moved from can only be assigned to or destroyed
  NavierStokes& operator=(NavierStokes&&) noexcept;  ///< takes over the state and the solvers of another one

  /// Starts anew at time zero from a velocity sampled at the faces, pressure zero. If the samples (with the walls) are
  /// not discretely divergence-free to round-off, their divergence-free part is taken.
  /// \throws std::invalid_argument with the place if a sample is not finite.
  void set_velocity(const std::function<Vector3(const Vector3& position)>& velocity);

  /// The same from fields on this grid, such as resample() gives of another, with a pressure to begin with, of which
  /// the mean is removed. Walls and ghosts are not read.
  /// \throws std::invalid_argument if a grid differs or a number is not finite; nothing is changed then.
  void start_from(const FaceVector& velocity, const Field<Cell>& pressure);

  /// Continues from a state: the velocities and pressure at the points inside (faces on walls and ghosts are set from
  /// the walls). Fields of a run give, bit for bit, the continuation of that run. (Bit for bit with iterative solvers
  /// too, but not with a factor that lags, or an "auto" that would now choose anew.)
  /// \throws std::invalid_argument if a grid differs, a number is not finite or the clock is impossible; nothing is
  /// changed then.
  void restore(const FaceVector& velocity, const FaceVector& previous_velocity, const Field<Cell>& pressure,
               const FluidClock& clock);

  /// Remembers the present state, so that the next step can be tried: retry() goes back to it. It costs the copies of a
  /// velocity and a pressure, and their memory from the first call on. The force is no part of it.
  void remember();
  /// Goes back to the state of remember(), after a step or one that has failed, as often as wanted. The steps that
  /// follow are bit for bit those that would have followed (see restore() for the exceptions).
  /// \throws std::logic_error if nothing is remembered, or more than one step ago.
  void retry();
  /// Gives the memory back; remember() takes it anew.
  void forget();

  /// Force density (per volume, dimensionless) at the faces, for the coming step. It is kept, not cleared, by step();
  /// only inner faces are read.
  FaceVector& force();
  /// The same, to read.
  const FaceVector& force() const;
  /// A force density that is the same everywhere, beside force(): what drives a flow along a periodic axis. Zero at
  /// first, kept by step().
  Vector3& uniform_force();
  /// The same, to read.
  const Vector3& uniform_force() const;

  /// What div u is at the end of the coming steps, at the cells, but for the mean, which no flow has; zero where it has
  /// never been asked for, and at first. It is kept, not changed, by step(), and no part of a state. Sharp membranes
  /// state their jumps by it (docs/jump_conditions.md). The first call allocates two fields.
  Field<Cell>& divergence_source();
  /// What div u is now, to round-off: the source of the last step without its mean, or, where no step has led to the
  /// state, what the velocity has. Null, for zero, where divergence_source() has never been asked for.
  const Field<Cell>* given_divergence() const;

  /// Advances by dt. Allocates nothing as long as dt and the number of threads stay the same (see EllipticSolver for
  /// the exception).
  /// \throws std::invalid_argument unless dt > 0 is finite, a field of viscosity is > 0, and both it and the force are
  /// on this grid.
  /// \throws std::runtime_error with the step and the time if the solution is not finite or a solver has not converged;
  /// the state is then lost, but for retry().
  void step(double dt);

  /// From now on steps with inertia keep their force, so that solve_again() can take what has changed. It costs the memory of a
  /// velocity and a copy a step. Without inertia nothing is needed.
  void keep_force();

  /// Solves for the end of the last step again, with the force and the source of the divergence as they are now: for
  /// forces that depend on the velocity. Allocates nothing. Without inertia it begins with the solution as it is. With
  /// inertia it adds the answer to what of both has changed, as velocity and pressure at the end of a step are linear in
  /// them: a solve of each equation without history and convection, to round-off what the step with the new force gives.
  /// \throws std::logic_error before the first step; with inertia also unless the last step came after keep_force() and the viscosity is
  /// the same everywhere.
  /// \throws std::runtime_error as step().
  void solve_again();

  /// Velocity now; faces on walls and ghosts are set from the walls.
  const FaceVector& velocity() const;
  /// Velocity one step ago, with walls and ghosts of that time; before the first step the same as velocity().
  const FaceVector& previous_velocity() const;
  /// Pressure at cell centres, of zero mean. Its ghosts are those of extend_to_ghosts().
  const Field<Cell>& pressure() const;

  const FluidClock& clock() const;                      ///< the time levels of the state
  double time() const { return clock().time; }          ///< time of the state
  std::int64_t steps() const { return clock().steps; }  ///< number of steps since time zero

  const Grid& grid() const;                   ///< the grid of all fields
  const FluidParameters& parameters() const;  ///< the parameters that were given
  const FluidTimings& timings() const;        ///< what the steps have taken since construction
  const FluidReport& report() const;          ///< the solves of the last step

  /// Name of the solver of the velocity, as "fft" or "pcg+fft".
  std::string velocity_solver_name() const;
  /// Name of the solver of the pressure.
  std::string pressure_solver_name() const;

  /// Bytes that an object for this grid takes, solvers included. Nothing is allocated.
  static std::size_t estimate_memory(const Grid& grid, const FluidParameters& parameters);

 private:
  std::unique_ptr<Stepper> stepper_;
};

}  // namespace vesiflow::fluid
