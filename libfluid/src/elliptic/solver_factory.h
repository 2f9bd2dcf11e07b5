// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What make_elliptic_solver() and the iterative solvers share.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <variant>

#include "fluid/elliptic_solver.h"

namespace vesiflow::fluid {

// "pcg" with the name of its preconditioner.
inline std::string pcg_name(const std::string& preconditioner) {
  return std::string(name(SolverKind::pcg)) + "+" + preconditioner;
}

using Preconditioner = decltype(PcgOptions::preconditioner);

// The backend itself, updated to the problem. Unlike the one that make_elliptic_solver() makes of the same options, a
// "cholmod" whose factor may lag then solves another problem. Throws likewise.
std::unique_ptr<EllipticSolver> make_preconditioner(const EllipticProblem& problem, const Preconditioner& options);

std::size_t estimate_preconditioner_memory(const EllipticProblem& problem, const Preconditioner& options);

}  // namespace vesiflow::fluid
