// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "elliptic/cholmod/cholmod_solver.h"

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "elliptic/cholmod/cholmod_blas.h"
#include "elliptic/cholmod/cholmod_estimate.h"
#include "message.h"
#include "operators/sparse_operator.h"

namespace vesiflow::fluid {
namespace {

static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));

const CholmodOptions& checked(const CholmodOptions& options) {
  const auto check = [](const char* what, double value, bool good, const char* allowed) {
    if (!good) throw std::invalid_argument(message("elliptic solver: ", what, " of 'cholmod' is ", value, allowed));
  };
  check("memory_limit", options.memory_limit, options.memory_limit > 0.0, "; it must be > 0");
  check("time_limit", options.time_limit, options.time_limit > 0.0, "; it must be > 0");
  check("refactor.every", static_cast<double>(options.refactor.every), options.refactor.every >= 0,
        "; it must be >= 1, or 0 for never");
  check("refactor.change", options.refactor.change, options.refactor.change >= 0.0, "; it must be >= 0");
  return options;
}

// METIS draws from the C library's rand(), which it seeds: of two analyses at a time each would draw what the other
// misses, and orderings, and with them the last bits of solutions, would depend on who is faster.
std::mutex one_analysis;

}  // namespace

// Owns the matrix and CHOLMOD's objects. The solution and work arrays are kept between solves (cholmod_l_solve2).
struct CholmodSolver::Workspace {
  SparseOperator matrix;
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense* rhs = nullptr;
  cholmod_dense* solution = nullptr;
  cholmod_dense* work_y = nullptr;
  cholmod_dense* work_e = nullptr;

