// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/shape_conservation.h"

#include <cmath>
#include <stdexcept>

#include "motion/constants.h"

namespace vesiflow::coupling {
namespace {

vesicle::Conserved conserved(const ShapeConservation::Parameters& parameters, const vesicle::Membrane& membrane,
                             bool with_area) {
  vesicle::Conserved result;
  if (parameters.keeps_volume) result.volume = membrane.initial_volume();
  if (parameters.keeps_area && with_area) result.area = membrane.initial_area();
  return result;
}

}  // namespace

ShapeConservation::ShapeConservation(const Parameters& parameters, const vesicle::Membrane& membrane)
    : parameters_(parameters),
      mean_strain_(parameters.excess_area),
      volume_(membrane.surface().grid(), conserved(parameters, membrane, false), constants::degrees_of_corrections),
      volume_and_area_(membrane.surface().grid(), conserved(parameters, membrane, true),
                       constants::degrees_of_corrections),
      uncorrected_(vesicle::VectorField::Zero(membrane.positions().rows(), 3)) {}

void ShapeConservation::begin_step(double dt, const vesicle::Membrane& membrane) {
  const double deviation = std::sqrt(0.5 * parameters_.excess_area);
  const double moved_by_flow = constants::normal_share_of_shear * parameters_.strain_rate * dt;
  keeps_area_now_ =
      parameters_.keeps_area && !(moved_by_flow > deviation) &&
      !(parameters_.has_tension && !mean_strain_.is_held(membrane)) &&
      vesicle::ConservationProjection::independence(membrane.surface()) > constants::smallest_independence;
}

void ShapeConservation::remove_rates(const vesicle::Surface& surface, vesicle::VectorField& velocity) {
  if (!keeps_something()) return;
  ++entries_;
  (keeps_area_now_ ? volume_and_area_ : volume_).remove_rates(surface, velocity);
}

void ShapeConservation::correct(const vesicle::Surface& surface, vesicle::VectorField& displacement) {
  if (!keeps_something()) return;
  ++entries_;
  keeps_area_now_ = keeps_area_now_ && try_to_keep_area(surface, displacement);
  if (!keeps_area_now_) volume_.correct_displacement(surface, displacement);
}

// A displacement that is large beside the shape's deviation from a sphere has no correction that keeps the area, or
// only one that makes another shape of it: larger than the deviation f, of root mean square, which has the excess
// area 2 f^2.
bool ShapeConservation::try_to_keep_area(const vesicle::Surface& surface, vesicle::VectorField& displacement) {
  uncorrected_ = displacement;
  try {
    volume_and_area_.correct_displacement(surface, displacement);
    const double correction = (displacement - uncorrected_).square().sum() / static_cast<double>(displacement.rows());
    if (correction <= 0.5 * parameters_.excess_area * parameters_.radius * parameters_.radius) return true;
  } catch (const std::domain_error&) {  // there is none
  }
  displacement = uncorrected_;
  return false;
}

}  // namespace vesiflow::coupling
