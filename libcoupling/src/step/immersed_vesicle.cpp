// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "step/immersed_vesicle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "coupling/initial_shape.h"
#include "motion/following_parameters.h"
#include "motion/motion_factory.h"
#include "phase_timer.h"
#include "viscosity/phase_inertia.h"

namespace vesiflow::coupling {
namespace {

vesicle::MembraneParameters membrane_parameters(const SimulationParameters& all, std::size_t i) {
  vesicle::MembraneParameters membrane;
  membrane.capillary_number = all.capillary_number(i);
  membrane.sigma0 = all.sigma0(i);
  membrane.spontaneous_curvature = all.spontaneous_curvature(i);
  membrane.tension_law = all.membrane.tension_law;
  membrane.tension_form = all.membrane.tension_form;
  if (all.time.markers == MarkerMotion::strain_relaxation) membrane.strain_relaxation = all.time.relaxation;
  membrane.integral_tension = {all.membrane.integral_rate, all.membrane.integral_degrees};
  membrane.area = all.membrane.area;
  membrane.area_stiffness = all.membrane.area_stiffness;
  membrane.laplacian.form = all.membrane.laplacian;
  membrane.laplacian.upsampling = all.membrane.upsampling;
  // Eq. (14) goes with the truncation that the paper gives it.
  membrane.laplacian.truncated = all.membrane.laplacian == vesicle::LaplacianForm::paper;
  membrane.volume = all.membrane.volume;
  membrane.volume_stiffness = all.membrane.volume_stiffness;
  membrane.filter = all.mesh.filter;
  membrane.slip = all.mesh.slip;
  membrane.normal_degrees = all.mesh.normal_degrees;
  membrane.tangential_degrees = all.mesh.tangential_degrees;
  return membrane;
}

vesicle::Membrane make_membrane(const SimulationParameters& parameters, std::size_t i,
                                const vesicle::MembraneState* start) {
  const int latitudes = parameters.latitudes(i);
  vesicle::Membrane membrane(start != nullptr ? start->positions : initial_markers(parameters.vesicles[i], latitudes),
                             latitudes, membrane_parameters(parameters, i));
  if (start != nullptr) {
    membrane.restore(*start);
    membrane.keep_target_area();
  }
  return membrane;
}

}  // namespace

int moving_degrees(const SimulationParameters& parameters, std::size_t i) {
  const int degrees = parameters.mesh.normal_degrees;
  return degrees > 0 ? degrees : vesicle::two_thirds_degrees(parameters.latitudes(i));
}

ImmersedVesicle::ImmersedVesicle(const SimulationParameters& parameters, const Flow& flow, std::size_t number,
                                 const fluid::Grid& grid, const vesicle::MembraneState* start)
    : membrane(make_membrane(parameters, number, start)),
      transfer(grid, parameters.coupling.kernel, mirrors_crossed(grid, membrane.positions())),
      symmetry(parameters, membrane.positions()),
      motion(make_membrane_motion(parameters, flow, number, membrane)) {
  if (parameters.coupling.method == CouplingMethod::sharp) {
    const double radius = std::sqrt(membrane.initial_area() / (4.0 * std::numbers::pi));
    const int degrees = std::min(parameters.latitudes(number), sharp_degrees(radius, parameters.spacing()));
    sharp.emplace(
        grid, membrane.surface().grid(),
        SharpTransfer::Parameters{.degrees = degrees,
                                  .more_reach = parameters.has_phase_inertia() ? PhaseInertia::more_reach : 0.0,
                                  .across = mirrors_crossed(grid, membrane.positions())});
    const double ratio = parameters.viscosity_ratio(number);
    if (ratio != 1.0) two_phase.emplace(ratio, membrane.positions().rows());
  }
  if (parameters.coupling.thickness_correction)
    thickness_.emplace(membrane, parameters.coupling.kernel, parameters.spacing(),
                       0.5 * (1.0 + parameters.viscosity_ratio(number)));
  const Eigen::Index markers = membrane.positions().rows();
  velocities = {vesicle::VectorField::Zero(markers, 3), vesicle::VectorField::Zero(markers, 3)};
}

void ImmersedVesicle::FlowAtMarkers::operator()(const Positions& positions, vesicle::VectorField& velocity) const {
  (*this)(1.0, positions, velocity);
}

void ImmersedVesicle::FlowAtMarkers::operator()(double fraction, const Positions& positions,
                                                vesicle::VectorField& velocity) const {
  if (vesicle_.sharp) {
    const PhaseTimer timer(vesicle_.moving.interpolate);
    if (vesicle_.two_phase)
      velocity = vesicle_.two_phase->value();
    else
      vesicle_.read_sharp(*vesicle_.velocity_, velocity);
    return;
  }
  {
    const PhaseTimer timer(vesicle_.moving.interpolate);
    vesicle_.transfer.update(positions);
    vesicle_.transfer.interpolate(*vesicle_.velocity_, velocity);
    if (fraction != 1.0) {
      vesicle::VectorField& at_start = vesicle_.at_start_;
      at_start.resize(velocity.rows(), 3);
      vesicle_.transfer.interpolate(*vesicle_.previous_velocity_, at_start);
      velocity = fraction * velocity + (1.0 - fraction) * at_start;
    }
  }
  if (!vesicle_.thickness_) return;
  const PhaseTimer timer(vesicle_.moving.thickness_correction);
  vesicle_.thickness_->add_to(vesicle_.membrane, vesicle_.force(), velocity);
}

void ImmersedVesicle::update() {
  if (is_current) return;
  membrane.update_geometry();
  membrane.compute_force();
  is_current = true;
}

void ImmersedVesicle::predict(double dt) {
  if (motion->predict(dt, membrane)) is_current = false;
  update();
}

// Two phases with inertia are differenced within half a spacing of where the membrane will be after the steps that they are
// kept for. Twice as far as it moves at the present speed is allowed for, and what least_reach leaves.
double ImmersedVesicle::more_reach(double dt) const {
  if (!two_phase) return 0.0;
  constexpr double of_differences = 1.5, steps = BodyPhases::times - 1;
  const double speed = (two_phase->value() * membrane.surface().normal()).rowwise().sum().abs().maxCoeff();
  const double moved = steps * dt * speed / sharp->grid().min_spacing();
  return std::max(0.0, of_differences + 2.0 * moved - SharpTransfer::least_reach);
}

void ImmersedVesicle::meet_grid(double dt, bool has_neighbours) {
  transfer.update(membrane.positions());
  if (!sharp) return;
  all_force_ = force();
  if (const vesicle::VectorField* owed = motion->owed_force()) all_force_ += *owed;
  sharp->update(membrane.surface(), has_neighbours, more_reach(dt));
}

void ImmersedVesicle::read_sharp(const fluid::FaceVector& velocity, vesicle::VectorField& at_markers) const {
  sharp->interpolate(velocity, at_markers);
  for (int axis = 0; axis < 3; ++axis) at_markers.col(axis) += mean_flow[static_cast<std::size_t>(axis)];
}

double ImmersedVesicle::improve_interface(const fluid::FaceVector& velocity) {
  mean_velocity_.resize(membrane.positions().rows(), 3);
  read_sharp(velocity, mean_velocity_);
  const double change = two_phase->improve(membrane.surface(), mean_velocity_);
  // The fluid answers to the symmetric part alone: of the other one, changes of rigid motions would grow from pass to pass.
  two_phase->project([this](vesicle::VectorField& of_interface) { symmetry.apply(of_interface); });
  return change;
}

void ImmersedVesicle::clear(fluid::NavierStokes& fluid) {
  transfer.clear(fluid.force());
  if (sharp) sharp->clear(fluid.force(), fluid.divergence_source());
}

void ImmersedVesicle::put_force(fluid::NavierStokes& fluid, bool correction) {
  if (sharp) {
    if (correction)
      if (const vesicle::VectorField* more = motion->correcting_force()) all_force_ += *more;
    sharp->set_force(all_force_, two_phase ? &two_phase->jump() : nullptr);
    sharp->add_to(fluid.force(), fluid.divergence_source(), transfer);
    return;
  }
  transfer.spread(force(), membrane.surface().area_weight(), fluid.force());
  if (const vesicle::VectorField* owed = motion->owed_force())
    transfer.spread(*owed, membrane.surface().area_weight(), fluid.force());
}

void ImmersedVesicle::advance(double dt, const fluid::FaceVector& previous_velocity,
                              const fluid::FaceVector& velocity) {
  moving = {};
  const PhaseTimer timer(moving.mesh);
  previous_velocity_ = &previous_velocity;
  velocity_ = &velocity;
  motion->advance(dt, FlowAtMarkers(*this), membrane, velocities);
  is_current = false;
}

void ImmersedVesicle::restore_history(double dt, std::span<const double> history) {
  if (!std::ranges::all_of(history, [](double value) { return std::isfinite(value); }))
    throw std::invalid_argument("the history of the markers has a value that is not finite");
  if (history.empty())
    motion->restart();
  else
    motion->restore_history(dt, history);
}

void ImmersedVesicle::carry_interface_velocity(const vesicle::MeshRedistribution& redistribution) {
  if (!two_phase) return;
  const auto carried = [&](vesicle::VectorField velocity) {
    for (int axis = 0; axis < 3; ++axis) {
      vesicle::ScalarField component = velocity.col(axis);
      if (component.size() > 0) redistribution.carry(component);
      velocity.col(axis) = component;
    }
    return velocity;
  };
  two_phase->set(carried(two_phase->value()), carried(two_phase->previous()));
}

void ImmersedVesicle::restore_interface_velocity(const vesicle::VectorField& velocity,
                                                 const vesicle::VectorField& previous) {
  const Eigen::Index expected = two_phase ? membrane.positions().rows() : 0;
  const bool fits = velocity.rows() == expected && (previous.rows() == expected || previous.rows() == 0);
  if (!(fits && velocity.isFinite().all() && previous.isFinite().all()))
    throw std::invalid_argument(fmt::format(
        "the velocity of the interface has {} markers, expected {}, and must be finite", velocity.rows(), expected));
  if (two_phase) two_phase->set(velocity, previous);
}

void ImmersedVesicle::meet_start(double dt, const fluid::FaceVector& velocity) {
  if (!sharp) return interpolate(dt, velocity);
  update();
  transfer.update(membrane.positions());
  transfer.interpolate(velocity, velocities.fluid);
  if (two_phase) two_phase->set(velocities.fluid);
  motion->mesh_velocity(dt, membrane, velocities);
}

void ImmersedVesicle::interpolate(double dt, const fluid::FaceVector& velocity) {
  if (sharp) {
    update();
    meet_grid(dt);
    sharp->set_force(all_force_, two_phase ? &two_phase->jump() : nullptr);
    if (two_phase)
      velocities.fluid = two_phase->value();
    else
      read_sharp(velocity, velocities.fluid);
    motion->mesh_velocity(dt, membrane, velocities);
    return;
  }
  transfer.update(membrane.positions());
  transfer.interpolate(velocity, velocities.fluid);
  if (thickness_) {
    update();
    thickness_->add_to(membrane, force(), velocities.fluid);
  }
  motion->mesh_velocity(dt, membrane, velocities);
}

}  // namespace vesiflow::coupling
