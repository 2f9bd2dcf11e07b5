// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The full-grid passes of one time step of NavierStokes. They are bound by memory traffic, so each does as
// much as it can per number read. Parallel over z planes; the same bits for every number of threads.
#pragma once

#include <optional>

#include "fluid/field.h"
#include "fluid/view.h"

namespace vesiflow::fluid {

// Coefficients of Re [(a0 u* - a1 u^k + a2 u^{k-1}) / dt + b1 N(u^k) - b2 N(u^{k-1})].
struct StepCoefficients {
  double a0, a1, a2;
  double b1, b2;
};

// Backward Euler for the first step (previous_dt = 0), else BDF2 with the extrapolation of the same order.
StepCoefficients step_coefficients(double dt, double previous_dt);

// alpha u - mu Lap u, the 7-point Laplacian of a component from its points inside, on walls and in ghosts.
struct MomentumOperator {
  double alpha, mu;
};

// The explicit terms on the inner faces, without walls:
//   Re [(a1 u - a2 previous) / dt - b1 N(u) + b2 N(previous)] - grad p + force + uniform_force.
// previous is overwritten by them. convection holds N(previous) and is overwritten by N(u); null leaves
// convection out. The force is copied to `kept`, unless that is null. With an `implicit` operator its product with u is subtracted: what remains is the right-hand side for
// the change of u.
void explicit_terms(const StepCoefficients& coefficients, double reynolds_number, double dt, const FaceVector& u,
                    const Field<Cell>& pressure, const FaceVector& force, const Vector3& uniform_force,
                    FaceVector* convection, FaceVector& previous, FaceVector* kept = nullptr,
                    const std::optional<MomentumOperator>& implicit = std::nullopt);

// chi = div u - given, where given becomes source - mean.
void divergence_beyond(const FaceVector& u, const Field<Cell>& source, double mean, Field<Cell>& given,
                       Field<Cell>& chi);
// The same for a change of u: chi = div u - (source - mean - given), and given becomes source - mean.
void change_of_divergence_beyond(const FaceVector& u, const Field<Cell>& source, double mean, Field<Cell>& given,
                                 Field<Cell>& chi);

// Given -Lap chi = div u: u += grad chi on the inner faces. Sets chi's ghosts.
void remove_divergence(Field<Cell>& chi, FaceVector& u);

// The same, and the pressure update p += phi - factor mu div u with phi = -a chi, where div u = -Lap chi.
void correct_velocity_and_pressure(Field<Cell>& chi, double a, ConstView mu, double factor, FaceVector& u,
                                   Field<Cell>& pressure);

// The same with the increment of u that has this divergence: u += increment + grad chi on the inner faces. The increment is
// overwritten by the force there.
void add_corrected_increment(Field<Cell>& chi, double a, ConstView mu, double factor, const FaceVector& force,
                             FaceVector& increment, FaceVector& u, Field<Cell>& pressure);

// e = (1 + r) u - r previous, ghosts and walls included: the velocity extrapolated by r times the last step.
void extrapolate(const FaceVector& u, const FaceVector& previous, double r, FaceVector& e);

}  // namespace vesiflow::fluid
