// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/membrane_response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "motion/constants.h"
#include "transfer/delta_functions.h"

namespace vesiflow::coupling {
namespace {

struct SheetAnswer {
  double along = 0.0, normal = 0.0;
};

/// Velocity at a distance from a sheet that a force of wavenumber k acts on, per force; m^2 = k^2 + a, viscosity 1.
SheetAnswer answer_at(double distance, double k, double m) {
  const double potential = k * std::exp(-k * distance), layer = m * std::exp(-m * distance), a = m * m - k * k;
  return {(layer - potential) / (2.0 * a), (potential - k * k / (m * m) * layer) / (2.0 * a)};
}

/// What SharpTransfer reads of it on a sheet along the grid, in the mean over where that is between points.
SheetAnswer answer_as_read(double k, double m, double spacing) {
  constexpr int positions = constants::positions_of_sheet;
  SheetAnswer mean;
  for (int p = 0; p < positions; ++p) {
    const double x = (p + 0.5) / positions;
    // Of Lagrange's polynomials for the points -1, 0, 1, 2.
    const std::array<double, 4> distances{1.0 + x, x, 1.0 - x, 2.0 - x},
        weights{-x * (x - 1.0) * (x - 2.0) / 6.0, (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0,
                -(x + 1.0) * x * (x - 2.0) / 2.0, (x + 1.0) * x * (x - 1.0) / 6.0};
    for (std::size_t j = 0; j < 4; ++j) {
      const double d = spacing * distances[j], third = k * k * d * d * d / 6.0;
      const SheetAnswer answer = answer_at(d, k, m);
      mean.along += weights[j] / positions * (answer.along + 0.5 * d + third);
      mean.normal += weights[j] / positions * (answer.normal - 0.5 * third);
    }
  }
  return mean;
}

}  // namespace

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
    if (is_sharp_ && a > 0.0) {
      const SheetAnswer read = answer_as_read(k, std::sqrt(k * k + a / mu), spacing_);
      mode.along.velocity = std::max(mode.along.velocity, read.along / mu);
      mode.normal.velocity = std::max(mode.normal.velocity, read.normal / mu);
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
