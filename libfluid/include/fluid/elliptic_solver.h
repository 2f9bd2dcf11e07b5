// Solvers of EllipticProblem behind one interface, and the factory that makes them.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "fluid/elliptic_problem.h"
#include "fluid/view.h"

namespace vesiflow::fluid {

struct SolveReport {
  int iterations = 0;              // zero for direct solvers
  bool converged = true;           // direct solvers always are
  std::optional<double> residual;  // relative, if the solver computes it; see also relative_residual()
  double removed_mean = 0.0;       // what was subtracted from b to make it compatible (problems with a nullspace)
  double seconds = 0.0;            // wall time of this solve
};

// One problem at a time: update() takes it, solve() solves it for as many right-hand sides as wanted.
// A solver may be used by one thread at a time; inside it uses omp_get_max_threads() threads, but no more
// than that was at its last update().
class EllipticSolver {
 public:
  virtual ~EllipticSolver() = default;
  EllipticSolver(const EllipticSolver&) = delete;
  EllipticSolver& operator=(const EllipticSolver&) = delete;

  // Plans or factors for a problem; may allocate. Cheap if the problem is the same. If only alpha or mu
  // differ, "fft" just notes the numbers and "cholmod" factors again with the ordering it has.
  void update(const EllipticProblem& problem);

  // Solves for x. rhs and x have the shape of problem().extent(); they may be the same array but not overlap
  // otherwise. Does not allocate (but FFTW does within "fft", for
  // a number of cells with a prime factor above 31). Throws std::invalid_argument for a wrong shape and std::runtime_error if
  // the solution is not finite, which happens exactly if rhs is not (or overflows).
  SolveReport solve(ConstView rhs, View x);

  const EllipticProblem& problem() const { return problem_; }
  virtual std::string name() const = 0;

 protected:
  explicit EllipticSolver(const EllipticProblem& problem) : problem_(problem) {}

 private:
  virtual void do_update(const EllipticProblem& problem) = 0;
  virtual SolveReport do_solve(ConstView rhs, View x) = 0;

  EllipticProblem problem_;
};

// Fast sine and cosine transforms in x and y with the eigenvalues of the discrete operator, and a tridiagonal
// solve in z. O(n log n), exact to round-off. The same bits for any number of threads.
struct FftOptions {};

// Sparse Cholesky factorisation (SuiteSparse CHOLMOD, supernodal). Independent of FFTW; for small grids.
// Needs the build option VESIFLOW_WITH_CHOLMOD.
struct CholmodOptions {
  double memory_limit = 2e9;  // bytes; problems whose factor is estimated larger are refused
};

using SolverOptions = std::variant<FftOptions, CholmodOptions>;

// A solver updated to the problem. Throws std::invalid_argument, naming the alternatives, for what the build
// or the backend cannot do.
std::unique_ptr<EllipticSolver> make_elliptic_solver(const EllipticProblem& problem, const SolverOptions& options);

// Bytes a solver will take for a problem with the present omp_get_max_threads(): the work arrays of "fft"
// (FFTW's own tables are small), an empirical rule for "cholmod". Nothing is allocated.
std::size_t estimate_solver_memory(const EllipticProblem& problem, const SolverOptions& options);

}  // namespace vesiflow::fluid
