// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/owed_force.h"

#include <algorithm>
#include <utility>

#include "motion/constants.h"
#include "motion/flat_coefficients.h"

namespace vesiflow::coupling {

OwedForce::OwedForce(const vesicle::SphericalHarmonics& harmonics, int fields, const SurroundingFluid& fluid)
    : harmonics_(harmonics),
      fluid_(fluid),
      last_(harmonics.degrees(), fields),
      older_(harmonics.degrees(), fields),
      owed_(harmonics.degrees(), fields),
      values_(harmonics.grid().size(), fields),
      tension_(harmonics.grid().size()),
      force_(harmonics.grid().size(), 3),
      of_tension_(harmonics.grid().size(), 3) {
  restart();
}

void OwedForce::add(const vesicle::Coefficients& forces) {
  std::swap(last_, older_);
  last_ = forces;
  steps_ = std::min(2, steps_ + 1);
}

OwedForce::Weights OwedForce::of_time_derivative(double dt, const Bdf2& scheme, const vesicle::Surface& surface) const {
  const double r = scheme.ratio;
  const double curved = constants::layers_of_curvature * surface.mean_curvature().abs().maxCoeff();
  const double rate =
      fluid_.reynolds_number / dt / (1.0 + curved * curved * fluid_.solved_viscosity / fluid_.acceleration(dt, scheme));
  return {rate * (1.0 + r), rate * r * r / (1.0 + r)};
}

OwedForce::Weights OwedForce::of_viscosity(const Bdf2& scheme) const {
  const double mu = fluid_.remembered_viscosity();
  if (!fluid_.extrapolates_viscosity) return {mu, 0.0};
  return {mu * (1.0 + scheme.ratio), mu * scheme.ratio};
}

void OwedForce::find(double dt, const Bdf2& scheme, const MembraneResponse& response, const vesicle::Surface& surface) {
  owes_ = fluid_.has_inertia && steps_ > 0;
  if (!owes_) return;
  const Weights inertia = of_time_derivative(dt, scheme, surface), viscosity = of_viscosity(scheme);
  for (int n = 0; n < harmonics_.degrees(); ++n)
    for (int f = 0; f < owed_.fields(); ++f) {
      // A uniform tension acts as a force of low degree.
      const auto& answer = f < 3 ? response[n].normal : n == 0 ? response[2].normal : response[n].along;
      const double now = inertia.last * answer.inertia + viscosity.last * answer.viscosity;
      const double before = inertia.older * answer.inertia + viscosity.older * answer.viscosity;
      for (int m = 0; m <= n; ++m) owed_(f, n, m) = now * last_(f, n, m) - before * older_(f, n, m);
    }
  harmonics_.synthesis(owed_, values_);
  force_ = values_.leftCols<3>();
  if (values_.cols() == 3) return;
  tension_ = values_.col(3);
  surface.projector_divergence(tension_, of_tension_);
  force_ += of_tension_;
}

std::span<const double> OwedForce::last() const {
  return {as_vector(last_).data(), static_cast<std::size_t>(as_vector(last_).size())};
}

std::span<const double> OwedForce::older() const {
  return {as_vector(older_).data(), static_cast<std::size_t>(as_vector(older_).size())};
}

void OwedForce::restore(int steps, std::span<const double> last, std::span<const double> older) {
  steps_ = steps;
  std::ranges::copy(last, as_vector(last_).data());
  std::ranges::copy(older, as_vector(older_).data());
  owes_ = false;
}

void OwedForce::restart() {
  steps_ = 0;
  last_.set_zero();
  older_.set_zero();
  owes_ = false;
}

}  // namespace vesiflow::coupling
