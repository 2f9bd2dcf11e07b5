// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// Solvers of EllipticProblem behind one interface, and the factory that makes them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "fluid/elliptic_problem.h"
#include "fluid/export.h"
#include "fluid/view.h"

namespace vesiflow::fluid {

/// What a solve did.
struct SolveReport {
  int iterations = 0;     ///< zero for direct solvers
  bool converged = true;  ///< direct solvers always are

  /// |b - A x| / |b| (2-norms), if the solver computes it; see also relative_residual().
  std::optional<double> residual;
  /// Per block: subtracted from b to make it compatible (if there is a nullspace).
  std::array<double, 3> removed_mean{};
  double seconds = 0.0;  ///< wall time of this solve, in seconds
};

/// A solver of one problem at a time: update() takes it, solve() solves it for as many right-hand sides as wanted.
///
/// A solver may be used by one thread at a time; inside it uses omp_get_max_threads() threads, but no more than that
/// was at its last update().
class VESIFLOW_FLUID_EXPORT EllipticSolver {
 public:
  virtual ~EllipticSolver() = default;
  EllipticSolver(const EllipticSolver&) = delete;
  EllipticSolver& operator=(const EllipticSolver&) = delete;

  /// Plans or factors for a problem; may allocate. Cheap if the problem is the same. If only alpha or mu differ, "fft"
  /// just notes the numbers and "cholmod" factors again with the ordering it has. The values of a field mu may have
  /// changed since the last time.
  /// \throws std::invalid_argument with the place if one is not finite and > 0.
  void update(const EllipticProblem& problem);

  /// Solves for x. Iterative solvers start from x, unless it is rhs: then from zero. Does not allocate (but FFTW does
  /// within "fft", for a number of cells with a prime factor above 31 and in its own real-to-real plans). An iteration
  /// that has not converged is reported.
  /// \param rhs b, one view per block of the problem, each of the shape of problem().extent(block).
  /// \param x the solution, in views of the same shapes. They may be the same arrays as rhs but not overlap otherwise.
  /// \throws std::invalid_argument for a wrong shape.
  /// \throws std::runtime_error if the solution is not finite, which happens exactly if rhs (or the x to start from) is
  /// not, or overflows.
  SolveReport solve(ConstBlocks rhs, Blocks x);

  /// The same for x = base + the solution, which saves a pass over memory where base is what the solution corrects.
  /// Iterative solvers start from zero. x may be the arrays of rhs, but not those of base.
  /// \throws std::invalid_argument and std::runtime_error as solve().
  SolveReport add_solution(ConstBlocks rhs, ConstBlocks base, Blocks x);

  const EllipticProblem& problem() const { return problem_; }  ///< the problem of the last update()

  /// Name of the backend: "fft", "pcg+cholmod", ...
  virtual std::string name() const = 0;
  /// Wall seconds spent in update() since construction.
  double update_seconds() const { return update_seconds_; }
  /// How often a factorisation was done since construction (0 for "fft").
  virtual int factorisations() const { return 0; }

 protected:
  /// Takes a first problem; update() must follow.
  explicit EllipticSolver(const EllipticProblem& problem) : problem_(problem) {}
  /// Range of mu at the last update.
  const Viscosity::Range& viscosity_range() const { return viscosity_range_; }
  /// For do_update(): whether plans and arrays of the last one are there and suit the new problem.
  bool may_reuse() const { return may_reuse_; }

 private:
  void check_ready(ConstBlocks rhs, ConstBlocks x) const;
  virtual void do_update(const EllipticProblem& problem) = 0;
  virtual SolveReport do_solve(ConstBlocks rhs, Blocks x) = 0;
  virtual SolveReport do_add_solution(ConstBlocks rhs, ConstBlocks base, Blocks x);

