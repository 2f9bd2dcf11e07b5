// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/stiffness.h"

#include <algorithm>
#include <cmath>

#include "motion/constants.h"
#include "motion/flat_coefficients.h"

namespace vesiflow::coupling {

Stiffness::Stiffness(int degrees, const Material& material)
    : material_(material), modes_(static_cast<std::size_t>(degrees)) {}

// Per displacement.
double Stiffness::normal_force(double k, double tension) const {
  return k * k * (material_.bending * k * k + tension);
}

void Stiffness::find(double dt, const MembraneCondition& condition, const Overestimate& overestimate,
                     const MembraneResponse& response) {
  const double c = overestimate.factor;
  const auto force_of = [&](int n) { return normal_force(response.wavenumber(n), condition.largest_tension); };
  const auto fastest_rate = [&](int n) {
    double fastest = 0.0;
    for (int m = n; m < response.degrees() && m + 0.5 <= condition.compression * (n + 0.5); ++m)
      fastest = std::max(fastest, force_of(m) * response[m].normal.velocity);
    return fastest;
  };
  for (int n = 0; n < static_cast<int>(modes_.size()); ++n) {
    const double k = response.wavenumber(n);
    const MembraneResponse::Mode& mode = response[n];
    const double least = overestimate.covers_compression ? 0.0 : fastest_rate(n);
    const double force = std::max(c * force_of(n), least / mode.normal.velocity);
    Mode& z = modes_[static_cast<std::size_t>(n)];
    z.position = dt * force * mode.normal.velocity;
    z.position_force = -force;
    // A uniform tension is all pressure but for the variation of the curvature, which acts as a force of low degree.
    z.strain = dt * c * material_.sigma0 *
               (n == 0 ? condition.curvature_variance * response[2].normal.velocity : k * k * mode.along.velocity);
    z.strain_force = c * material_.sigma0;
  }
}

void Stiffness::find_forces(const vesicle::Coefficients& change, vesicle::Coefficients& forces) const {
  forces = change;
  for_each_coefficient(forces, [this](auto& value, int field, int n) {
    const Mode& z = (*this)[n];
    value *= field < 3 ? z.position_force : z.strain_force;
  });
}

Stiffness::Overestimate overestimate_of_single_correction(bool is_thin_membrane, double compression,
                                                          double inertia_share, double lagging_overestimate) {
  const double least =
      is_thin_membrane ? constants::overestimate * std::pow(compression, constants::compression_power_of_thin_membrane)
                       : constants::overestimate;
  return {least + std::max(0.0, constants::overestimate_with_inertia - least) * inertia_share + lagging_overestimate,
          is_thin_membrane};
}

}  // namespace vesiflow::coupling
