// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What solvers are measured against: FFTW's three-dimensional real-to-real transforms, and the memory bandwidth.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <fftw3.h>

#include "fluid/elliptic_problem.h"

namespace vesiflow::bench {

// FFTW's transform there and back for the unknowns of a scalar problem, in place, without the division by the
// eigenvalues.
class R2rPair {
 public:
  // planning: FFTW_ESTIMATE, FFTW_MEASURE, ...
  R2rPair(const fluid::EllipticProblem& problem, unsigned planning) {
    const auto n = problem.extent();
    count_ = problem.unknowns();
    data_ = fftw_alloc_real(count_);
    const auto plan = [&](bool forward) {
      return fftw_plan_r2r_3d(n[2], n[1], n[0], data_, data_, kind(problem, 2, forward), kind(problem, 1, forward),
                              kind(problem, 0, forward), planning);
    };
    forward_ = plan(true);
    backward_ = plan(false);
  }
  ~R2rPair() {
    fftw_destroy_plan(forward_);
    fftw_destroy_plan(backward_);
    fftw_free(data_);
  }
  R2rPair(const R2rPair&) = delete;
  R2rPair& operator=(const R2rPair&) = delete;

  void execute() {
    std::fill_n(data_, 1, 1.0);
    fftw_execute(forward_);
    fftw_execute(backward_);
  }
  void clear() { std::fill_n(data_, count_, 0.0); }

 private:
  static fftw_r2r_kind kind(const fluid::EllipticProblem& problem, int axis, bool forward) {
    if (problem.grid.periodic[axis]) return forward ? FFTW_R2HC : FFTW_HC2R;
    if (problem.boundary == fluid::BoundaryCondition::neumann) return forward ? FFTW_REDFT10 : FFTW_REDFT01;
    if (is_face_normal(problem.centring(), axis)) return FFTW_RODFT00;
    if (problem.grid.mirror[axis]) return FFTW_REDFT11;
    return forward ? FFTW_RODFT10 : FFTW_RODFT01;
  }

  double* data_;
  std::size_t count_;
  fftw_plan forward_, backward_;
};

// a = b + 3 c of arrays that fit no cache.
class Triad {
 public:
  Triad() : a_(count, 0.0), b_(count, 1.0), c_(count, 2.0) {}
  void execute(int threads) {
    const double* b = b_.data();
    const double* c = c_.data();
    double* a = a_.data();
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::size_t i = 0; i < count; ++i) a[i] = b[i] + 3.0 * c[i];
  }
  // Gigabytes per second, counting the line of a that is read before it is written.
  static double rate(double milliseconds) {
    return 32e-6 * static_cast<double>(count) / milliseconds;
  }

 private:
  static constexpr std::size_t count = std::size_t{1} << 22;
  std::vector<double> a_, b_, c_;
};

}  // namespace vesiflow::bench
