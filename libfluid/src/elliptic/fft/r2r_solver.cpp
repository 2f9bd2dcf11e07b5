// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "elliptic/fft/r2r_solver.h"

#include <algorithm>

#include "elliptic/fft/eigenbasis.h"
#include "elliptic/fft/fftw_plan.h"

namespace vesiflow::fluid {
namespace {

fftw_r2r_kind kind(Basis basis, Direction direction) {
  const bool forward = direction == Direction::forward;
  switch (basis) {
    case Basis::sine_points:
      return FFTW_RODFT00;
    case Basis::sine_cells:
      return forward ? FFTW_RODFT10 : FFTW_RODFT01;
    case Basis::cosine_cells:
      return forward ? FFTW_REDFT10 : FFTW_REDFT01;
    case Basis::mixed_cells:
      return FFTW_REDFT11;
    default:
      return forward ? FFTW_R2HC : FFTW_HC2R;
  }
}

std::size_t count(const std::array<int, 3>& extent) {
  return static_cast<std::size_t>(extent[0]) * extent[1] * extent[2];
}

}  // namespace

struct R2rSolver::Plans {
  Plans(const EllipticProblem& problem, double* work)
      : forward([&] { return make(problem, Direction::forward, work); }),
        backward([&] { return make(problem, Direction::backward, work); }) {}

  // FFTW counts the slowest axis first.
  static fftw_plan make(const EllipticProblem& problem, Direction direction, double* work) {
    const auto n = problem.extent();
    return fftw_plan_r2r_3d(n[2], n[1], n[0], work, work, kind(eigenbasis(problem, 2), direction),
                            kind(eigenbasis(problem, 1), direction), kind(eigenbasis(problem, 0), direction),
                            FFTW_ESTIMATE);
  }

  FftwPlan forward, backward;
};

R2rSolver::R2rSolver(const EllipticProblem& problem)
    : extent_(problem.extent()),
      work_(allocate_aligned(count(extent_))),
      plans_(std::make_unique<Plans>(problem, work_.get())) {
  for (int axis = 0; axis < 3; ++axis) {
    eigenvalues_[axis] = eigenvalues(problem, axis);
    normalisation_ /= LineTransform<double>::pair_factor(eigenbasis(problem, axis), extent_[axis]);
  }
  R2rSolver::update(problem);
}

R2rSolver::~R2rSolver() = default;

void R2rSolver::update(const EllipticProblem& problem) {
  alpha_ = problem.alpha;
  mu_ = problem.mu.value();
  nullspace_ = problem.has_nullspace();
}

std::size_t R2rSolver::estimate_memory(const EllipticProblem& problem) {
  return sizeof(double) * problem.unknowns();
}

double R2rSolver::solve(ConstView rhs, View x, const ConstView* base) {
  const int nx = extent_[0], ny = extent_[1], nz = extent_[2];
  const auto row = [&](int j, int k) { return work_.get() + (static_cast<std::ptrdiff_t>(k) * ny + j) * nx; };
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) std::copy_n(rhs.row(j, k), nx, row(j, k));
  }
  fftw_execute(plans_->forward.get());
  // The transform of a constant is in the first mode alone.
  const double mean = nullspace_ ? work_[0] * normalisation_ : 0.0;
  divide();
  if (nullspace_) work_[0] = 0.0;
  fftw_execute(plans_->backward.get());
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) x(i, j, k) = base != nullptr ? (*base)(i, j, k) + row(j, k)[i] : row(j, k)[i];
    }
  }
  return mean;
}

void R2rSolver::divide() {
  const auto [nx, ny, nz] = extent_;
  double* value = work_.get();
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j, value += nx) {
      const double base = alpha_ + mu_ * (eigenvalues_[2][k] + eigenvalues_[1][j]);
      for (int i = 0; i < nx; ++i) value[i] *= normalisation_ / (base + mu_ * eigenvalues_[0][i]);
    }
  }
}

}  // namespace vesiflow::fluid
