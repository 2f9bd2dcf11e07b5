// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// The elliptic problem that solvers solve: what is to be solved, apart from how.
#pragma once

#include <array>
#include <cstddef>

#include "fluid/centring.h"
#include "fluid/export.h"
#include "fluid/grid.h"
#include "fluid/view.h"
#include "fluid/viscosity.h"

namespace vesiflow::fluid {

/// The condition on all walls. Periodic axes have none, mirrors their own (EllipticProblem::condition).
enum class BoundaryCondition {
  dirichlet,  ///< x = 0
  neumann     ///< zero normal derivative
};

/// What is applied to x beside alpha.
enum class EllipticForm {
  laplacian,  ///< -div(mu grad x), each component by itself
  stress      ///< the coupled viscous operator -div(mu (grad x + grad x^T)) of a vector
};

/// "dirichlet" or "neumann", for messages.
VESIFLOW_FLUID_EXPORT const char* name(BoundaryCondition boundary);
/// "laplacian" or "stress", for messages.
VESIFLOW_FLUID_EXPORT const char* name(EllipticForm form);

/// The equation
///
///     alpha x - div(mu grad x) = b               for a scalar x on a centring or for a vector x on the faces, or
///     alpha x - div(mu (grad x + grad x^T)) = b  for a vector x on the faces
///
/// on the unknowns (the points not on walls or mirrors), with second-order differences between neighbours (7 points if
/// mu is a number, and then for the laplacian form -mu Lap x), and homogeneous conditions on all walls (inhomogeneous
/// data belongs to b; see WallVelocity).
///
/// Dirichlet: x = 0 on the walls. Along the normal axis of a face centring these are points of the grid; along the
/// others the wall is half a cell away and the ghost is -x. Neumann: the ghost is x; for cell centring only.
///
/// Across a mirror of the grid x is even, which is a Neumann condition there, but along the normal axis of a face
/// centring odd, which is a Dirichlet condition.
///
/// With alpha = 0, and Neumann conditions or no walls at all, the constants are the nullspace, of each component by
/// itself. b is then made compatible by subtracting its mean, and the mean of the solution is zero: any solver does
/// both, and the system is never changed otherwise.
///
/// The operator is symmetric in the sum over unknowns, and positive but for the nullspace.
struct VESIFLOW_FLUID_EXPORT EllipticProblem {
  /// The problem of a scalar. The values of a field mu are checked by the solver.
  /// \throws std::invalid_argument naming the value unless alpha >= 0 and a constant mu > 0 are finite, a field mu is
  /// on the same grid, and the condition suits the centring.
  EllipticProblem(const Grid& grid, Centring centring, BoundaryCondition boundary, double alpha, Viscosity mu);
  /// The problem of a velocity-like vector at the faces, zero on walls.
  /// \throws std::invalid_argument likewise.
  static EllipticProblem velocity(const Grid& grid, EllipticForm form, double alpha, Viscosity mu);
  /// Poisson's equation for a pressure: at the cells, with no flux through walls.
  static EllipticProblem pressure(const Grid& grid);

  Grid grid;                                    ///< the grid of the unknowns
  EllipticForm form = EllipticForm::laplacian;  ///< the operator
  BoundaryCondition boundary;                   ///< the condition on all walls
  double alpha;                                 ///< alpha >= 0
  Viscosity mu;                                 ///< mu > 0: a number, or a field at cell centres

  /// Number of the arrays that make up x: 1 for a scalar, 3 for a vector.
  int blocks() const { return is_vector_ ? 3 : 1; }
  /// Centring of a block.
  Centring centring(int block = 0) const { return is_vector_ ? face_centrings[block] : centring_; }
  /// Unknowns of a block along each axis.
  std::array<int, 3> extent(int block = 0) const { return unknown_extent(grid, centring(block)); }
  std::size_t unknowns() const;           ///< number of unknowns of all blocks
  std::size_t unknowns(int block) const;  ///< number of unknowns of a block

  /// Condition of a block at the lower (side 0) or upper (side 1) end of an axis that is not periodic: at a wall
  /// `boundary`, at a mirror (side 0) what is said above.
  BoundaryCondition condition(int block, int axis, int side) const;
  /// Whether the constants are a nullspace.
  bool has_nullspace() const { return alpha == 0.0 && (boundary == BoundaryCondition::neumann || !grid.has_walls()); }
  /// Whether the other problem has the same unknowns and operator; alpha and mu may differ, and mu be a number in one
  /// and a field in the other.
  bool same_structure(const EllipticProblem& other) const;

  /// One component of a vector problem of laplacian form, as a scalar problem.
  EllipticProblem component(int block) const;
  /// The problem of laplacian form with a constant coefficient, for the same unknowns: the reference of
  /// preconditioners.
  EllipticProblem with_constant_viscosity(double value) const;

 private:
  Centring centring_;
  bool is_vector_ = false;
};

/// y = A x. x and y must not overlap. Allocates an array per block, for the ghosts.
/// \throws std::invalid_argument unless the arrays have the shapes of the problem.
VESIFLOW_FLUID_EXPORT void apply(const EllipticProblem& problem, ConstBlocks x, Blocks y);

/// max |b - A x| / max |b|, with b made compatible first if the problem has a nullspace; infinite if x is not finite.
/// Allocates.
/// \throws std::invalid_argument unless the arrays have the shapes of the problem.
VESIFLOW_FLUID_EXPORT double relative_residual(const EllipticProblem& problem, ConstBlocks rhs, ConstBlocks x);

}  // namespace vesiflow::fluid
