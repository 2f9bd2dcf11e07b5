// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// A multigrid cycle for the viscous operator with variable viscosity: the preconditioner of the velocity.
#pragma once

#include <memory>
#include <vector>

#include "fluid/elliptic_solver.h"
#include "operators/stencil.h"
#include "operators/tensor_map.h"

namespace vesiflow::fluid {

// One V cycle for -div(mu (grad u + grad u^T)) u = b, from zero: a symmetric positive definite operator.
//
// Each coarser grid has half the cells (rounded up) along the axes of the smallest spacings, any number being allowed, and
// its own difference operator with the mean viscosity of its cells. Transfers are linear interpolation and its
// transpose; smoothing is by a damped Jacobi step before and after. On the coarsest grid a Chebyshev iteration with fast
// solves of constant viscosity takes steps in proportion to the root of the ratio of viscosities.
class VelocityMultigrid {
 public:
  explicit VelocityMultigrid(const Grid& grid);
  ~VelocityMultigrid();
  void update(const Viscosity& mu);
  const Stencil& viscous_operator() const;
  void apply(ConstBlocks b, Blocks x);

 private:
  class Level;

  void cycle(std::size_t level, ConstBlocks b);
  void solve_coarsest(ConstBlocks b);

  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<EllipticSolver> coarsest_solver_;
  std::unique_ptr<GhostedBlocks> coarsest_direction_;
  Viscosity::Range coarsest_range_{};
};

}  // namespace vesiflow::fluid
