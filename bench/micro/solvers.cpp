// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The solvers of elliptic problems beside each other: the pressure, one velocity solve of the laplacian form, and the stress
// form with a ball of 20 times the viscosity, for random right-hand sides; a table in Markdown.
//   OMP_NUM_THREADS=1 build/release/bench/solvers [--cells N...]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "fluid/elliptic_solver.h"
#include "test_problems.h"

namespace {

using namespace vesiflow::fluid;

SolverOptions pcg_with_lagged_factor() {
  CholmodOptions factor;
  factor.refactor = {.every = 0, .change = 0.0};
  PcgOptions options;
  options.preconditioner = factor;
  return options;
}

// The viscosity of a ball at x = centre.
Viscosity ball(const Grid& grid, double centre) {
  return sample_viscosity(grid, [&](const Vector3& r) {
    const double distance = std::hypot(r[0] - centre, r[1], r[2]) - 1.0;
    return 1.0 + 9.5 * (1.0 - std::tanh(distance / grid.spacing(0)));
  });
}

// Updates to the problem `now`, having been made for `before`, and solves: minima of three times.
void measure(const char* what, const EllipticProblem& before, const EllipticProblem& now,
             const SolverOptions& options) {
  const std::string backend = name(options);
  try {
    double update = 1e9, solve = 1e9, residual = 0.0;
    int iterations = 0;
    for (int repetition = 0; repetition < 3; ++repetition) {
      const auto solver = make_elliptic_solver(before, options);
      const double made = solver->update_seconds();
      solver->update(now);
      update = std::min(update, solver->update_seconds() - made);
      const test::Numbers b(now, 5);
      const test::Numbers x(now);
      const SolveReport report = solver->solve(b, x);
      solve = std::min(solve, report.seconds);
      iterations = report.iterations;
      residual = relative_residual(now, b, x);
    }
    const double megabytes = static_cast<double>(estimate_solver_memory(now, options)) / 1e6;
    std::printf("| %s | %s | %.2g | %.3g | %d | %.1e | %.3g |\n", what, backend.c_str(), 1e3 * update, 1e3 * solve,
                iterations, residual, megabytes);
  } catch (const std::invalid_argument& refusal) {
    std::printf("| %s | %s | %s |\n", what, backend.c_str(), refusal.what());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes{16, 24};
  CLI::App app{"Times, iterations, residuals and memory of each solver for three problems."};
  app.add_option("--cells", sizes, "numbers of cells along each edge")
      ->check(CLI::Range(4, 256))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const std::vector<SolverOptions> backends{FftOptions{}, CholmodOptions{}, PcgOptions{}, pcg_with_lagged_factor()};
  std::puts(
      "| problem | solver | update, ms | solve, ms | iterations | residual | memory, MB "
      "|\n|---|---|---|---|---|---|---|");
  for (const int cells : sizes) {
    const Grid grid({-2, -2, -2}, {2, 2, 2}, {cells, cells, cells});
    const EllipticProblem pressure(grid, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0);
    const auto velocity = [&](double alpha) {
      return EllipticProblem::velocity(grid, EllipticForm::laplacian, alpha, 20.0);
    };
    // The ball has moved by half a cell.
    const auto stress = [&](double centre) {
      return EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, ball(grid, centre));
    };
    const std::string size = " " + std::to_string(cells) + "^3";
    for (const SolverOptions& backend : backends) {
      measure(("pressure" + size).c_str(), pressure, pressure, backend);
      measure(("velocity, laplacian" + size).c_str(), velocity(1.0), velocity(1.1), backend);
      measure(("velocity, stress" + size).c_str(), stress(0.0), stress(0.5 * grid.spacing(0)), backend);
    }
  }
}