  explicit Workspace(const EllipticProblem& problem) : matrix(problem) {
    cholmod_l_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
  }
  ~Workspace() {
    cholmod_l_free_dense(&work_e, &common);
    cholmod_l_free_dense(&work_y, &common);
    cholmod_l_free_dense(&solution, &common);
    cholmod_l_free_dense(&rhs, &common);
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  // With CHOLMOD's default ordering: AMD, and METIS where that fills in much (docs/studies/libfluid.md,
  // bench/orderings).
  void analyse() {
    const std::lock_guard alone(one_analysis);
    cholmod_sparse view = matrix_view();
    factor = cholmod_l_analyze(&view, &common);
    check("analysis");
  }

  // Of the factor analysed.
  FactorEstimate estimate() const {
    const auto numbers = static_cast<double>(factor->xsize + factor->maxcsize + factor->ssize + factor->maxesize);
    return {8.0 * (numbers + 6.0 * static_cast<double>(factor->n)) + 16.0 * static_cast<double>(matrix.entries()),
            common.fl};
  }

  void factorise() {
    const OneBlasThread one_thread;
    cholmod_sparse view = matrix_view();
    cholmod_l_factorize(&view, factor, &common);
    check("factorisation");
    if (rhs == nullptr) {
      rhs = cholmod_l_zeros(factor->n, 1, CHOLMOD_REAL, &common);
      check("allocation");
      solve();  // allocates the solution and the work arrays
    }
  }

  void solve() {
    const OneBlasThread one_thread;
    cholmod_l_solve2(CHOLMOD_A, factor, rhs, nullptr, &solution, nullptr, &work_y, &work_e, &common);
    check("solve");
  }

  // Subtracts from each block its mean, and returns these.
  std::array<double, 3> remove_means(double* x) const {
    const auto& start = matrix.block_starts();
    std::array<double, 3> means{};
    for (int block = 0; block < 3 && start[block] < start[block + 1]; ++block) {
      for (std::int64_t m = start[block]; m < start[block + 1]; ++m) means[block] += x[m];
      means[block] /= static_cast<double>(start[block + 1] - start[block]);
      for (std::int64_t m = start[block]; m < start[block + 1]; ++m) x[m] -= means[block];
    }
    return means;
  }
  void zero_grounded(double* x) const {
    const auto& start = matrix.block_starts();
    for (int block = 0; block < 3 && start[block] < start[block + 1]; ++block) x[start[block + 1] - 1] = 0.0;
  }

  cholmod_sparse matrix_view() {
    cholmod_sparse view{};
    view.nrow = view.ncol = static_cast<std::size_t>(matrix.size());
    view.nzmax = matrix.entries();
    view.p = matrix.column_starts().data();
    view.i = matrix.rows().data();
    view.x = matrix.values().data();
    view.stype = -1;  // symmetric, lower triangle
    view.itype = CHOLMOD_LONG;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    return view;
  }

  void check(const char* what) const {
    if (common.status == CHOLMOD_OK) return;
    throw std::runtime_error(message("cholmod: ", what, " failed with status ", common.status,
                                     common.status == CHOLMOD_OUT_OF_MEMORY ? " (out of memory)" : "",
                                     common.status == CHOLMOD_NOT_POSDEF ? " (not positive definite)" : ""));
  }
};

CholmodSolver::Coefficients::Coefficients(const EllipticProblem& problem)
    : alpha_(problem.alpha), has_nullspace_(problem.has_nullspace()) {
  if (problem.mu.is_constant()) {
    mu_.assign(1, problem.mu.value());
  } else {
    mu_.assign(problem.mu.field().data(), problem.mu.field().data() + problem.mu.field().size());
  }
}

bool CholmodSolver::Coefficients::moved(const EllipticProblem& problem, double fraction) const {
  const auto differ = [fraction](double value, double factored) {
    return std::abs(value - factored) > fraction * factored;
  };
  if (has_nullspace_ != problem.has_nullspace() || differ(problem.alpha, alpha_)) return true;
  const bool constant = problem.mu.is_constant();
  const std::size_t count = constant ? mu_.size() : problem.mu.field().size();
  for (std::size_t i = 0; i < count; ++i) {
    const double value = constant ? problem.mu.value() : problem.mu.field().data()[i];
    if (differ(value, mu_.size() == 1 ? mu_[0] : mu_[i])) return true;
  }
  return false;
}

CholmodSolver::CholmodSolver(const EllipticProblem& problem, const CholmodOptions& options)
    : EllipticSolver(problem), options_(checked(options)) {
  update(problem);
}

CholmodSolver::~CholmodSolver() = default;

// The factor of a singular problem, with its grounded unknowns, cannot stand in for that of a regular one, nor the other
// way round: then the policy has no say.
bool CholmodSolver::needs_factorisation(const EllipticProblem& problem) const {
  if (problem.has_nullspace() != this->problem().has_nullspace()) return true;
  const auto& [every, change] = options_.refactor;
  return every > 0 && updates_since_ >= every && factored_.moved(problem, change);
}

void CholmodSolver::do_update(const EllipticProblem& problem) {
  ++updates_since_;
  if (!may_reuse()) {
    check_limits(problem, options_);
    auto fresh = std::make_unique<Workspace>(problem);
    fresh->analyse();
    check_limits(problem, fresh->estimate(), options_, 1.0);
    workspace_ = std::move(fresh);
  } else if (needs_factorisation(problem)) {
    workspace_->matrix.update(problem);
  } else {
    return;
  }
  workspace_->factorise();
  factored_ = Coefficients(problem);
  updates_since_ = 0;
  ++factorisations_;
}

SolveReport CholmodSolver::do_solve(ConstBlocks rhs, Blocks x) {
  Workspace& w = *workspace_;
  const bool singular = problem().has_nullspace();
  SolveReport report;
  auto* b = static_cast<double*>(w.rhs->x);
  for (const ConstView& view : rhs) {
    for (int k = 0; k < view.extent[2]; ++k) {
      for (int j = 0; j < view.extent[1]; ++j) b = std::copy_n(view.row(j, k), view.extent[0], b);
    }
  }
  if (singular) {
    report.removed_mean = w.remove_means(static_cast<double*>(w.rhs->x));
    w.zero_grounded(static_cast<double*>(w.rhs->x));
  }
  w.solve();
  auto* solution = static_cast<double*>(w.solution->x);
  if (singular) w.remove_means(solution);
  for (const View& view : x) {
    for (int k = 0; k < view.extent[2]; ++k) {
      for (int j = 0; j < view.extent[1]; ++j, solution += view.extent[0]) {
        std::copy_n(solution, view.extent[0], view.row(j, k));
      }
    }
  }
  return report;
}

}  // namespace vesiflow::fluid
