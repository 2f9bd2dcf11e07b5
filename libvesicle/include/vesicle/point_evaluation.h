// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vesicle/coefficients.h"
#include "vesicle/export.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Values of spherical-harmonic expansions at arbitrary points of the unit sphere, poles included, in the convention of
/// SphericalHarmonics. With d = (x, y, z) a unit vector,
///
///     Y_n^m(d) = q_n^m(z) (x + i y)^m,
///
/// q a polynomial from the three-term recurrence in n, which is stable on [-1, 1]: no angles, no division by
/// sin(theta). O(points degrees^2): 3 fields of 64 degrees at 8192 points take 11 ms (AVX2, one thread).
class VESIFLOW_VESICLE_EXPORT PointEvaluation {
 public:
  /// For expansions of up to `degrees` degrees.
  /// \throws std::invalid_argument unless 1 <= degrees <= 512 (q overflows near 800).
  explicit PointEvaluation(int degrees);

  int degrees() const { return degrees_; }  ///< largest number of degrees

  /// Evaluates expansions at points of the sphere.
  /// \param directions unit vectors, shape (points, 3).
  /// \param values shape (points, coefficients.fields()).
  /// \throws std::invalid_argument if the coefficients have more degrees than this, values has the wrong shape or a
  /// direction is not of length 1 to 1e-8.
  void values_at(const Coefficients& coefficients, const VectorField& directions,
                 Eigen::Ref<Eigen::ArrayXXd> values) const;

 private:
  // q_n = a (z q_{n-1} - b q_{n-2})
  struct Step {
    double a, b;
  };

  template <int fields>
  void evaluate(const Coefficients& coefficients, int first_field, const VectorField& directions,
                Eigen::Ref<Eigen::ArrayXXd> values) const;

  int degrees_;
  std::vector<double> diagonal_;  // q_m^m
  std::vector<Step> steps_;       // for each m, of n = m + 1, m + 2, ...
};

}  // namespace vesiflow::vesicle
