// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "constrained_energy.h"
#include "method.h"

namespace equilibrium {

/// Which of the shapes that are stationary at a reduced volume: the one that goes over into long or into flat ellipsoids near
/// the sphere. Both keep an axis and a mirror plane, and so stay on their branch where others have less energy.
enum class Branch { prolate, oblate };
std::string name_of(Branch branch);

/// An equilibrium shape with V = 4 pi / 3 and what proves it. Lengths in effective radii r, energy (1/2) int H^2 dA in c_b,
/// tension in c_b / r^2, pressure (inside minus outside) in c_b / r^3.
struct Equilibrium {
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

  Branch branch = Branch::prolate;
  double reduced_volume = 1;
  int latitudes = 0;
  Method method = Method::newton;

  double energy = 0;
  double tension = undefined, pressure = undefined;  ///< not determined for the sphere
  double polar_semi_axis = 0, equatorial_radius = 0, half_arclength = 0;
  double polar_mean_curvature = 0, equatorial_mean_curvature = 0;

  double area_error = 0, volume_error = 0;  ///< relative
  double residual = 0;                      ///< of the method, see Stationarity; energy error about its square
  /// max |f_b + pressure - 2 H tension| over the markers, beside the largest |f_b|: error of the mesh. The energy's error is about
  /// the square of the relative one.
  double euler_lagrange_residual = 0, largest_force = 0;
  /// 2 tension A / (3 pressure V) - 1: zero by the scaling of lengths, since the energy does not change with size.
  double scaling_error = 0;
  double last_coefficient = 0;  ///< see Meridian::last_coefficient

  int iterations = 0;
  int gradient_evaluations = 0;
  double seconds = 0;

  /// To about 1e-6 in the energy.
  bool resolved() const { return euler_lagrange_residual <= 1e-3 * largest_force; }
};

/// Of a shape that was not found: what happened, and what to do about it.
class NotConverged : public std::runtime_error {
 public:
  NotConverged(const std::string& what, std::string advice_text)
      : std::runtime_error(what), advice_(std::move(advice_text)) {}
  const std::string& advice() const { return advice_; }

 private:
  std::string advice_;
};

/// Finds the shape from the one-parameter family phi = theta + b sin 2 theta with that reduced volume; below 0.65, from there
/// in steps of the reduced volume. Nothing depends on shapes found before. Leaves `energy` at the shape, for output.
/// @throws NotConverged; std::invalid_argument unless 0 < reduced_volume <= 1; MethodMissing.
Equilibrium find_equilibrium(ConstrainedEnergy& energy, Branch branch, double reduced_volume, Method method,
                             const SolverOptions& options);

}  // namespace equilibrium
