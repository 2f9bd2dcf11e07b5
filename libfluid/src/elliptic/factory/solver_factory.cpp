// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "elliptic/solver_factory.h"

#include <omp.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "elliptic/fft/fft_solver.h"
#include "elliptic/pcg/pcg_solver.h"
#ifdef VESIFLOW_WITH_CHOLMOD
#include "elliptic/cholmod/cholmod_estimate.h"
#include "elliptic/cholmod/cholmod_solver.h"
#endif

namespace vesiflow::fluid {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

// A factor that may be another problem's only preconditions.
bool may_lag(const CholmodOptions& options) {
  return options.refactor.every != 1 || options.refactor.change > 0.0;
}

PcgOptions conjugate_gradients(const CholmodOptions& preconditioner) {
  PcgOptions options;
  options.preconditioner = preconditioner;
  return options;
}

// Of "pcg" with "fft", to a tolerance of 1e-10.
struct IterationEstimate {
  double iterations, seconds;
};

// Measured for smooth spheres of ratio 5 to 1e4 whose surface is two cells thick, on one thread.
IterationEstimate estimate_iterations(const EllipticProblem& problem, double ratio) {
  constexpr double seconds_per_unknown = 3.5e-8;
  const double iterations = (problem.form == EllipticForm::stress ? 15.0 : 10.0) * std::pow(ratio, 0.3);
  return {iterations, seconds_per_unknown * iterations * static_cast<double>(problem.unknowns())};
}

#ifndef VESIFLOW_WITH_CHOLMOD
[[noreturn]] void refuse_cholmod() {
  throw std::invalid_argument(
      "elliptic solver: 'cholmod' is not in this build; configure with VESIFLOW_WITH_CHOLMOD=ON, or use "
      "'fft'");
}
#endif

}  // namespace

SolverOptions default_options(SolverKind kind) {
  switch (kind) {
    case SolverKind::fft:
      return FftOptions{};
    case SolverKind::cholmod:
      return CholmodOptions{};
    case SolverKind::pcg:
      return PcgOptions{};
    case SolverKind::automatic:
      break;
  }
  return AutoOptions{};
}

std::string name(const SolverOptions& options) {
  return std::visit(Overloaded{[](const FftOptions&) -> std::string { return name(SolverKind::fft); },
                               [](const CholmodOptions&) -> std::string { return name(SolverKind::cholmod); },
                               [](const PcgOptions& pcg) {
                                 const bool fft = std::holds_alternative<FftOptions>(pcg.preconditioner);
                                 return pcg_name(name(fft ? SolverKind::fft : SolverKind::cholmod));
                               },
                               [](const AutoOptions&) -> std::string { return name(SolverKind::automatic); }},
                    options);
}

ChosenSolver choose_solver(const EllipticProblem& problem, const AutoOptions& options) {
  if (problem.form == EllipticForm::laplacian && problem.mu.is_constant()) {
    return {FftOptions{}, "constant coefficients, components by themselves: fast transforms are exact and fastest"};
  }
  PcgOptions pcg;
  pcg.tolerance = options.tolerance;
  const auto [min, max] = problem.mu.checked_range();
  const IterationEstimate iterative = estimate_iterations(problem, max / min);
  std::ostringstream reason;
  reason.precision(2);
  reason << problem.unknowns() << " unknowns, ratio of viscosities " << max / min << ": conjugate gradients with fast "
         << "transforms take about " << std::lround(iterative.iterations) << " iterations or " << iterative.seconds
         << " s for a solve";
#ifdef VESIFLOW_WITH_CHOLMOD
  const FactorEstimate direct = rule_of_thumb(problem);
  reason << ", a sparse factorisation about " << direct.seconds() << " s and " << direct.bytes / 1e9 << " GB";
  if (direct.bytes <= options.memory_limit && direct.seconds() < iterative.seconds) {
    CholmodOptions cholmod;
    cholmod.memory_limit = 2.0 * options.memory_limit;  // of the exact count: the rule may be low
    return {cholmod, reason.str()};
  }
#endif
  return {pcg, reason.str()};
}

std::unique_ptr<EllipticSolver> make_preconditioner(const EllipticProblem& problem, const Preconditioner& options) {
  using Result = std::unique_ptr<EllipticSolver>;
  return std::visit(
      Overloaded{[&](const FftOptions& fft) -> Result { return std::make_unique<FftSolver>(problem, fft); },
                 [&]([[maybe_unused]] const CholmodOptions& cholmod) -> Result {
#ifdef VESIFLOW_WITH_CHOLMOD
                   return std::make_unique<CholmodSolver>(problem, cholmod);
#else
                   refuse_cholmod();
#endif
                 }},
      options);
}

std::size_t estimate_preconditioner_memory(const EllipticProblem& problem, const Preconditioner& options) {
  if (const auto* fft = std::get_if<FftOptions>(&options)) {
    return FftSolver::estimate_memory(problem, *fft, omp_get_max_threads());
  }
#ifdef VESIFLOW_WITH_CHOLMOD
  return static_cast<std::size_t>(rule_of_thumb(problem).bytes);
#else
  refuse_cholmod();
#endif
}

std::unique_ptr<EllipticSolver> make_elliptic_solver(const EllipticProblem& problem, const SolverOptions& options) {
  using Result = std::unique_ptr<EllipticSolver>;
  return std::visit(
      Overloaded{[&](const FftOptions& fft) -> Result { return make_preconditioner(problem, fft); },
                 [&](const CholmodOptions& cholmod) -> Result {
                   if (!may_lag(cholmod)) return make_preconditioner(problem, cholmod);
                   return make_elliptic_solver(problem, conjugate_gradients(cholmod));
                 },
                 [&](const PcgOptions& pcg) -> Result { return std::make_unique<PcgSolver>(problem, pcg); },
                 [&](const AutoOptions& automatic) -> Result {
                   return make_elliptic_solver(problem, choose_solver(problem, automatic).options);
                 }},
      options);
}

void check_solver_limits(const EllipticProblem& problem, const SolverOptions& options) {
  if ([[maybe_unused]] const auto* cholmod = std::get_if<CholmodOptions>(&options)) {
#ifdef VESIFLOW_WITH_CHOLMOD
    check_limits(problem, *cholmod);
#else
    refuse_cholmod();
#endif
  } else if (const auto* pcg = std::get_if<PcgOptions>(&options)) {
    std::visit([&](const auto& preconditioner) { check_solver_limits(problem, preconditioner); }, pcg->preconditioner);
  }
}

std::size_t estimate_solver_memory(const EllipticProblem& problem, const SolverOptions& options) {
  return std::visit(Overloaded{[&](const FftOptions& fft) { return estimate_preconditioner_memory(problem, fft); },
                               [&](const CholmodOptions& cholmod) {
                                 if (!may_lag(cholmod)) return estimate_preconditioner_memory(problem, cholmod);
                                 return estimate_solver_memory(problem, conjugate_gradients(cholmod));
                               },
                               [&](const PcgOptions& pcg) { return PcgSolver::estimate_memory(problem, pcg); },
                               [&](const AutoOptions& automatic) {
                                 return estimate_solver_memory(problem, choose_solver(problem, automatic).options);
                               }},
                    options);
}

}  // namespace vesiflow::fluid
