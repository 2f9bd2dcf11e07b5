// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include <Eigen/Core>

#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Spherical harmonics of degree n < degrees fitted to values at scattered points of the unit sphere, see fit_mesh.
struct SmoothingFit {
  Eigen::MatrixXd unknowns;  ///< shape (degrees^2, fields), see harmonics_at
  double smoothing = 0;      ///< lambda
};

/// Where lambda is looked for, decade by decade from the largest on.
struct SmoothingRange {
  double largest = 0.1;  ///< damps degree 2 by a factor of 3.4
  double smallest = 1e-10;
};

/// Minimises sum w_i |f(y_i) - f_i|^2 + lambda sum a_n |f_n^m|^2, a_n = mesh_energy_weight(n), by the normal equations.
/// lambda makes the mean square error of prediction least, at the points and between them: the sum of
///   [sum w_i |r_i|^2 / sum w_i] / (1 - tr A / points)^2,
/// A the matrix that takes the values to those of the fit, which generalised cross validation estimates from the residual r,
/// and of error_between. The first alone tells noise from shape and is blind for fits that swing where points are far
/// apart. tr A is estimated by one random vector of signs (M. F. Hutchinson, Commun. Stat. Simul. Comput. 19 (1990) 433).
/// directions: shape (points, 3), weights: (points), values: (points, fields); points > degrees^2. error_between: mean
/// square distance of the fit with these unknowns from what is known between the points.
/// @throws std::domain_error if the equations cannot be solved.
SmoothingFit fit_smoothly(const VectorField& directions, const Eigen::VectorXd& weights, const Eigen::MatrixXd& values,
                          int degrees, const SmoothingRange& range,
                          const std::function<double(const Eigen::MatrixXd&)>& error_between);

}  // namespace vesiflow::vesicle
