// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "elliptic/cholmod/cholmod_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "message.h"

namespace vesiflow::fluid {
namespace {

// Supernodal factorisation on one core (2.6 GHz, AVX2, OpenBLAS): the products, and the traffic of small supernodes.
// Factorisations of 16^3 to 64^3 unknowns took 0.5 to 1.4 times what these give.
constexpr double flops_per_second = 1.5e10;
constexpr double bytes_per_second = 2.5e8;

}  // namespace

double FactorEstimate::seconds() const {
  return flops / flops_per_second + bytes / bytes_per_second;
}

// By nested dissection of a box whose two shorter axes have n1 and n2 cells, a column of the factor has of the order of
// sqrt(n1 n2) entries for each unknown of a cell (George 1973). A periodic axis takes two cuts where one would do.
FactorEstimate rule_of_thumb(const EllipticProblem& problem) {
  struct Constants {
    double entries, flops;
  };
  const auto [entries, flops] = problem.form == EllipticForm::stress ? Constants{26.0, 32.0} : Constants{10.0, 4.5};
  double cuts_entries = 1.0;
  double cuts_flops = 1.0;
  std::array<int, 3> cells = problem.grid.cells;
  std::sort(cells.begin(), cells.end());
  for (const bool periodic : problem.grid.periodic) {
    if (!periodic) continue;
    cuts_entries *= 1.3;
    cuts_flops *= 1.6;
  }
  const double across = std::sqrt(static_cast<double>(cells[0]) * cells[1]);
  const auto n = static_cast<double>(problem.unknowns());
  return {sizeof(double) * cuts_entries * entries * n * across, cuts_flops * flops * n * std::pow(across, 3)};
}

void check_limits(const EllipticProblem& problem, const FactorEstimate& estimate, const CholmodOptions& options,
                  double slack) {
  const bool constant = problem.form == EllipticForm::laplacian && problem.mu.is_constant();
  const char* alternatives = constant ? "use a smaller grid, or 'fft', which solves this problem exactly"
                                      : "use a smaller grid, or 'pcg' with 'fft' as preconditioner";
  if (estimate.bytes > slack * options.memory_limit) {
    throw std::invalid_argument(message("elliptic solver: 'cholmod' would need about ", estimate.bytes / 1e9,
                                        " GB for ", problem.unknowns(), " unknowns, memory_limit is ",
                                        options.memory_limit / 1e9, " GB; raise it, ", alternatives));
  }
  if (estimate.seconds() > slack * options.time_limit) {
    throw std::invalid_argument(message("elliptic solver: 'cholmod' would take about ", estimate.seconds(),
                                        " s to factor ", problem.unknowns(), " unknowns (", estimate.flops / 1e9,
                                        " Gflop), time_limit is ", options.time_limit, " s; raise it, ", alternatives));
  }
}

void check_limits(const EllipticProblem& problem, const CholmodOptions& options) {
  constexpr double slack_of_the_rule = 2.0;
  check_limits(problem, rule_of_thumb(problem), options, slack_of_the_rule);
}

}  // namespace vesiflow::fluid
