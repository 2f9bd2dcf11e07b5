// x and y are diagonalised by fast transforms, plane by plane; what remains is a tridiagonal system in z for
// every pair of modes. Eigenvalues are those of the difference operator, so that the solution is exact to
// round-off.
//
// A solve passes three times over the data (planes forward, slabs, planes backward), each time through a
// scratch array that fits a core's second-level cache. Every plane and slab is done by one thread in one way,
// so the bits do not depend on the number of threads.
#include "fft_solver.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "message.h"

namespace vesiflow::fluid {
namespace {

Basis basis(const EllipticProblem& problem, int axis) {
  if (problem.boundary == BoundaryCondition::neumann) return Basis::cosine_cells;
  return is_face_normal(problem.centring(), axis) ? Basis::sine_points : Basis::sine_cells;
}

// Eigenvalues of the one-dimensional -Laplacian, (2 sin(pi m / 2N) / h)^2; m counts from 0 for cosines, else
// from 1.
std::vector<double> eigenvalues(const EllipticProblem& problem, int axis) {
  const int first_mode = problem.boundary == BoundaryCondition::neumann ? 0 : 1;
  std::vector<double> values(problem.extent()[axis]);
  for (int i = 0; i < static_cast<int>(values.size()); ++i) {
    const double angle = 0.5 * std::numbers::pi * (i + first_mode) / problem.grid.cells[axis];
    const double root = 2.0 * std::sin(angle) / problem.grid.spacing(axis);
    values[i] = root * root;
  }
  return values;
}

}  // namespace

FftScalarSolver::Scratch::Scratch(const std::array<int, 3>& extent, std::ptrdiff_t row_stride)
    : transform(allocate_aligned(TransformPlan::scratch_size({extent[0], extent[1]}))),
      slab(allocate_aligned(static_cast<std::size_t>(row_stride) * extent[2])),
      factors(allocate_aligned(static_cast<std::size_t>(row_stride) * extent[2])),
      column(extent[2]) {}

FftScalarSolver::FftScalarSolver(const EllipticProblem& problem)
    : extent_(problem.extent()), row_stride_(padded(extent_[0])) {
  const std::array<int, 2> plane{extent_[0], extent_[1]};
  const std::array<Basis, 2> bases{basis(problem, 0), basis(problem, 1)};
  forward_ = std::make_unique<TransformPlan>(plane, bases, Direction::forward);
  backward_ = std::make_unique<TransformPlan>(plane, bases, Direction::backward);
  eigenvalues_ = {eigenvalues(problem, 0), eigenvalues(problem, 1)};
  normalisation_ =
      1.0 / (LineTransform::pair_factor(bases[0], plane[0]) * LineTransform::pair_factor(bases[1], plane[1]));
  const double h = problem.grid.spacing(2);
  z_coupling_ = 1.0 / (h * h);
  const bool neumann = problem.boundary == BoundaryCondition::neumann;
  z_end_diagonal_ = neumann ? 1.0 : is_face_normal(problem.centring(), 2) ? 2.0 : 3.0;
  update(problem);
}

std::size_t FftScalarSolver::estimate_memory(const EllipticProblem& problem, int threads) {
  const auto n = problem.extent();
  const auto slabs = static_cast<std::size_t>(padded(n[0]) * 2 * n[2] + n[2]);
  return sizeof(double) * (threads * (TransformPlan::scratch_size({n[0], n[1]}) + slabs) + n[0] + n[1]);
}

void FftScalarSolver::update(const EllipticProblem& problem) {
  alpha_ = problem.alpha;
  mu_ = problem.mu.value();
  nullspace_ = problem.has_nullspace();
  while (static_cast<int>(scratch_.size()) < omp_get_max_threads()) scratch_.emplace_back(extent_, row_stride_);
}

double FftScalarSolver::solve(ConstView rhs, View x) {
  double removed_mean = 0.0;
  const int threads = std::min(static_cast<int>(scratch_.size()), omp_get_max_threads());
#pragma omp parallel num_threads(threads)
  {
    Scratch& scratch = scratch_[omp_get_thread_num()];
#pragma omp for schedule(static)
    for (int k = 0; k < extent_[2]; ++k) {
      forward_->execute(rhs.row(0, k), rhs.row_stride, x.row(0, k), x.row_stride, scratch.transform.get());
    }
#pragma omp for schedule(static)
    for (int j = 0; j < extent_[1]; ++j) {
      if (nullspace_ && j == 0) removed_mean = solve_singular_column(x, scratch);
      solve_slab(x, j, scratch);
    }
#pragma omp for schedule(static)
    for (int k = 0; k < extent_[2]; ++k) {
      backward_->execute(x.row(0, k), x.row_stride, x.row(0, k), x.row_stride, scratch.transform.get());
    }
  }
  return removed_mean;
}

// Elimination along z for all modes of x at one mode j of y:
//   -s x_{k-1} + d_k x_k - s x_{k+1} = b_k,  s = mu / h_z^2,  d_k = alpha + mu (l_x + l_y) + s (2, or the
//   end's value).
void FftScalarSolver::solve_slab(View x, int j, Scratch& scratch) const {
  const int nx = extent_[0];
  const int nz = extent_[2];
  const double s = mu_ * z_coupling_;
  const double* lx = eigenvalues_[0].data();
  const double base = alpha_ + mu_ * eigenvalues_[1][j];
  const bool singular = nullspace_ && j == 0;
  for (int k = 0; k < nz; ++k) {
    const double* b = x.row(j, k);
    double* y = scratch.slab.get() + k * row_stride_;
    double* g = scratch.factors.get() + k * row_stride_;
    const double shift = base + s * (k == 0 || k == nz - 1 ? z_end_diagonal_ : 2.0);
    if (k == 0) {
      for (int i = 0; i < nx; ++i) {
        const double inverse = 1.0 / (shift + mu_ * lx[i]);
        g[i] = s * inverse;
        y[i] = normalisation_ * b[i] * inverse;
      }
    } else {
      const double* y_below = y - row_stride_;
      const double* g_below = g - row_stride_;
      for (int i = 0; i < nx; ++i) {
        const double inverse = 1.0 / (shift + mu_ * lx[i] - s * g_below[i]);
        g[i] = s * inverse;
        y[i] = (normalisation_ * b[i] + s * y_below[i]) * inverse;
      }
    }
  }
  std::copy_n(scratch.slab.get() + (nz - 1) * row_stride_, nx, x.row(j, nz - 1));
  for (int k = nz - 2; k >= 0; --k) {
    const double* y = scratch.slab.get() + k * row_stride_;
    const double* g = scratch.factors.get() + k * row_stride_;
    const double* above = x.row(j, k + 1);
    double* out = x.row(j, k);
    for (int i = 0; i < nx; ++i) out[i] = y[i] + g[i] * above[i];
  }
  if (singular) {
    // Elimination has divided by the zero pivot in this column alone.
    for (int k = 0; k < nz; ++k) x(0, 0, k) = scratch.column[k];
  }
}

// The constant mode of x and y in a problem with a nullspace, where elimination would end with a zero pivot.
// With the mean taken out of b, s (x_{k+1} - x_k) is minus the sum of b below, and the mean of x is zero.
// Leaves the solution in scratch.column for solve_slab, and returns the mean of the right-hand side.
double FftScalarSolver::solve_singular_column(ConstView x, Scratch& scratch) const {
  const int nz = extent_[2];
  const double s = mu_ * z_coupling_;
  double mean = 0.0;
  for (int k = 0; k < nz; ++k) mean += normalisation_ * x(0, 0, k);
  mean /= nz;
  double flux = 0.0;
  double value = 0.0;
  double sum = 0.0;
  for (int k = 0; k < nz; ++k) {
    scratch.column[k] = value;
    sum += value;
    flux += normalisation_ * x(0, 0, k) - mean;
    value -= flux / s;
  }
  for (double& v : scratch.column) v -= sum / nz;
  return mean;
}

FftSolver::FftSolver(const EllipticProblem& problem, const FftOptions& options)
    : EllipticSolver(problem), options_(options) {
  update(problem);
}

std::size_t FftSolver::estimate_memory(const EllipticProblem& problem, int threads) {
  std::size_t bytes = 0;
  for (int block = 0; block < problem.blocks(); ++block) {
    bytes += FftScalarSolver::estimate_memory(problem.component(block), threads);
  }
  return bytes;
}

void FftSolver::do_update(const EllipticProblem& problem) {
  if (problem.form != EllipticForm::laplacian || !problem.mu.is_constant()) {
    throw std::invalid_argument(message("elliptic solver: 'fft' cannot solve the ", vesiflow::fluid::name(problem.form),
                                        " form with ", problem.mu.is_constant() ? "constant" : "variable",
                                        " viscosity; use 'pcg' (which can take 'fft' as its preconditioner), "
                                        "'cholmod' or 'auto'"));
  }
  const bool planned = !blocks_.empty() && problem.same_structure(this->problem());
  if (!planned) blocks_.clear();
  for (int block = 0; block < problem.blocks(); ++block) {
    const EllipticProblem component = problem.component(block);
    if (planned) {
      blocks_[block]->update(component);
    } else {
      blocks_.push_back(std::make_unique<FftScalarSolver>(component));
    }
  }
}

SolveReport FftSolver::do_solve(ConstBlocks rhs, Blocks x) {
  SolveReport report;
  for (int block = 0; block < x.count(); ++block) {
    report.removed_mean[block] = blocks_[block]->solve(rhs[block], x[block]);
  }
  return report;
}

}  // namespace vesiflow::fluid
