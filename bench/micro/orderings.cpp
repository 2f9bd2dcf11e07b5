// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Orderings of CHOLMOD beside each other for the problems of bench/solvers: nonzeros and operations of the factor,
// which are counts, and times of analysis, factorisation and solve over those of the default; a table in Markdown.
//   OMP_NUM_THREADS=1 build/release/bench/orderings [--cells N...] [--factor-up-to N]
#include <cholmod.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "elliptic/cholmod/cholmod_blas.h"
#include "operators/sparse_operator.h"
#include "support/timing.h"
#include "test_problems.h"

namespace {

using namespace vesiflow::fluid;

double now() {
  return vesiflow::bench::seconds(CLOCK_MONOTONIC);
}

struct Ordering {
  const char* name;
  int methods;  // that CHOLMOD tries; 0 for its default: AMD, and METIS where that fills in much
  int method;   // the only one
};

constexpr std::array orderings{Ordering{"default", 0, 0}, Ordering{"AMD", 1, CHOLMOD_AMD},
                               Ordering{"METIS", 1, CHOLMOD_METIS}, Ordering{"NESDIS", 1, CHOLMOD_NESDIS},
                               Ordering{"best of nine", 9, 0}};

class Factor {
 public:
  Factor(SparseOperator& matrix, const Ordering& ordering) {
    cholmod_l_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.print = 0;
    common_.nmethods = ordering.methods;
    if (ordering.methods == 1) common_.method[0].ordering = ordering.method;
    view_.nrow = view_.ncol = static_cast<std::size_t>(matrix.size());
    view_.nzmax = matrix.entries();
    view_.p = matrix.column_starts().data();
    view_.i = matrix.rows().data();
    view_.x = matrix.values().data();
    view_.stype = -1;
    view_.itype = CHOLMOD_LONG;
    view_.xtype = CHOLMOD_REAL;
    view_.dtype = CHOLMOD_DOUBLE;
    view_.sorted = view_.packed = 1;
    const double start = now();
    factor_ = cholmod_l_analyze(&view_, &common_);
    analysis = now() - start;
    nonzeros = common_.lnz;
    flops = common_.fl;
    chosen = common_.method[common_.selected].ordering;
  }
  ~Factor() {
    cholmod_l_free_factor(&factor_, &common_);
    cholmod_l_finish(&common_);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  void measure() {
    const OneBlasThread one_thread;
    double start = now();
    cholmod_l_factorize(&view_, factor_, &common_);
    factorisation = std::min(factorisation, now() - start);
    cholmod_dense* rhs = cholmod_l_ones(view_.nrow, 1, CHOLMOD_REAL, &common_);
    start = now();
    cholmod_dense* x = cholmod_l_solve(CHOLMOD_A, factor_, rhs, &common_);
    solve = std::min(solve, now() - start);
    cholmod_l_free_dense(&x, &common_);
    cholmod_l_free_dense(&rhs, &common_);
  }

  double nonzeros = 0.0, flops = 0.0, analysis = 0.0, factorisation = 1e9, solve = 1e9;
  int chosen = 0;

 private:
  cholmod_common common_{};
  cholmod_sparse view_{};
  cholmod_factor* factor_ = nullptr;
};

void compare(const std::string& what, const EllipticProblem& problem, bool factorise) {
  SparseOperator matrix(problem);
  std::vector<std::unique_ptr<Factor>> factors;
  for (const Ordering& ordering : orderings) factors.push_back(std::make_unique<Factor>(matrix, ordering));
  for (int round = 0; factorise && round < 3; ++round)
    for (const auto& factor : factors) factor->measure();
  const Factor& first = *factors.front();
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const Factor& f = *factors[i];
    std::printf("| %s | %s%s | %.4g | %.3f | %.3f | %.2f |", what.c_str(), orderings[i].name,
                orderings[i].methods == 1     ? ""
                : f.chosen == CHOLMOD_AMD     ? " (AMD)"
                : f.chosen == CHOLMOD_METIS   ? " (METIS)"
                : f.chosen == CHOLMOD_NESDIS  ? " (NESDIS)"
                : f.chosen == CHOLMOD_NATURAL ? " (natural)"
                : f.chosen == CHOLMOD_COLAMD  ? " (COLAMD)"
                                              : "",
                f.nonzeros, f.nonzeros / first.nonzeros, f.flops / first.flops, f.analysis / first.analysis);
    if (factorise) {
      std::printf(" %.2f | %.2f |\n", f.factorisation / first.factorisation, f.solve / first.solve);
    } else {
      std::puts(" | |");
    }
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes{16, 24, 32};
  int largest = 32;
  CLI::App app{"Fill and times of the orderings of CHOLMOD for three problems."};
  app.add_option("--cells", sizes, "numbers of cells along each edge")->check(CLI::Range(4, 64))->capture_default_str();
  app.add_option("--factor-up-to", largest, "larger grids are analysed only")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::puts(
      "| problem | ordering | nonzeros | over default | operations | analysis | factorisation | solve "
      "|\n|---|---|---|---|---|---|---|---|");
  for (const int cells : sizes) {
    const Grid grid({-2, -2, -2}, {2, 2, 2}, {cells, cells, cells});
    const Viscosity ball = sample_viscosity(grid, [&](const Vector3& r) {
      return 1.0 + 9.5 * (1.0 - std::tanh((std::hypot(r[0], r[1], r[2]) - 1.0) / grid.spacing(0)));
    });
    const std::string size = " " + std::to_string(cells) + "^3";
    const bool factorise = cells <= largest;
    compare("pressure" + size, {grid, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0}, factorise);
    compare("velocity, laplacian" + size, EllipticProblem::velocity(grid, EllipticForm::laplacian, 1.0, 20.0),
            factorise);
    compare("velocity, stress" + size, EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, ball), factorise);
  }
}
