// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "elliptic/pcg/pcg_solver.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "elliptic/solver_factory.h"
#include "grid/planes.h"
#include "message.h"

namespace vesiflow::fluid {
namespace {

const PcgOptions& checked(const PcgOptions& options) {
  if (!(std::isfinite(options.tolerance) && options.tolerance > 0.0 && options.tolerance < 1.0)) {
    throw std::invalid_argument(
        message("elliptic solver: the tolerance of 'pcg' is ", options.tolerance, "; it must be between 0 and 1"));
  }
  if (options.max_iterations < 1) {
    throw std::invalid_argument(
        message("elliptic solver: max_iterations of 'pcg' is ", options.max_iterations, "; it must be at least 1"));
  }
  if (!(std::isfinite(options.reference_viscosity) && options.reference_viscosity >= 0.0)) {
    throw std::invalid_argument(message("elliptic solver: reference_viscosity of 'pcg' is ",
                                        options.reference_viscosity, "; it must be > 0, or 0 for automatic"));
  }
  return options;
}

bool scaled(const EllipticProblem& problem, const PcgOptions& options) {
  return std::holds_alternative<FftOptions>(options.preconditioner) && !problem.mu.is_constant();
}

// y *= x.
void multiply(ConstBlocks x, Blocks y) {
  for_each_row(x, y, [](double* to, const double* from, int n) {
#pragma omp simd
    for (int i = 0; i < n; ++i) to[i] *= from[i];
  });
}

}  // namespace

PcgSolver::PcgSolver(const EllipticProblem& problem, const PcgOptions& options)
    : EllipticSolver(problem), options_(checked(options)) {
  const auto* fft = std::get_if<FftOptions>(&options_.preconditioner);
  single_ = fft != nullptr && fft->arithmetic == FftOptions::Arithmetic::single;
  update(problem);
}

std::string PcgSolver::name() const {
  return pcg_name(preconditioner_->name());
}

std::size_t PcgSolver::estimate_memory(const EllipticProblem& problem, const PcgOptions& options) {
  std::size_t bytes = 0;
  for (int block = 0; block < problem.blocks(); ++block) {
    const auto n = point_extent(problem.grid, problem.centring(block));
    bytes += (scaled(problem, options) ? 5 : 4) * sizeof(double) * static_cast<std::size_t>(n[0] + 2) * (n[1] + 2) *
             (n[2] + 2);
  }
  const bool fft = std::holds_alternative<FftOptions>(options.preconditioner);
  return bytes +
         estimate_preconditioner_memory(fft ? problem.with_constant_viscosity(1.0) : problem, options.preconditioner);
}

EllipticProblem PcgSolver::preconditioning_problem(const EllipticProblem& problem) const {
  if (!std::holds_alternative<FftOptions>(options_.preconditioner)) return problem;
  const auto [min, max] = viscosity_range();
  const double reference = options_.reference_viscosity;
  return problem.with_constant_viscosity(reference > 0.0 ? reference : std::sqrt(min * max));
}

void PcgSolver::do_update(const EllipticProblem& problem) {
  const EllipticProblem reference = preconditioning_problem(problem);
  if (!may_reuse()) {
    preconditioner_ = make_preconditioner(reference, options_.preconditioner);
    direction_ = std::make_unique<GhostedBlocks>(problem);
    product_ = std::make_unique<GhostedBlocks>(problem);
    residual_ = std::make_unique<GhostedBlocks>(problem);
    preconditioned_ = std::make_unique<GhostedBlocks>(problem);
    int planes = 0;
    for (int block = 0; block < problem.blocks(); ++block) planes = std::max(planes, problem.extent(block)[2]);
    plane_sums_ = PlaneSums(planes);
    stencil_ = std::make_unique<Stencil>(problem);
  } else {
    preconditioner_->update(reference);
    stencil_->update(problem);
  }
  if (scaled(problem, options_)) {
    set_scale(problem, reference.mu.value());
  } else {
    scale_.reset();
  }
}

// "fft" knows nothing of where mu is large. With its problem C between two diagonal scalings, D C^-1 D with
// D = (diagonal of C / diagonal of A)^(1/4), the condition number is about the square root of that of C^-1 A, and still
// independent of the grid, however thin an interface (measured: with the power 1/2 instead, as exact for a mu that is
// smooth on the grid's scale, iterations grow with the number of cells).
void PcgSolver::set_scale(const EllipticProblem& problem, double reference) {
  if (!scale_ || !may_reuse()) scale_ = std::make_unique<GhostedBlocks>(problem);
  double per_viscosity = 0.0;
  for (int axis = 0; axis < 3; ++axis) per_viscosity += 2.0 / std::pow(problem.grid.spacing(axis), 2);
  const ConstView mu = problem.mu.field().points();
  const double numerator = problem.alpha + reference * per_viscosity;
  for (int block = 0; block < problem.blocks(); ++block) {
    const Centring centring = problem.centring(block);
    const View scale = scale_->unknowns()[block];
    const std::ptrdiff_t below = centring == Centring::face_x   ? 1
                                 : centring == Centring::face_y ? mu.row_stride
                                 : centring == Centring::face_z ? mu.plane_stride
                                                                : 0;
    for_each_plane(scale.extent, [&](int k) {
      for (int j = 0; j < scale.extent[1]; ++j) {
        const double* above =
            mu.row(j + first_unknown(problem.grid, centring, 1), k + first_unknown(problem.grid, centring, 2)) +
            first_unknown(problem.grid, centring, 0);
        double* row = scale.row(j, k);
        for (int i = 0; i < scale.extent[0]; ++i) {
          const double here = 0.5 * (above[i] + above[i - below]);
          row[i] = std::sqrt(std::sqrt(numerator / (problem.alpha + here * per_viscosity)));
        }
      }
    });
  }
}

void PcgSolver::precondition(ConstBlocks r, Blocks z) {
  if (!scale_) {
    preconditioner_->solve(r, z);
    // In single precision means are zero to round-off of that.
    if (single_ && problem().has_nullspace()) plane_sums_.remove_means(z);
    return;
  }
  copy(r, z);
  multiply(scale_->unknowns(), z);
  preconditioner_->solve(z, z);
  multiply(scale_->unknowns(), z);
  if (problem().has_nullspace()) plane_sums_.remove_means(z);
}

// Conjugate gradients as in Saad, Iterative Methods for Sparse Linear Systems (2003), algorithm 9.1.
SolveReport PcgSolver::do_solve(ConstBlocks rhs, Blocks x) {
  SolveReport report;
  const Blocks p = direction_->unknowns();
  const Blocks q = product_->unknowns();
  const Blocks r = residual_->unknowns();
  const Blocks z = preconditioned_->unknowns();
  const bool from_zero = rhs[0].data == x[0].data;
  copy(rhs, r);
  if (problem().has_nullspace()) report.removed_mean = plane_sums_.remove_means(r);
  const double scale = std::sqrt(plane_sums_.dot(r, r));
  if (from_zero || scale == 0.0) {
    set_zero(x);
  } else {
    if (problem().has_nullspace()) plane_sums_.remove_means(x);
    direction_->assign(x);
    stencil_->apply(*direction_, q);
    add(-1.0, q, r);
  }
  double norm = std::sqrt(plane_sums_.dot(r, r));
  if (!std::isfinite(scale) || !std::isfinite(norm)) {
    throw std::runtime_error(std::isfinite(scale) ? "elliptic solver: the x to start from is not finite"
                                                  : "elliptic solver: the right-hand side is not finite");
  }
  // No further below a residual to start from than round-off allows.
  const double target = std::max(options_.tolerance * scale, 1e-14 * norm);
  double rz = 0.0;
  while (norm > target && report.iterations < options_.max_iterations) {
    precondition(r, z);
    const double previous = std::exchange(rz, plane_sums_.dot(r, z));
    if (report.iterations == 0) {
      copy(z, p);
    } else {
      scale_and_add(rz / previous, z, p);
    }
    stencil_->apply(*direction_, q);
    const double step = rz / plane_sums_.dot(p, q);
    add(step, p, x);
    add(-step, q, r);
    norm = std::sqrt(plane_sums_.dot(r, r));
    ++report.iterations;
    if (!std::isfinite(norm)) throw std::runtime_error("elliptic solver: 'pcg' broke down, a residual is not finite");
  }
  report.converged = norm <= target;
  report.residual = scale > 0.0 ? norm / scale : norm;
  return report;
}

}  // namespace vesiflow::fluid
