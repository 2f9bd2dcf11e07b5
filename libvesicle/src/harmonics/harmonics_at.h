// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vesicle/coefficients.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Real basis of the expansion of SphericalHarmonics at one unit vector, poles included: the real field with
/// coefficients f_n^m is the sum of unknown times basis value, where the unknowns of degree n are, from number n^2 on,
///   f_n^0, then Re f_n^m, Im f_n^m for m = 1 .. n,  with basis values Y_n^0, 2 Re Y_n^m, -2 Im Y_n^m.
/// values: shape (degrees^2).
void harmonics_at(const Vector3& direction, int degrees, Eigen::Ref<Eigen::VectorXd> values);

/// One field with these unknowns.
Coefficients coefficients_of(const Eigen::VectorXd& unknowns, int degrees);

}  // namespace vesiflow::vesicle
