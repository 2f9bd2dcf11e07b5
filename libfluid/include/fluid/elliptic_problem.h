// The scalar elliptic problem that solvers solve: what is to be solved, apart from how.
#pragma once

#include <array>
#include <cstddef>

#include "fluid/centring.h"
#include "fluid/grid.h"
#include "fluid/view.h"

namespace vesiflow::fluid {

enum class BoundaryCondition { dirichlet, neumann };

// "dirichlet" or "neumann", for messages.
const char* name(BoundaryCondition boundary);

// alpha x - mu Lap x = b on the unknowns of a centring, with the second-order 7-point Laplacian and one
// homogeneous condition on all walls (inhomogeneous data belongs to b; see WallVelocity::add_diffusion).
//
// Dirichlet: x = 0 on the walls. Along the normal axis of a face centring these are points of the grid; along
// the others the wall is half a cell away and the ghost is -x. Neumann: the ghost is x; for cell centring
// only.
//
// With alpha = 0 and Neumann conditions the constants are the nullspace. b is then made compatible by
// subtracting its mean, and the mean of the solution is zero: any solver does both, and the system is never
// changed otherwise.
struct EllipticProblem {
  // Throws std::invalid_argument, naming the value, unless alpha >= 0 and mu > 0 are finite and the condition
  // suits the centring.
  EllipticProblem(const Grid& grid, Centring centring, BoundaryCondition boundary, double alpha, double mu);

  Grid grid;
  Centring centring;
  BoundaryCondition boundary;
  double alpha;
  double mu;

  std::array<int, 3> extent() const { return unknown_extent(grid, centring); }
  std::size_t unknowns() const;
  bool has_nullspace() const { return alpha == 0.0 && boundary == BoundaryCondition::neumann; }
  // Same unknowns and stencil; alpha and mu may differ.
  bool same_structure(const EllipticProblem& other) const;

  // Coefficient of x itself, divided by 1 / h^2, in the one-dimensional -Laplacian at the first and the last
  // unknown of an axis: 2 next to Dirichlet points, 3 for a Dirichlet wall half a cell away, 1 for a Neumann
  // wall.
  double end_diagonal(int axis) const;
};

// y = alpha x - mu Lap x. x and y have the shape of the problem and must not overlap.
void apply(const EllipticProblem& problem, ConstView x, View y);

// max |b - A x| / max |b|, with b made compatible first if the problem has a nullspace. Allocates one array.
double relative_residual(const EllipticProblem& problem, ConstView rhs, ConstView x);

}  // namespace vesiflow::fluid
