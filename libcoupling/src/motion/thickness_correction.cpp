// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/thickness_correction.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "motion/sphere_response.h"
#include "vesicle/scale_degrees.h"

namespace vesiflow::coupling {

ThicknessCorrection::ThicknessCorrection(const vesicle::Membrane& membrane, DeltaKernel kernel, double spacing,
                                         double viscosity)
    : ThicknessCorrection(membrane, factors(membrane, kernel, spacing, viscosity)) {}

ThicknessCorrection::ThicknessCorrection(const vesicle::Membrane& membrane, Factors factors)
    : smoothing_(std::move(factors.smoothing)),
      along_(std::move(factors.along)),
      harmonics_(degrees(), membrane.surface().grid(), 4),
      coefficients_(degrees(), 4),
      values_(membrane.positions().rows(), 4),
      normal_force_(membrane.positions().rows()),
      potential_(membrane.positions().rows()),
      gradient_(membrane.positions().rows(), 3) {}

ThicknessCorrection::Factors ThicknessCorrection::factors(const vesicle::Membrane& membrane, DeltaKernel kernel,
                                                          double spacing, double viscosity) {
  constexpr double negligible = 1e-6;
  const int latitudes = membrane.surface().grid().latitudes();
  const SphereResponse response(kernel, std::sqrt(membrane.initial_area() / (4.0 * std::numbers::pi)), spacing);
  Factors result;
  std::vector<double> plus, minus, fades{1.0};  // per degree n; of degree 0 there is a pressure only
  plus.push_back(0.0);
  minus.push_back(0.0);
  result.along.push_back(0.0);
  for (int n = 1; n <= latitudes; ++n) {
    const auto exact = response.exact(n), immersed = response.immersed(n);
    const double lost = std::log2(SphereResponse::normal(n, exact) / SphereResponse::normal(n, immersed));
    const double t = n / (2.0 * n + 1.0), g = -immersed.mixed / std::sqrt(t * (1.0 - t));
    plus.push_back(exact.plus - immersed.plus - g * t);
    minus.push_back(exact.minus - immersed.minus - g * (1.0 - t));
    fades.push_back(std::exp(-std::pow(lost, 4)));
    if (n == latitudes || (fades.back() < negligible && n > 1)) break;
    result.along.push_back(fades.back() * g / viscosity);
  }
  for (std::size_t l = 0; l < result.along.size(); ++l) {
    const double above = 2.0 * static_cast<double>(l) + 3.0, below = l < 2 ? 0.0 : 2.0 * static_cast<double>(l) - 1.0;
    const double sum = above * minus[l + 1] + (l < 2 ? 0.0 : below * plus[l - 1]);
    result.smoothing.push_back(fades[l] * sum / ((above + below) * viscosity));
  }
  return result;
}

void ThicknessCorrection::add_to(const vesicle::Membrane& membrane, const vesicle::VectorField& force,
                                 vesicle::VectorField& velocity) {
  const vesicle::Surface& surface = membrane.surface();
  normal_force_ = (force * surface.normal()).rowwise().sum();
  const double pressure = (normal_force_ * surface.area_weight()).sum() / surface.area();
  values_.leftCols<3>() = force - pressure * surface.normal();
  values_.col(3) = membrane.tension();
  harmonics_.analysis(values_, coefficients_);
  vesicle::scale_degrees(coefficients_, [this](int field, int n) { return field < 3 ? smoothing(n) : along(n); });
  harmonics_.synthesis(coefficients_, values_);
  potential_ = values_.col(3);
  surface.gradient(potential_, gradient_);
  velocity += values_.leftCols<3>() + gradient_;
}

}  // namespace vesiflow::coupling
