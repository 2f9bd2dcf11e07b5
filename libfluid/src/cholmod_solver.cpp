#include "cholmod_solver.h"

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "message.h"

namespace vesiflow::fluid {
namespace {

// Number of unknowns that are factored. With a nullspace the last unknown is held at zero (grounded): what is
// left is positive definite, and its solution differs from the one of zero mean by a constant.
std::size_t factored_unknowns(const EllipticProblem& problem) {
  return problem.unknowns() - (problem.has_nullspace() ? 1 : 0);
}

// Appends entries of the lower triangle by columns.
class LowerTriangle {
 public:
  LowerTriangle(cholmod_sparse& matrix) : matrix_(matrix) {}

  void begin_column(SuiteSparse_long column) { columns()[column] = count_; }
  void add(SuiteSparse_long row, double value) {
    if (row >= static_cast<SuiteSparse_long>(matrix_.nrow)) return;  // the grounded unknown
    static_cast<SuiteSparse_long*>(matrix_.i)[count_] = row;
    static_cast<double*>(matrix_.x)[count_] = value;
    ++count_;
  }
  void finish() { columns()[matrix_.ncol] = count_; }

 private:
  SuiteSparse_long* columns() { return static_cast<SuiteSparse_long*>(matrix_.p); }
  cholmod_sparse& matrix_;
  SuiteSparse_long count_ = 0;
};

double end_diagonal(const EllipticProblem& problem, int axis) {
  if (problem.boundary == BoundaryCondition::neumann) return 1.0;
  return is_face_normal(problem.centring(), axis) ? 2.0 : 3.0;
}

void assemble(const EllipticProblem& problem, cholmod_sparse& matrix) {
  const auto n = problem.extent();
  const std::array<SuiteSparse_long, 3> stride{1, n[0], static_cast<SuiteSparse_long>(n[0]) * n[1]};
  std::array<double, 3> scale{};
  for (int axis = 0; axis < 3; ++axis) scale[axis] = problem.mu.value() / std::pow(problem.grid.spacing(axis), 2);
  LowerTriangle entries(matrix);
  std::array<int, 3> index{};
  for (std::size_t column = 0; column < matrix.ncol; ++column) {
    double diagonal = problem.alpha;
    for (int axis = 0; axis < 3; ++axis) {
      const bool at_end = index[axis] == 0 || index[axis] == n[axis] - 1;
      diagonal += scale[axis] * (at_end ? end_diagonal(problem, axis) : 2.0);
    }
    const auto here = static_cast<SuiteSparse_long>(column);
    entries.begin_column(here);
    entries.add(here, diagonal);
    for (int axis = 0; axis < 3; ++axis) {
      if (index[axis] + 1 < n[axis]) entries.add(here + stride[axis], -scale[axis]);
    }
    for (int axis = 0; axis < 3 && ++index[axis] == n[axis]; ++axis) index[axis] = 0;
  }
  entries.finish();
}

}  // namespace

// Owns CHOLMOD's objects. The solution and work arrays are kept between solves (cholmod_l_solve2).
struct CholmodSolver::Workspace {
  cholmod_common common{};
  cholmod_sparse* matrix = nullptr;
  cholmod_factor* factor = nullptr;
  cholmod_dense* rhs = nullptr;
  cholmod_dense* solution = nullptr;
  cholmod_dense* work_y = nullptr;
  cholmod_dense* work_e = nullptr;

