// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vesicle/coefficients.h"

namespace vesiflow::run {

/// Coefficients of real fields in the real orthonormal harmonics
///
///     P_n^0,  sqrt(2) P_n^m cos(m phi),  sqrt(2) P_n^m sin(m phi),  1 <= m <= n,
///
/// with the P_n^m of vesicle::SphericalHarmonics: a column for each field, rows n^2, n^2 + 2m - 1 and n^2 + 2m. The sum of their squares is
/// the integral of the field's square over the unit sphere, so that an error of the coefficients is one of the field.
using RealCoefficients = Eigen::ArrayXXf;

/// The degrees n < degrees of these.
RealCoefficients real_coefficients(const vesicle::Coefficients& coefficients, int degrees);

/// The other way.
vesicle::Coefficients complex_coefficients(const RealCoefficients& real);

}  // namespace vesiflow::run
