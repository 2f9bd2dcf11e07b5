// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "elliptic/fft/eigenbasis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vesiflow::fluid {

Basis eigenbasis(const EllipticProblem& problem, int axis) {
  if (problem.grid.periodic[axis]) return Basis::fourier;
  if (is_face_normal(problem.centring(), axis)) return Basis::sine_points;
  if (problem.condition(0, axis, 1) == BoundaryCondition::neumann) return Basis::cosine_cells;
  return problem.condition(0, axis, 0) == BoundaryCondition::neumann ? Basis::mixed_cells : Basis::sine_cells;
}

std::vector<double> eigenvalues(const EllipticProblem& problem, int axis) {
  const Basis basis = eigenbasis(problem, axis);
  const double first_mode = basis == Basis::mixed_cells                               ? 0.5
                            : basis == Basis::cosine_cells || basis == Basis::fourier ? 0.0
                                                                                      : 1.0;
  const double step = std::numbers::pi / problem.grid.cells[axis] * (basis == Basis::fourier ? 1.0 : 0.5);
  const int size = problem.extent()[axis];
  std::vector<double> values(size);
  for (int i = 0; i < size; ++i) {
    const double mode = basis == Basis::fourier ? std::min(i, size - i) : i + first_mode;
    const double root = 2.0 * std::sin(step * mode) / problem.grid.spacing(axis);
    values[i] = root * root;
  }
  return values;
}

}  // namespace vesiflow::fluid
