// What shape following keeps, volume and area, and how the mean strain and the area go together.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "shape_following.h"

namespace vesiflow::coupling {
namespace {

using vesicle::Surface;
using vesicle::VectorField;

// Mean strain that is held at the area A0, over the excess area (see the class). From 1, the elastic sphere, to 10 the choice is flat (docs/adr/0006):
// where it ends, the strain is the cube root of this times that of an elastic sphere.
constexpr double held_strain_per_excess = 4.0;
// Root mean square of the normal velocity of a sphere of equal viscosities in shear that no tension holds, over radius and rate of shear.
constexpr double normal_share = 0.28;
// The share of the curvature that varies is twice the excess area of a nearly spherical shape; below this it is round-off.
constexpr double smallest_independence = 1e-9;

// Of a field that has int exp(-s) dA = A exp(-mean).
double mean_strain(const vesicle::Membrane& membrane) {
  return std::log(membrane.surface().area() / membrane.target_areas().sum());
}

// What a mean strain is more than that of the area: `most` of it where it is larger than can be held, and never so that a strain is smaller than
// that of the area.
double held_strain(double mean, double of_area, double most) {
  if (std::abs(mean) > most) return std::copysign(most, std::abs(of_area) > 0.5 * most ? of_area : mean);
  return of_area > 0.0 ? std::clamp(mean - of_area, 0.0, most) : std::clamp(mean - of_area, -most, 0.0);
}

}  // namespace

double ShapeFollowing::largest_held_strain() const {
  return held_strain_per_excess * excess_area_;
}

// Nor is it where a step of the flow takes a sphere farther than the shape deviates from one: there is nothing to correct it by.
bool ShapeFollowing::can_keep_area(double dt, const vesicle::Membrane& membrane) const {
  if (!keeps_area_ || normal_share * strain_rate_ * dt > std::sqrt(0.5 * excess_area_)) return false;
  if (has_tension() && !(std::abs(mean_strain(membrane)) <= largest_held_strain())) return false;
  return vesicle::ConservationProjection::independence(membrane.surface()) > smallest_independence;
}

void ShapeFollowing::keep_rates(const Surface& surface, VectorField& velocity) {
  ++entries_.conservation;
  (keeps_area_now_ ? *volume_and_area_ : *volume_).remove_rates(surface, velocity);
}

void ShapeFollowing::keep_displacement(const Surface& surface, VectorField& displacement) {
  ++entries_.conservation;
  keeps_area_now_ = keeps_area_now_ && try_to_keep_area(surface, displacement);
  if (!keeps_area_now_) volume_->correct_displacement(surface, displacement);
}

// A displacement that is large beside the shape's deviation from a sphere has no correction that keeps the area, or only one that makes another
// shape of it: larger than the deviation f, of root mean square, which has the excess area 2 f^2.
bool ShapeFollowing::try_to_keep_area(const Surface& surface, VectorField& displacement) {
  uncorrected_ = displacement;
  try {
    volume_and_area_->correct_displacement(surface, displacement);
    const double correction = (displacement - uncorrected_).square().sum() / static_cast<double>(displacement.rows());
    if (correction <= 0.5 * excess_area_ * radius_ * radius_) return true;
  } catch (const std::domain_error&) {  // there is none
  }
  displacement = uncorrected_;
  return false;
}

// Replaces the increment of the positions by one that ends at the right volume and area.
void ShapeFollowing::conserve(const Surface& surface) {
  if (!keeps_something()) return;
  vectors_ = state_.leftCols<3>() + increment_.leftCols<3>() - surface.positions();
  keep_displacement(surface, vectors_);
  increment_.leftCols<3>() = vectors_ + surface.positions() - state_.leftCols<3>();
}

// Adds a constant to ds/dt, so that int exp(-s) dA does not change as the mesh moves: what `rates_` does to the volume and what of the
// fluid's flux does not move the membrane are not in div U.
void ShapeFollowing::tie_strain_rate(const Surface& surface) {
  vectors_ = rates_.leftCols<3>();
  surface.divergence(vectors_, divergence_);
  const auto unstrained = surface.area_weight() * (-strain_).exp();
  const double missing = ((divergence_ - rates_.col(3)) * unstrained).sum() / unstrained.sum();
  rates_.col(3) += missing;
}

// Adds a constant to s, so that the mean strain is ln(A/A0) and what is held beside it.
void ShapeFollowing::tie_strain(vesicle::Membrane& membrane) {
  const double of_area = std::log(membrane.surface().area() / membrane.initial_area());
  const double mean = mean_strain(membrane);
  const double missing = of_area + held_strain(mean, of_area, largest_held_strain()) - mean;
  increment_.col(3) += missing;
  state_.col(3) += missing;
  strain_ = state_.col(3);
  membrane.move_to(positions_, strain_);
}

}  // namespace vesiflow::coupling