  EllipticProblem problem_;
  Viscosity::Range viscosity_range_{};
  double update_seconds_ = 0.0;
  bool ready_ = false;  // the last update succeeded
  bool may_reuse_ = false;
};

/// Options of "fft": fast sine, cosine and Fourier transforms in x and y with the eigenvalues of the discrete operator,
/// and the difference equations in z by two sweeps. O(n log n), exact to round-off, for any mix of walls, periodic axes
/// and mirrors. For constant mu and the laplacian form. The same bits for any number of threads.
struct FftOptions {
  /// How the transforms are made.
  enum class Transforms {
    pairs_of_lines,  ///< complex FFTs of pairs of real lines, plane by plane in cache
    fftw_r2r  ///< FFTW's three-dimensional real-to-real plan as it is, serial: the reference to check and time against
  };
  /// In which numbers they and the sweeps along z are computed. Right-hand side and solution are double in any case.
  enum class Arithmetic {
    double_,  ///< as right-hand side and solution
    single  ///< half the traffic of memory and twice the numbers at a time, for an error of about 1e-6 of the solution:
            ///< for increments, residuals and preconditioners; with `pairs_of_lines` only
  };
  Transforms transforms = Transforms::pairs_of_lines;  ///< which transforms are taken
  Arithmetic arithmetic = Arithmetic::double_;         ///< in which numbers
};

/// When the factor of a matrix that has changed is computed anew: at an update() if it is at least the every-th since
/// the last factorisation, and alpha or mu somewhere differ enough from the factored ones. The default keeps the factor
/// exact. If a nullspace comes or goes with alpha, the factor is always computed anew.
struct RefactorPolicy {
  std::int64_t every = 1;  ///< updates from one factorisation to the next, at least; 0: never again
  double change = 0.0;     ///< fraction of the factored alpha or mu by more than which one must differ somewhere
};

/// Options of "cholmod": sparse Cholesky factorisation (SuiteSparse CHOLMOD, supernodal). Independent of FFTW; any
/// coefficients, both forms; for small grids. The matrix is analysed once, and then only factored for another alpha or
/// mu. With a policy that lets the factor lag, the solution is still that of the problem: the lagged factor then
/// preconditions conjugate gradients (PcgOptions with their default tolerance). The same bits for any number of
/// threads: OpenBLAS is kept to one meanwhile. Needs the build option VESIFLOW_WITH_CHOLMOD.
///
/// The limits are checked by a rule of thumb before any work (against twice the limit) and by CHOLMOD's own counts
/// after the analysis. The time is an estimate for one core at 15 Gflop/s and 0.25 GB/s of new memory.
struct CholmodOptions {
  double memory_limit = 2e9;  ///< bytes; problems whose factor is estimated larger are refused
  double time_limit = 600.0;  ///< seconds; problems whose factorisation is estimated to take longer are refused
  RefactorPolicy refactor;    ///< when the factor is computed anew
};

/// Options of "pcg": conjugate gradients for any problem, preconditioned by another solver for the same unknowns.
///
/// "fft" solves the laplacian form with a constant reference viscosity; where mu is a field, between two pointwise
/// scalings by about mu^(-1/4). The iterations to 1e-10 depend on the ratio of the largest viscosity to the smallest as
/// its power 0.3, and hardly on the grid: 25 for ratio 20 and 40 for ratio 100 in the laplacian form, 39 and 62 in the
/// stress form, 11 for a number mu in the stress form (measured for a smooth sphere, interface of two cells, 16^3 to
/// 48^3; random right-hand sides). Slow smooth modes show later: with alpha near 0 and the right-hand sides of a flow
/// the stress form took 46, 50 and 58 for ratio 20 on 32^3, 64^3 and 128^3, and 78, 86 and 106 for ratio 100
/// (validation/studies/viscosity_treatments.md).
///
/// "cholmod" solves the problem itself, with a factor that may lag.
struct PcgOptions {
  double tolerance = 1e-10;   ///< residual relative to the right-hand side (2-norms)
  int max_iterations = 1000;  ///< a solve that needs more is reported as not converged
  std::variant<FftOptions, CholmodOptions> preconditioner = FftOptions{};  ///< the other solver
  double reference_viscosity = 0.0;  ///< for "fft"; 0: the geometric mean of the smallest and the largest
};

/// Options of "auto", which chooses by problem and size: see choose_solver().
struct AutoOptions {
  double tolerance = 1e-10;   ///< that of PcgOptions, if the choice is iterative
  double memory_limit = 2e9;  ///< that of CholmodOptions
};

/// The options of one solver, which say which one it is.
using SolverOptions = std::variant<FftOptions, CholmodOptions, PcgOptions, AutoOptions>;

/// The solvers by name, for who reads or writes it: scenes, command lines, reports.
enum class SolverKind {
  automatic,  ///< AutoOptions
  fft,        ///< FftOptions
  cholmod,    ///< CholmodOptions
  pcg         ///< PcgOptions
};
/// The names, by SolverKind.
inline constexpr std::array<std::string_view, 4> solver_names{"auto", "fft", "cholmod", "pcg"};
/// Name of a solver.
constexpr const char* name(SolverKind kind) {
  return solver_names[static_cast<std::size_t>(kind)].data();  // of literals
}
/// A solver of a kind with the options that it has by default.
VESIFLOW_FLUID_EXPORT SolverOptions default_options(SolverKind kind);

/// Name of a solver: "fft", "cholmod", "auto"; of "pcg" with its preconditioner: "pcg+fft", "pcg+cholmod".
VESIFLOW_FLUID_EXPORT std::string name(const SolverOptions& options);

/// What "auto" takes for a problem, and why.
struct ChosenSolver {
  SolverOptions options;  ///< the solver
  std::string reason;     ///< why, in words
};
/// What "auto" takes for a problem, and why in words: "fft" where it is exact; else "cholmod" (in builds that have it)
/// if a factorisation is estimated to be faster than one solve by "pcg" with "fft", which happens for small grids and
/// very large ratios of viscosities; else the latter. A mu that changes at every step is assumed: one factorisation a
/// solve. A lagged factor does not pay: at 24^3 in the stress form, with ratio 20 and a sphere that has moved by half a
/// cell since, it takes 11 iterations and 0.39 s where "fft" takes 37 and 0.07 s.
/// \throws std::invalid_argument if a value of mu is not finite and > 0.
VESIFLOW_FLUID_EXPORT ChosenSolver choose_solver(const EllipticProblem& problem, const AutoOptions& options);

/// A solver updated to the problem.
/// \throws std::invalid_argument naming the alternatives for what the build or the backend cannot do.
VESIFLOW_FLUID_EXPORT std::unique_ptr<EllipticSolver> make_elliptic_solver(const EllipticProblem& problem,
                                                                           const SolverOptions& options);

/// Refuses what make_elliptic_solver() would refuse for the estimated size of a factor, before any work.
/// \throws std::invalid_argument with the estimate, the limit and the alternatives.
VESIFLOW_FLUID_EXPORT void check_solver_limits(const EllipticProblem& problem, const SolverOptions& options);

/// Bytes a solver will take for a problem with the present omp_get_max_threads(): the work arrays of "fft"
/// (FFTW's own tables are small), an empirical rule for "cholmod", good to a factor of 1.5. Nothing is allocated.
VESIFLOW_FLUID_EXPORT std::size_t estimate_solver_memory(const EllipticProblem& problem, const SolverOptions& options);

}  // namespace vesiflow::fluid
