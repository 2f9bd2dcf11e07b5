// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The elliptic problem that solvers solve: what is to be solved, apart from how.
#pragma once

#include <array>
#include <cstddef>

#include "fluid/centring.h"
#include "fluid/export.h"
#include "fluid/grid.h"
#include "fluid/view.h"
#include "fluid/viscosity.h"

namespace vesiflow::fluid {

// The condition on all walls. Periodic axes have none, mirrors their own (EllipticProblem::condition).
enum class BoundaryCondition { dirichlet, neumann };

// What is applied to x beside alpha: -div(mu grad x), each component by itself, or the coupled viscous operator
// -div(mu (grad x + grad x^T)) of a vector.
enum class EllipticForm { laplacian, stress };

// "dirichlet", "laplacian", ... for messages.
VESIFLOW_FLUID_EXPORT const char* name(BoundaryCondition boundary);
VESIFLOW_FLUID_EXPORT const char* name(EllipticForm form);

// alpha x - div(mu grad x) = b for a scalar x on a centring or for a vector x on the faces, or
// alpha x - div(mu (grad x + grad x^T)) = b for a vector on the faces; on the unknowns (the points not on walls or
// mirrors), with second-order differences between neighbours (7 points if mu is a number, and then for the laplacian form
// -mu Lap x), and homogeneous conditions on all walls (inhomogeneous data belongs to b; see WallVelocity).
//
// Dirichlet: x = 0 on the walls. Along the normal axis of a face centring these are points of the grid; along
// the others the wall is half a cell away and the ghost is -x. Neumann: the ghost is x; for cell centring
// only.
//
// Across a mirror of the grid x is even, which is a Neumann condition there, but along the normal axis of a face
// centring odd, which is a Dirichlet condition.
//
// With alpha = 0, and Neumann conditions or no walls at all, the constants are the nullspace, of each component by
// itself. b is then made compatible by subtracting its mean, and the mean of the solution is zero: any solver does
// both, and the system is never changed otherwise.
//
// The operator is symmetric in the sum over unknowns, and positive but for the nullspace.
struct VESIFLOW_FLUID_EXPORT EllipticProblem {
  // A scalar. Throws std::invalid_argument, naming the value, unless alpha >= 0 and a constant mu > 0 are finite, a
  // field mu is on the same grid, and the condition suits the centring. The values of a field are checked by the solver.
  EllipticProblem(const Grid& grid, Centring centring, BoundaryCondition boundary, double alpha, Viscosity mu);
  // A velocity-like vector at the faces, zero on walls. Throws likewise.
  static EllipticProblem velocity(const Grid& grid, EllipticForm form, double alpha, Viscosity mu);

  Grid grid;
  EllipticForm form = EllipticForm::laplacian;
  BoundaryCondition boundary;
  double alpha;
  Viscosity mu;

  // Arrays that make up x, and the centring and shape of each.
  int blocks() const { return is_vector_ ? 3 : 1; }
  Centring centring(int block = 0) const { return is_vector_ ? face_centrings[block] : centring_; }
  std::array<int, 3> extent(int block = 0) const { return unknown_extent(grid, centring(block)); }
  std::size_t unknowns() const;  // of all blocks
  std::size_t unknowns(int block) const;
  // Of a block at an end of an axis that is not periodic: at a wall `boundary`, at a mirror (side 0) what is said above.
  BoundaryCondition condition(int block, int axis, int side) const;
  bool has_nullspace() const { return alpha == 0.0 && (boundary == BoundaryCondition::neumann || !grid.has_walls()); }
  // Same unknowns and operator; alpha and mu may differ, and mu be a number in one and a field in the other.
  bool same_structure(const EllipticProblem& other) const;

  // One component of a vector problem of laplacian form, as a scalar problem.
  EllipticProblem component(int block) const;
  // The problem of laplacian form with a constant coefficient, for the same unknowns: the reference of preconditioners.
  EllipticProblem with_constant_viscosity(double value) const;

 private:
  Centring centring_;
  bool is_vector_ = false;
};

// y = A x. x and y must not overlap. Allocates an array per block, for the ghosts. Throws std::invalid_argument, as
// relative_residual() does, unless the arrays have the shapes of the problem.
VESIFLOW_FLUID_EXPORT void apply(const EllipticProblem& problem, ConstBlocks x, Blocks y);

// max |b - A x| / max |b|, with b made compatible first if the problem has a nullspace; infinite if x is not
// finite. Allocates.
VESIFLOW_FLUID_EXPORT double relative_residual(const EllipticProblem& problem, ConstBlocks rhs, ConstBlocks x);

}  // namespace vesiflow::fluid
