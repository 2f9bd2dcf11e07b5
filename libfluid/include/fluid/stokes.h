// The Stokes equations, velocity and pressure together.
#pragma once

#include <array>
#include <memory>

#include "fluid/boundary.h"
#include "fluid/field.h"
#include "fluid/grid.h"
#include "fluid/viscosity.h"

namespace vesiflow::fluid {

struct StokesOptions {
  double tolerance = 1e-8;   // see StokesSolver
  int max_iterations = 500;  // a solve that needs more is reported as not converged
};

struct StokesReport {
  int iterations = 0;
  bool converged = true;
  double residual = 0.0;                       // of both equations as in the stopping criterion
  double momentum_residual = 0.0;              // |f + div(mu (grad u + grad u^T)) - grad p| / |b| (2-norms), b as below
  double divergence = 0.0;                     // max |div u|
  std::array<double, 3> removed_mean_force{};  // without walls: subtracted from f, else zero
  double seconds = 0.0;                        // wall time of this solve
};

// Solves   -div(mu (grad u + grad u^T)) + grad p = f,   div u = 0,   u given on the walls,
// with the difference operators of EllipticForm::stress, gradient() and divergence(), for a number or a field mu.
//
// Without walls f loses its mean (reported), as nothing could balance it, and the mean velocity is zero. The mean of the
// pressure is zero always.
//
// The residual (r_u, r_p) of the two equations is measured in the norm that bounds the error of the velocity in
// dissipation, and that of the pressure in the 2-norm weighted with 1 / mu, independently of the grid:
//   |r|^2 = <r_u, P^-1 r_u> + <r_p, mu r_p>,   P ~ the viscous operator.
// The solve stops when |r| <= tolerance |b|, where b is the residual of p = 0 and a velocity that is zero but on the
// walls: so the result has the same accuracy whatever the initial guess, and a good guess saves iterations.
class StokesSolver {
 public:
  // For viscosity 1. Throws std::invalid_argument, naming the value, unless 0 < tolerance < 1 and max_iterations >= 1.
  explicit StokesSolver(const Grid& grid, const StokesOptions& options = {});
  ~StokesSolver();
  StokesSolver(StokesSolver&&) noexcept;
  StokesSolver& operator=(StokesSolver&&) noexcept;

  // Takes another viscosity, or new values of the field it has. May allocate. Throws std::invalid_argument, with the
  // place, if a value is not finite and > 0, or if the field is on another grid.
  void update(const Viscosity& mu);

  // force: density (per volume) at the inner faces. u and p hold the initial guess and take the solution; faces on walls
  // and ghosts of u are set from the walls (as last evaluated), ghosts of p are not. Allocates nothing. Same bits for
  // every number of threads, if no more than at the last update. Throws std::invalid_argument if a grid differs, and
  // std::runtime_error if the force or the guess is not finite.
  StokesReport solve(const FaceVector& force, const WallVelocity& walls, FaceVector& u, Field<Cell>& p);

  const Grid& grid() const;
  const StokesOptions& options() const;

 private:
  class System;
  std::unique_ptr<System> system_;
};

}  // namespace vesiflow::fluid