  explicit Workspace(std::size_t n) {
    cholmod_l_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    matrix = cholmod_l_allocate_sparse(n, n, 4 * n, 1, 1, -1, CHOLMOD_REAL, &common);
    rhs = cholmod_l_allocate_dense(n, 1, n, CHOLMOD_REAL, &common);
    check("allocation");
  }
  ~Workspace() {
    cholmod_l_free_dense(&work_e, &common);
    cholmod_l_free_dense(&work_y, &common);
    cholmod_l_free_dense(&solution, &common);
    cholmod_l_free_dense(&rhs, &common);
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_free_sparse(&matrix, &common);
    cholmod_l_finish(&common);
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  void check(const char* what) const {
    if (common.status == CHOLMOD_OK) return;
    throw std::runtime_error(message("cholmod: ", what, " failed with status ", common.status,
                                     common.status == CHOLMOD_OUT_OF_MEMORY ? " (out of memory)" : ""));
  }
};

CholmodSolver::CholmodSolver(const EllipticProblem& problem, const CholmodOptions& options)
    : EllipticSolver(problem), options_(options) {
  update(problem);
}

CholmodSolver::~CholmodSolver() = default;

// Nested dissection of a cubic 7-point grid gives a factor of about 10 n^(4/3) numbers (measured from 32^3 to
// 64^3).
std::size_t CholmodSolver::estimate_memory(const EllipticProblem& problem) {
  return static_cast<std::size_t>(10 * sizeof(double) * std::pow(static_cast<double>(problem.unknowns()), 4.0 / 3.0));
}

void CholmodSolver::do_update(const EllipticProblem& problem) {
  const std::size_t n = factored_unknowns(problem);
  const bool analysed = workspace_ && problem.same_structure(this->problem()) && workspace_->matrix->nrow == n;
  if (analysed && problem.alpha == this->problem().alpha && problem.mu.value() == this->problem().mu.value()) return;
  if (!analysed) {
    const auto bytes = static_cast<double>(estimate_memory(problem));
    if (bytes > options_.memory_limit) {
      throw std::invalid_argument(message("elliptic solver: 'cholmod' would need about ", bytes / 1e9, " GB for ",
                                          problem.unknowns(), " unknowns, the limit is ", options_.memory_limit / 1e9,
                                          " GB; raise memory_limit, use a smaller grid, or use 'fft'"));
    }
    workspace_ = std::make_unique<Workspace>(n);
  }
  Workspace& w = *workspace_;
  assemble(problem, *w.matrix);
  if (!analysed) {
    w.factor = cholmod_l_analyze(w.matrix, &w.common);
    w.check("analysis");
  }
  cholmod_l_factorize(w.matrix, w.factor, &w.common);
  w.check("factorisation");
}

SolveReport CholmodSolver::do_solve(ConstBlocks rhs_blocks, Blocks x_blocks) {
  const ConstView rhs = rhs_blocks[0];
  const View x = x_blocks[0];
  Workspace& w = *workspace_;
  const auto n = problem().extent();
  const std::size_t factored = w.matrix->nrow;
  const auto count = static_cast<double>(problem().unknowns());
  const auto for_each_row = [&](auto&& visit) {
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) visit(j, k, (static_cast<std::size_t>(k) * n[1] + j) * n[0]);
    }
  };
  SolveReport report;
  if (problem().has_nullspace()) {
    for_each_row([&](int j, int k, std::size_t) {
      for (int i = 0; i < n[0]; ++i) report.removed_mean[0] += rhs(i, j, k) / count;
    });
  }
  auto* b = static_cast<double*>(w.rhs->x);
  for_each_row([&](int j, int k, std::size_t start) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(n[0]) && start + i < factored; ++i) {
      b[start + i] = rhs.row(j, k)[i] - report.removed_mean[0];
    }
  });
  cholmod_l_solve2(CHOLMOD_A, w.factor, w.rhs, nullptr, &w.solution, nullptr, &w.work_y, &w.work_e, &w.common);
  w.check("solve");
  const auto* solution = static_cast<const double*>(w.solution->x);
  double mean = 0.0;
  if (problem().has_nullspace()) {
    for (std::size_t m = 0; m < factored; ++m) mean += solution[m] / count;
  }
  for_each_row([&](int j, int k, std::size_t start) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(n[0]); ++i) {
      x.row(j, k)[i] = (start + i < factored ? solution[start + i] : 0.0) - mean;
    }
  });
  return report;
}

}  // namespace vesiflow::fluid
