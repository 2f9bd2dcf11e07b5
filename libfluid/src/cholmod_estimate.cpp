#include "cholmod_estimate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "message.h"

namespace vesiflow::fluid {
namespace {

// Of supernodal factorisations.
constexpr double flops_per_second = 1e10;

// Factors of nested dissection for a block of n1 <= n2 <= n3 unknowns: the largest separator is n1 n2 across, and
// entries grow as n1 n2 n3 sqrt(n1 n2) and operations as its square over the unknowns.
struct Growth {
  double entries, flops;
};

}  // namespace

double FactorEstimate::seconds() const {
  return flops / flops_per_second;
}

FactorEstimate rule_of_thumb(const EllipticProblem& problem) {
  std::array<double, 3> cells{};
  for (int axis = 0; axis < 3; ++axis) cells[axis] = problem.grid.cells[axis];
  std::sort(cells.begin(), cells.end());
  const double across = std::sqrt(cells[0] * cells[1]);
  const bool coupled = problem.form == EllipticForm::stress;
  const Growth growth = coupled ? Growth{10.0, 10.0} : Growth{10.0, 10.0};
  const auto n = static_cast<double>(problem.unknowns());
  return {8.0 * growth.entries * n * across, growth.flops * n * across * across * across};
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
                                        " s to factor ", problem.unknowns(), " unknowns (", estimate.flops,
                                        " operations at ", flops_per_second / 1e9, " Gflop/s), time_limit is ",
                                        options.time_limit, " s; raise it, ", alternatives));
  }
}

}  // namespace vesiflow::fluid
