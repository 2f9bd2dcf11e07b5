// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "fluid/boundary.h"
#include "fluid/export.h"
#include "fluid/field.h"
#include "fluid/grid.h"
#include "fluid/viscosity.h"

namespace vesiflow::fluid {

/// How exactly Stokes problems are solved.
struct StokesOptions {
  double tolerance = 1e-8;   ///< see StokesSolver
  int max_iterations = 500;  ///< a solve that needs more is reported as not converged
};

/// What a solve did.
struct StokesReport {
  int iterations = 0;                          ///< number of iterations
  bool converged = true;                       ///< whether the tolerance was met
  double residual = 0.0;                       ///< |r| / |b| of StokesSolver, of the result
  double momentum_residual = 0.0;              ///< the same of the first equation alone, in 2-norms
  double divergence = 0.0;                     ///< max |div u - source|: round-off
  std::array<double, 3> removed_mean_force{};  ///< without walls: subtracted from f, else zero
  double seconds = 0.0;                        ///< wall time of this solve, in seconds
};

/// The Stokes equations, velocity and pressure together.
///
/// Solves
///
///     -div(mu (grad u + grad u^T)) + grad p = f,   div u = 0,   u given on the walls, symmetric about mirrors,
///
/// with the difference operators of EllipticForm::stress, gradient() and divergence(), for a number or a field mu.
///
/// Without walls f loses its mean (reported), as nothing could balance it, and the mean velocity is zero. The mean of
/// the pressure is zero always.
///
/// The residuals r_u and r_p of the two equations are measured together,
///
///     |r|^2 = <r_u, P^-1 r_u> + <r_p, mu r_p>,   P ~ -div(mu (grad + grad^T)) (spectrally equivalent on all grids),
///
/// which bounds the error of u in dissipation and that of p in the 2-norm weighted with 1 / mu. The iteration stops
/// when |r| <= tolerance |b|, where b is the residual of p = 0 and a velocity that is zero but on the walls: so the
/// accuracy does not depend on the initial guess, but a good guess saves iterations. (If walls drive the flow, |b|
/// grows with the inverse square root of the mesh width.) At last a projection makes div u round-off; measured, this
/// raises |r| no more than fourfold on grids up to 96^3.
///
/// A constant mu takes conjugate gradients for the pressure with a fast solve of the velocity in each iteration: about
/// 15 at the default tolerance in a cube with walls, 1 without walls. A field takes Bramble-Pasciak conjugate gradients
/// with a multigrid cycle: about 35 to 50 in a cube for ratios of viscosities from 5 to 100 over two cells. Neither
/// number grows with the grid; in a box eight times as long as wide they are about 30 and 70.
class VESIFLOW_FLUID_EXPORT StokesSolver {
 public:
  /// For viscosity 1.
  /// \throws std::invalid_argument naming the value unless 0 < tolerance < 1 and max_iterations >= 1.
  explicit StokesSolver(const Grid& grid, const StokesOptions& options = {});
  ~StokesSolver();
  StokesSolver(StokesSolver&&) noexcept;             ///< what is moved from can only be assigned to or destroyed
  StokesSolver& operator=(StokesSolver&&) noexcept;  ///< takes over the system of another one

  /// Takes another viscosity, or new values of the field it has. May allocate.
  /// \throws std::invalid_argument with the place if a value is not finite and > 0, or if the field is on another grid.
  void update(const Viscosity& mu);

  /// Solves for velocity and pressure. Allocates nothing. Same bits for every number of threads, if no more than at the
  /// last update.
  /// \param force density (per volume) at the inner faces.
  /// \param walls the velocity of the walls, as last evaluated.
  /// \param u holds the initial guess and takes the solution; its faces on walls and its ghosts are set from the walls.
  /// \param p holds the initial guess and takes the solution; its ghosts are not set.
  /// \param uniform_force force density that is added to `force` everywhere.
  /// \param source what div u is, in the place of zero, at the cells; its mean, which no flow can have, must be that of
  /// the walls' flux: zero. Null for none. The viscous term of a number mu is mu Lap u then; that of a field has
  /// mu grad source beside it, and so a pressure that is higher by mu times the source.
  /// \throws std::invalid_argument if a grid differs.
  /// \throws std::runtime_error if the force, the guess or the source is not finite.
  StokesReport solve(const FaceVector& force, const WallVelocity& walls, FaceVector& u, Field<Cell>& p,
                     const Vector3& uniform_force = {}, const Field<Cell>* source = nullptr);

  const Grid& grid() const;              ///< the grid of all fields
  const StokesOptions& options() const;  ///< the options that were given

  /// Bytes that a solver takes for this viscosity, or another one that is a number or a field as well, within a few per
  /// cent. Nothing is allocated.
  static std::size_t estimate_memory(const Grid& grid, const Viscosity& mu);

 private:
  class System;
  std::unique_ptr<System> system_;
};

}  // namespace vesiflow::fluid
