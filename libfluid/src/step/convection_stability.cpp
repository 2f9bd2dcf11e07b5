// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/convection_stability.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace vesiflow::fluid {
namespace {

using Complex = std::complex<double>;

// The larger of the roots of a z^2 + b z + c.
double largest_root(double a, Complex b, Complex c) {
  const Complex root = std::sqrt(b * b - 4.0 * a * c);
  return std::max(std::abs(-b + root), std::abs(-b - root)) / (2.0 * a);
}

bool is_stable(double courant, double peclet, double largest_viscosity, ViscousTreatment treatment) {
  constexpr int phases = 200;
  constexpr double round_off = 1e-9;
  const double m = treatment == ViscousTreatment::implicit ? 1.0 : largest_viscosity;
  const bool extrapolates = treatment == ViscousTreatment::extrapolated;
  for (int i = 1; i <= phases; ++i) {
    const double theta = std::numbers::pi * i / phases;
    const double diffusion = 4.0 * courant / peclet * std::pow(std::sin(0.5 * theta), 2);
    const double convection = courant * std::sin(theta), rest = (m - 1.0) * diffusion;
    const Complex now(-2.0 - (extrapolates ? 2.0 : 1.0) * rest, 2.0 * convection);
    const Complex before(0.5 + (extrapolates ? rest : 0.0), -convection);
    if (largest_root(1.5 + m * diffusion, now, before) > 1.0 + round_off) return false;
  }
  return true;
}

}  // namespace

double stable_convection_step(double speed, double spacing, double reynolds_number, double largest_viscosity,
                              ViscousTreatment treatment) {
  const double peclet = reynolds_number * speed * spacing;
  double stable = 1e-3, unstable = 100.0;
  if (!(peclet > 0.0) || is_stable(unstable, peclet, largest_viscosity, treatment))
    return std::numeric_limits<double>::infinity();
  constexpr int halvings = 20;
  for (int i = 0; i < halvings; ++i) {
    const double middle = std::sqrt(stable * unstable);
    (is_stable(middle, peclet, largest_viscosity, treatment) ? stable : unstable) = middle;
  }
  return stable * spacing / speed;
}

}  // namespace vesiflow::fluid
