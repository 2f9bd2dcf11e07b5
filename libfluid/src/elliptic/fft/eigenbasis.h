// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The basis that diagonalises the difference operator along one axis, and its eigenvalues.
#pragma once

#include <vector>

#include "elliptic/fft/line_transform.h"
#include "fluid/elliptic_problem.h"

namespace vesiflow::fluid {

Basis eigenbasis(const EllipticProblem& problem, int axis);

// Of the one-dimensional -Laplacian, in the order of the transform: (2 sin(pi m / 2N) / h)^2 between walls, where m counts
// from 0 for cosines, from 1 for sines and from 1/2 for what is even at the lower end and odd at the upper;
// (2 sin(pi m / N) / h)^2 on a periodic axis, where m and N - m are the cosine and the sine of one wave.
std::vector<double> eigenvalues(const EllipticProblem& problem, int axis);

}  // namespace vesiflow::fluid
