// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/mean_strain.h"

#include <algorithm>
#include <cmath>

#include "motion/constants.h"

namespace vesiflow::coupling {

MeanStrain::MeanStrain(double excess_area) : largest_held_(constants::held_strain_per_excess * excess_area) {}

double MeanStrain::of(const vesicle::Membrane& membrane) {
  return std::log(membrane.surface().area() / membrane.target_areas().sum());
}

bool MeanStrain::is_held(const vesicle::Membrane& membrane) const {
  return std::abs(of(membrane)) <= largest_held_;
}

double MeanStrain::missing(const vesicle::Membrane& membrane) const {
  const double of_area = std::log(membrane.surface().area() / membrane.initial_area());
  const double mean = of(membrane);
  return of_area + held(mean, of_area, largest_held_) - mean;
}

double MeanStrain::held(double mean, double of_area, double largest_held) {
  if (std::abs(mean) > largest_held)
    return std::copysign(largest_held, std::abs(of_area) > 0.5 * largest_held ? of_area : mean);
  return of_area > 0.0 ? std::clamp(mean - of_area, 0.0, largest_held) : std::clamp(mean - of_area, -largest_held, 0.0);
}

}  // namespace vesiflow::coupling
