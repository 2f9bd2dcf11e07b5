// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/wave_damping.h"

#include <cmath>

#include "motion/constants.h"

namespace vesiflow::coupling {

WaveDamping::WaveDamping(int degrees, double radius) : radius_(radius), rates_(static_cast<std::size_t>(degrees)) {}

void WaveDamping::update(double speed) {
  const double top = std::pow(static_cast<double>(rates_.size()) - 1.0, constants::damping_power);
  for (std::size_t n = 0; n < rates_.size(); ++n)
    rates_[n] = constants::damping_of_highest_degree * speed / radius_ *
                std::pow(static_cast<double>(n), constants::damping_power) / top;
}

void WaveDamping::subtract_from(vesicle::Coefficients& rates, const vesicle::Coefficients& y) const {
  for (int n = 0; n < rates.degrees(); ++n)
    for (int m = 0; m <= n; ++m)
      for (int f = 0; f < rates.fields(); ++f) rates(f, n, m) -= (*this)[n] * y(f, n, m);
}

}  // namespace vesiflow::coupling
