// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/elliptic_problem.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "grid/check_grid.h"
#include "grid/planes.h"
#include "message.h"
#include "operators/check_blocks.h"
#include "operators/stencil.h"

namespace vesiflow::fluid {

const char* name(BoundaryCondition boundary) {
  return boundary == BoundaryCondition::dirichlet ? "dirichlet" : "neumann";
}

const char* name(EllipticForm form) {
  return form == EllipticForm::laplacian ? "laplacian" : "stress";
}

EllipticProblem::EllipticProblem(const Grid& grid_, Centring centring, BoundaryCondition boundary_, double alpha_,
                                 Viscosity mu_)
    : grid(grid_), boundary(boundary_), alpha(alpha_), mu(std::move(mu_)), centring_(centring) {
  if (!std::isfinite(alpha) || alpha < 0.0) {
    throw std::invalid_argument(message("elliptic problem: alpha is ", alpha, "; it must be finite and >= 0"));
  }
  if (mu.is_constant() && !(std::isfinite(mu.value()) && mu.value() > 0.0)) {
    throw std::invalid_argument(message("elliptic problem: mu is ", mu.value(), "; it must be finite and > 0"));
  }
  if (!mu.is_constant()) check_grid("elliptic problem", "the field mu", mu.field(), grid);
  if (boundary == BoundaryCondition::neumann && centring != Centring::cell) {
    throw std::invalid_argument(message("elliptic problem: neumann conditions with ", name(centring),
                                        " centring; use cell centring, or dirichlet conditions"));
  }
}

EllipticProblem EllipticProblem::pressure(const Grid& grid) {
  return {grid, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0};
}

EllipticProblem EllipticProblem::velocity(const Grid& grid, EllipticForm form, double alpha, Viscosity mu) {
  EllipticProblem problem(grid, Centring::face_x, BoundaryCondition::dirichlet, alpha, std::move(mu));
  problem.form = form;
  problem.is_vector_ = true;
  return problem;
}

std::size_t EllipticProblem::unknowns(int block) const {
  const auto n = extent(block);
  return static_cast<std::size_t>(n[0]) * n[1] * n[2];
}

std::size_t EllipticProblem::unknowns() const {
  std::size_t count = 0;
  for (int block = 0; block < blocks(); ++block) count += unknowns(block);
  return count;
}

BoundaryCondition EllipticProblem::condition(int block, int axis, int side) const {
  const bool even = !grid.has_wall(axis, side) && !is_face_normal(centring(block), axis);
  return even ? BoundaryCondition::neumann : boundary;
}

bool EllipticProblem::same_structure(const EllipticProblem& other) const {
  return grid == other.grid && form == other.form && boundary == other.boundary && is_vector_ == other.is_vector_ &&
         centring_ == other.centring_;
}

EllipticProblem EllipticProblem::component(int block) const {
  return {grid, centring(block), boundary, alpha, mu};
}

EllipticProblem EllipticProblem::with_constant_viscosity(double value) const {
  EllipticProblem problem = *this;
  problem.form = EllipticForm::laplacian;
  problem.mu = value;
  return problem;
}

void check_blocks(const char* function, const char* argument, ConstBlocks arrays, const EllipticProblem& problem) {
  if (arrays.count() != problem.blocks()) {
    throw std::invalid_argument(
        message(function, ": ", argument, " has ", arrays.count(), " arrays, the problem has ", problem.blocks()));
  }
  for (int block = 0; block < problem.blocks(); ++block) {
    const auto& found = arrays[block].extent;
    const auto wanted = problem.extent(block);
    if (found == wanted) continue;
    throw std::invalid_argument(message(function, ": ", argument, " is ", found[0], " x ", found[1], " x ", found[2],
                                        ", the problem has ", wanted[0], " x ", wanted[1], " x ", wanted[2],
                                        " unknowns"));
  }
}

void apply(const EllipticProblem& problem, ConstBlocks x, Blocks y) {
  check_blocks("apply", "x", x, problem);
  check_blocks("apply", "y", y, problem);
  GhostedBlocks ghosted(problem);
  ghosted.assign(x);
  Stencil(problem).apply(ghosted, y);
}

double relative_residual(const EllipticProblem& problem, ConstBlocks rhs, ConstBlocks x) {
  check_blocks("relative_residual", "the right-hand side", rhs, problem);
  check_blocks("relative_residual", "x", x, problem);
  GhostedBlocks product(problem);
  apply(problem, x, product.unknowns());
  double largest = 0.0;
  double residual = 0.0;
  for (int block = 0; block < problem.blocks(); ++block) {
    const ConstView b = rhs[block];
    const View ax = product.unknowns()[block];
    const auto for_each = [&](auto&& visit) {
      for (int k = 0; k < b.extent[2]; ++k) {
        for (int j = 0; j < b.extent[1]; ++j) {
          for (int i = 0; i < b.extent[0]; ++i) visit(b(i, j, k), ax(i, j, k));
        }
      }
    };
    double mean = 0.0;
    if (problem.has_nullspace()) {
      for_each([&](double value, double) { mean += value; });
      mean /= static_cast<double>(problem.unknowns(block));
    }
    for_each([&](double value, double a) {
      largest = std::max(largest, std::abs(value - mean));
      residual = std::max(residual, magnitude(value - mean - a));
    });
  }
  return largest > 0.0 ? residual / largest : residual;
}

}  // namespace vesiflow::fluid
