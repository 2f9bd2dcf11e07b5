#include "thickness_correction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vesiflow::coupling {
namespace {

// Degrees with k h below this; at 2, the fading leaves 1e-7.
constexpr double largest_kh = 2.0;

int corrected_degrees(const vesicle::Membrane& membrane, double radius, double spacing) {
  const int by_grid = static_cast<int>(largest_kh * radius / spacing);
  return std::clamp(by_grid, 3, membrane.surface().grid().latitudes());
}

double radius_of(const vesicle::Membrane& membrane) {
  return std::sqrt(membrane.initial_area() / (4.0 * std::numbers::pi));
}

}  // namespace

ThicknessCorrection::ThicknessCorrection(const vesicle::Membrane& membrane, DeltaKernel kernel, double spacing,
                                         double viscosity)
    : harmonics_(corrected_degrees(membrane, radius_of(membrane), spacing), membrane.surface().grid(), 1),
      coefficients_(harmonics_.degrees(), 1),
      values_(membrane.positions().rows()),
      gradient_(membrane.positions().rows(), 3) {
  const double root = std::sqrt(std::numbers::pi), width = root * thickening(kernel) * spacing;  // h sqrt(m)
  for (int n = 0; n < harmonics_.degrees(); ++n) {
    const double k = (n + 0.5) / radius_of(membrane), x = k * width, e = std::exp(x * x) * std::erfc(x);
    const double sharp = std::exp(-std::pow(k * spacing, 4)) / (4.0 * viscosity * k);
    along_.push_back(sharp * (1.0 - (1.0 + 2.0 * x * x) * e + 2.0 * x / root));
    normal_.push_back(sharp * (1.0 - (1.0 - 2.0 * x * x) * e - 2.0 * x / root));
  }
  normal_[0] = 0.0;  // a pressure, which moves nothing
}

void ThicknessCorrection::scale_degrees(const std::vector<double>& factors) {
  for (int n = 0; n < harmonics_.degrees(); ++n)
    for (int m = 0; m <= n; ++m) coefficients_(0, n, m) *= factors[static_cast<std::size_t>(n)];
}

void ThicknessCorrection::add_to(const vesicle::Membrane& membrane, vesicle::VectorField& velocity) {
  const vesicle::Surface& surface = membrane.surface();
  harmonics_.analysis(membrane.tension(), coefficients_);
  scale_degrees(along_);
  harmonics_.synthesis(coefficients_, values_);
  surface.gradient(values_, gradient_);
  velocity += gradient_;
  values_ = (membrane.force() * surface.normal()).rowwise().sum();
  harmonics_.analysis(values_, coefficients_);
  scale_degrees(normal_);
  harmonics_.synthesis(coefficients_, values_);
  for (int axis = 0; axis < 3; ++axis) velocity.col(axis) += values_ * surface.normal().col(axis);
}

}  // namespace vesiflow::coupling
