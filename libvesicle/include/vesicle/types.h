// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace vesiflow::vesicle {

/// A point or vector of space. All quantities of the library are dimensionless: lengths by the effective radius, times
/// by 1/(shear rate), stresses by mu_o/t_c (Section 3.1 of the paper).
using Vector3 = Eigen::Vector3d;

/// One value per marker, shape (markers). Markers are numbered j * longitudes + i, with longitude i fastest and
/// colatitude j from the north pole.
using ScalarField = Eigen::ArrayXd;

/// One vector per marker, shape (markers, 3), column-major: each component is contiguous.
using VectorField = Eigen::Array<double, Eigen::Dynamic, 3>;

}  // namespace vesiflow::vesicle
