// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// x and y are diagonalised by fast transforms, plane by plane; what remains are difference equations in z for
// every pair of modes. Eigenvalues are those of the difference operator, so that the solution is exact to
// round-off.
//
// A solve passes three times over the data (planes forward, slabs, planes backward), each time through a
// scratch array that fits a core's second-level cache. Every plane and slab is done by one thread in one way,
// so the bits do not depend on the number of threads.
#include "elliptic/fft/plane_solver.h"

#include <omp.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "elliptic/fft/eigenbasis.h"
#include "grid/planes.h"

namespace vesiflow::fluid {
namespace {

std::array<int, 2> plane(const std::array<int, 3>& extent) {
  return {extent[0], extent[1]};
}

std::array<Basis, 2> plane_basis(const EllipticProblem& problem) {
  return {eigenbasis(problem, 0), eigenbasis(problem, 1)};
}

// How many columns of n numbers are solved at a time: 128 KiB of them, in whole cache lines, but not less than half a KiB
// of each row.
template <class Scalar>
int column_width(const std::array<int, 3>& extent) {
  constexpr int line = static_cast<int>(64 / sizeof(Scalar));
  const int width = (2048 * line / extent[2] + line - 1) / line * line;
  return std::min(extent[0], std::max(width, 8 * line));
}

// Of work: whole lines, and planes a line apart from where they would compete for the same cache sets.
template <class Scalar>
std::ptrdiff_t work_plane(const std::array<int, 3>& extent) {
  return padded<Scalar>(extent[0]) * extent[1] + static_cast<std::ptrdiff_t>(64 / sizeof(Scalar));
}

}  // namespace

template <class Scalar>
PlaneSolver<Scalar>::Scratch::Scratch(const PlaneSolver& solver)
    : transform(allocate_aligned<Scalar>(Plan::scratch_size(plane(solver.extent_), solver.basis_))),
      columns(solver.columns_),
      shift(solver.width_) {}

template <class Scalar>
PlaneSolver<Scalar>::PlaneSolver(const EllipticProblem& problem, std::shared_ptr<Scalar[]> work)
    : extent_(problem.extent()),
      basis_(plane_basis(problem)),
      forward_(plane(extent_), basis_, Direction::forward),
      backward_(plane(extent_), basis_, Direction::backward),
      width_(column_width<Scalar>(extent_)),
      columns_(extent_[2], eigenbasis(problem, 2), width_),
      eigenvalues_{eigenvalues(problem, 0), eigenvalues(problem, 1)},
      z_coupling_(1.0 / (problem.grid.spacing(2) * problem.grid.spacing(2))),
      normalisation_(1.0 / (LineTransform<Scalar>::pair_factor(basis_[0], extent_[0]) *
                            LineTransform<Scalar>::pair_factor(basis_[1], extent_[1]))),
      work_(std::move(work)) {
  PlaneSolver::update(problem);
}

template <class Scalar>
std::size_t PlaneSolver<Scalar>::work_size(const EllipticProblem& problem) {
  if (std::is_same_v<Scalar, double>) return 0;
  return static_cast<std::size_t>(work_plane<Scalar>(problem.extent()) * problem.extent()[2]);
}

template <class Scalar>
std::size_t PlaneSolver<Scalar>::estimate_memory(const EllipticProblem& problem, int threads) {
  const auto n = problem.extent();
  const int width = column_width<Scalar>(n);
  const std::size_t numbers =
      Plan::scratch_size(plane(n), plane_basis(problem)) + ColumnSolver<Scalar>::scratch_size(n[2], width);
  return threads * (sizeof(Scalar) * numbers + sizeof(double) * width) + sizeof(double) * (n[0] + n[1]);
}

template <class Scalar>
void PlaneSolver<Scalar>::update(const EllipticProblem& problem) {
  alpha_ = problem.alpha;
  mu_ = problem.mu.value();
  while (static_cast<int>(scratch_.size()) < omp_get_max_threads()) scratch_.emplace_back(*this);
}

template <>
PlaneSolver<double>::Modes PlaneSolver<double>::modes_in(View x) const {
  return {x.data, x.row_stride, x.plane_stride};
}

template <>
PlaneSolver<float>::Modes PlaneSolver<float>::modes_in(View) const {
  return {work_.get(), padded<float>(extent_[0]), work_plane<float>(extent_)};
}

template <class Scalar>
double PlaneSolver<Scalar>::solve(ConstView rhs, View x, const ConstView* base) {
  using Numbers = typename Plan::template Rows<const double>;
  double removed_mean = 0.0;
  const Modes modes = modes_in(x);
  const auto forward = [&](int k, Scratch& scratch) {
    forward_.template execute<double, Scalar>({rhs.row(0, k), rhs.row_stride}, {modes.row(0, k), modes.row_stride}, {},
                                              scratch.transform.get());
  };
  const auto solve = [&](int j, Scratch& scratch) {
    const double mean = solve_slab(modes, j, scratch);
    if (j == 0) removed_mean = mean;
  };
  const auto backward = [&](int k, Scratch& scratch) {
    const Numbers added = base != nullptr ? Numbers{base->row(0, k), base->row_stride} : Numbers{};
    backward_.template execute<Scalar, double>({modes.row(0, k), modes.row_stride}, {x.row(0, k), x.row_stride}, added,
                                               scratch.transform.get());
  };
  if (worth_threads(extent_)) {
    const int threads = std::min(static_cast<int>(scratch_.size()), omp_get_max_threads());
    keep_waits_short();
#pragma omp parallel num_threads(threads)
    {
      Scratch& scratch = scratch_[omp_get_thread_num()];
#pragma omp for schedule(static)
      for (int k = 0; k < extent_[2]; ++k) forward(k, scratch);
#pragma omp for schedule(static)
      for (int j = 0; j < extent_[1]; ++j) solve(j, scratch);
#pragma omp for schedule(static)
      for (int k = 0; k < extent_[2]; ++k) backward(k, scratch);
    }
  } else {
    Scratch& scratch = scratch_.front();
    for (int k = 0; k < extent_[2]; ++k) forward(k, scratch);
    for (int j = 0; j < extent_[1]; ++j) solve(j, scratch);
    for (int k = 0; k < extent_[2]; ++k) backward(k, scratch);
  }
  return removed_mean;
}

// All modes of x at one mode j of y, as many at a time as fit the cache.
template <class Scalar>
double PlaneSolver<Scalar>::solve_slab(const Modes& modes, int j, Scratch& scratch) const {
  double removed_mean = 0.0;
  for (int first = 0; first < extent_[0]; first += width_) {
    const int columns = std::min(width_, extent_[0] - first);
    for (int i = 0; i < columns; ++i) {
      scratch.shift[i] = alpha_ + mu_ * (eigenvalues_[0][first + i] + eigenvalues_[1][j]);
    }
    removed_mean += columns_.solve(modes.row(j, 0) + first, modes.plane_stride, columns, scratch.shift.data(),
                                   mu_ * z_coupling_, normalisation_, scratch.columns);
  }
  return removed_mean;
}

template class PlaneSolver<double>;
template class PlaneSolver<float>;

}  // namespace vesiflow::fluid
