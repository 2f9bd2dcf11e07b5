// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/membrane_response.h"

#include <cmath>
#include <numbers>

#include "motion/constants.h"
#include "transfer/delta_functions.h"

namespace vesiflow::coupling {

MembraneResponse::SecondMoments MembraneResponse::second_moments(DeltaKernel kernel) {
  return with_functions_of(kernel, [](auto functions) -> SecondMoments {
    using Functions = decltype(functions);
    const double across = Functions::Tangential::second_moment, excess = Functions::Normal::second_moment - across;
    return {.along = across + constants::normal_share_of_force_along * excess,
            .normal = across + constants::normal_share_of_normal_force * excess};
  });
}

MembraneResponse::MembraneResponse(int degrees, double radius, double spacing, const SecondMoments& moments,
                                   bool is_sharp)
    : radius_(radius),
      spacing_(spacing),
      moments_(moments),
      is_sharp_(is_sharp),
      modes_(static_cast<std::size_t>(degrees)) {}

void MembraneResponse::update(double a, double mu) {
  constexpr int points = constants::response_quadrature_points;
  const double in_plane_decay = is_sharp_ ? 0.0 : constants::in_plane_decay,
               owed_decay = is_sharp_ ? 0.0 : constants::in_plane_decay_of_owed;
  if (a == a_ && mu == mu_) return;
  a_ = a;
  mu_ = mu;
  for (std::size_t n = 0; n < modes_.size(); ++n) {
    const double k = wavenumber(static_cast<int>(n)), in_plane = k * spacing_;
    Mode mode;
    const auto add = [](Mode::Answer& answer, double force, double qq, double inverse) {
      answer.velocity += force * inverse;
      answer.inertia += force * inverse * inverse;
      answer.viscosity += force * qq * inverse * inverse;
    };
    for (int i = 0; i < points; ++i) {
      // k_z = k tan(angle), so that dk_z / q^2 = d(angle) / k.
      const double angle = (i + 0.5) * std::numbers::pi / (2 * points);
      const double kz = k * std::tan(angle), qq = k * k + kz * kz;
      const double across = kz * spacing_;
      const auto weight = [&](double moment) {
        return std::exp(-moment * across * across - in_plane_decay * in_plane * in_plane) / (2.0 * points * k);
      };
      const double inverse = 1.0 / (a + mu * qq);
      add(mode.along, weight(moments_.along) * kz * kz, qq, inverse);
      add(mode.normal, weight(moments_.normal) * k * k, qq, inverse);
    }
    const double owed = std::exp((owed_decay - in_plane_decay) * in_plane * in_plane);
    for (Mode::Answer* answer : {&mode.along, &mode.normal}) {
      answer->inertia *= owed / answer->velocity;
      answer->viscosity *= owed / answer->velocity;
    }
    modes_[n] = mode;
  }
}

}  // namespace vesiflow::coupling
