// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/membrane.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "check.h"

namespace vesiflow::vesicle {
namespace {

const MembraneParameters& checked(const MembraneParameters& p) {
  check_argument(p.capillary_number > 0, "capillary_number", p.capillary_number, "> 0 (infinity: no bending)");
  check_argument(std::isfinite(p.sigma0) && p.sigma0 >= 0, "sigma0", p.sigma0, "finite and >= 0");
  check_argument(std::isfinite(p.volume_stiffness) && p.volume_stiffness >= 0, "volume_stiffness", p.volume_stiffness,
                 "finite and >= 0");
  check_argument(std::isfinite(p.spontaneous_curvature), "spontaneous_curvature", p.spontaneous_curvature, "finite");
  check_argument(std::isfinite(p.area_stiffness) && p.area_stiffness >= 0, "area_stiffness", p.area_stiffness,
                 "finite and >= 0");
  check_argument(p.strain_relaxation > 0 && p.strain_relaxation <= 1, "strain_relaxation", p.strain_relaxation,
                 "in (0, 1]");
  check_argument(p.normal_degrees >= 0, "normal_degrees", p.normal_degrees, ">= 0 (0: the 2N/3 rule)");
  check_argument(p.tangential_degrees >= 1, "tangential_degrees", p.tangential_degrees, ">= 1");
  return p;
}

int normal_degrees(const MembraneParameters& p, int latitudes) {
  return p.normal_degrees == 0 ? two_thirds_degrees(latitudes) : p.normal_degrees;
}

}  // namespace

Membrane::Membrane(const VectorField& initial_positions, int latitudes, const MembraneParameters& parameters)
    : parameters_(checked(parameters)),
      surface_(latitudes),
      filter_(surface_.grid(), parameters.filter, normal_degrees(parameters, latitudes), parameters.tangential_degrees),
      target_area_update_(surface_.grid(), parameters.slip),
      positions_(initial_positions),
      force_(VectorField::Zero(surface_.grid().size(), 3)),
      tension_(ScalarField::Zero(surface_.grid().size())) {
  if (std::isfinite(parameters.capillary_number))
    bending_.emplace(surface_.grid(), BendingParameters{parameters.capillary_number, parameters.spontaneous_curvature,
                                                        parameters.laplacian});
  if (parameters.sigma0 > 0)
    tension_force_.emplace(TensionParameters{parameters.sigma0, parameters.tension_law, parameters.tension_form});
  if (tension_force_ && parameters.integral_tension.rate != 0) {
    integral_.emplace(surface_.grid(), parameters.integral_tension);
    integral_tension_ = ScalarField::Zero(surface_.grid().size());
  }
  if (relaxes_strain()) lagged_strain_ = ScalarField::Zero(surface_.grid().size());
  update_geometry();
  constexpr double rounding = 1e-12;  // a flat shape encloses that much
  if (!(surface_.volume() > rounding * std::pow(surface_.area(), 1.5))) {
    std::ostringstream message;
    message << "the volume enclosed by the initial positions is " << surface_.volume()
            << ": must be > 0 (is X_theta x X_phi outward?)";
    throw std::domain_error(message.str());
  }
  initial_areas_ = target_areas_ = surface_.area_weight();
  initial_area_ = surface_.area();
  initial_volume_ = surface_.volume();
  conserve();
}

GeometryDetail Membrane::detail() const {
  const bool curvature = bending_ || parameters_.area != AreaControl::none ||
                         (tension_force_ && parameters_.tension_form == TensionForm::non_divergence);
  return curvature ? GeometryDetail::curvature : GeometryDetail::first_form;
}

/// Takes the initial volume and area as those to be kept.
void Membrane::conserve() {
  Conserved conserved;
  if (parameters_.volume == VolumeControl::projection) conserved.volume = initial_volume_;
  if (parameters_.area == AreaControl::projection) conserved.area = initial_area_;
  if (conserved.volume || conserved.area) conservation_.emplace(surface_.grid(), conserved);
}

void Membrane::update_geometry() {
  surface_.update(positions_, detail());
}

const VectorField& Membrane::compute_force() {
  force_.setZero();
  if (bending_) bending_->add_to(surface_, force_);
  if (tension_force_) {
    ++entries_.tension;
    evaluate_tension();
    tension_force_->add_to(surface_, tension_, force_);
  }
  if (parameters_.volume == VolumeControl::penalty)
    add_volume_penalty(surface_, parameters_.volume_stiffness, initial_volume_, force_);
  if (parameters_.area == AreaControl::penalty)
    add_area_penalty(surface_, parameters_.area_stiffness, initial_area_, force_);
  return force_;
}

void Membrane::evaluate_tension() {
  if (relaxes_strain()) {
    // Not kept before the step ends: forces may be asked for twice.
    const double a = parameters_.strain_relaxation;
    strain_ = (1 - a) * lagged_strain_ + a * (surface_.area_weight() / target_areas_).log();
    tension_force_->evaluate(strain_, tension_);
  } else {
    tension_force_->evaluate(surface_, target_areas_, tension_);
  }
  if (integral_) tension_ += parameters_.sigma0 * integral_tension_;
}

void Membrane::filter_velocity(const VectorField& velocity, double dt, VectorField& filtered) {
  filter_.apply(surface_, velocity, filtered);
  if (!conservation_) return;
  ++entries_.conservation;
  conservation_->correct_velocity(surface_, dt, filtered);
}

void Membrane::correct_displacement(VectorField& displacement) {
  check_markers(displacement, "displacement", positions_.rows());
  if (!conservation_) return;
  ++entries_.conservation;
  conservation_->correct_displacement(surface_, displacement);
}

void Membrane::advance(const VectorField& new_positions, const VectorField& velocity, const VectorField& filtered,
                       double dt) {
  check_markers(new_positions, "new_positions", positions_.rows());
  check_markers(velocity, "velocity", positions_.rows());
  check_markers(filtered, "filtered", positions_.rows());
  check_finite(new_positions, "a new position");
  if (relaxes_strain() || integral_) strain_ = (surface_.area_weight() / target_areas_).log();
  if (tension_force_) {
    ++entries_.target_areas;
    target_area_update_.apply(surface_, velocity, filtered, dt, kept_target_area_.value_or(initial_area_),
                              target_areas_);
  }
  if (relaxes_strain()) lagged_strain_ += parameters_.strain_relaxation * (strain_ - lagged_strain_);
  if (integral_) integral_->advance(strain_, dt, integral_tension_);
  positions_ = new_positions;
}

void Membrane::move_to(const VectorField& positions, const ScalarField& strain) {
  check_markers(strain, "strain", positions_.rows());
  check_finite(strain, "a strain");
  surface_.update(positions, detail());
  positions_ = positions;
  target_areas_ = surface_.area_weight() * (-strain).exp();
  initial_areas_ = target_areas_ * (initial_area_ / target_areas_.sum());
  initial_area_ = initial_areas_.sum();  // to the last bit, as restore() takes it
}

RedistributionReport Membrane::redistribute(MeshRedistribution& redistribution) {
  update_geometry();
  const RedistributionReport report = redistribution.redistribute(surface_);
  if (!report.moved) return report;
  const double target_area = target_areas_.sum();  // that of a strain field may have a mean
  for (ScalarField* areas : {&target_areas_, &initial_areas_}) *areas = (surface_.area_weight() / *areas).log();
  redistribution.carry(target_areas_);
  redistribution.carry(initial_areas_);
  if (relaxes_strain()) redistribution.carry(lagged_strain_);
  if (integral_) redistribution.carry(integral_tension_);
  positions_ = redistribution.positions();
  update_geometry();
  for (ScalarField* areas : {&target_areas_, &initial_areas_}) *areas = surface_.area_weight() * (-*areas).exp();
  target_areas_ *= target_area / target_areas_.sum();
  initial_areas_ *= initial_area_ / initial_areas_.sum();
  initial_area_ = initial_areas_.sum();  // to the last bit, as restore() takes it
  conserve();
  return report;
}

void Membrane::keep_target_area() {
  kept_target_area_ = target_areas_.sum();
}

double Membrane::energy() const {
  return elastic_energy() + (bending_ ? bending_->energy(surface_) : 0);
}

double Membrane::elastic_energy() const {
  double sum = 0;
  if (tension_force_) sum += tension_force_->energy(surface_, target_areas_);
  if (integral_) sum += parameters_.sigma0 * IntegralTension::energy(surface_, target_areas_, integral_tension_);
  if (parameters_.volume == VolumeControl::penalty)
    sum += volume_penalty_energy(surface_, parameters_.volume_stiffness, initial_volume_);
  if (parameters_.area == AreaControl::penalty)
    sum += area_penalty_energy(surface_, parameters_.area_stiffness, initial_area_);
  return sum;
}

MembraneState Membrane::state() const {
  return {positions_, target_areas_, initial_areas_, initial_volume_, lagged_strain_, integral_tension_};
}

void Membrane::restore(const MembraneState& state) {
  const Eigen::Index markers = surface_.grid().size();
  check_markers(state.positions, "positions", markers);
  check_markers(state.target_areas, "target_areas", markers);
  check_markers(state.initial_areas, "initial_areas", markers);
  check_areas(state.target_areas, "a target area");
  check_areas(state.initial_areas, "an initial area");
  check_argument(std::isfinite(state.initial_volume) && state.initial_volume > 0, "initial_volume",
                 state.initial_volume, "finite and > 0");
  check_markers(state.lagged_strain, "lagged_strain", lagged_strain_.rows());
  check_markers(state.integral_tension, "integral_tension", integral_tension_.rows());
  check_argument(state.lagged_strain.isFinite().all(), "lagged_strain", "a value that is not finite", "finite");
  check_argument(state.integral_tension.isFinite().all(), "integral_tension", "a value that is not finite", "finite");
  surface_.update(state.positions, detail());
  positions_ = state.positions;
  target_areas_ = state.target_areas;
  initial_areas_ = state.initial_areas;
  initial_area_ = initial_areas_.sum();
  initial_volume_ = state.initial_volume;
  lagged_strain_ = state.lagged_strain;
  integral_tension_ = state.integral_tension;
  conserve();
}

}  // namespace vesiflow::vesicle
