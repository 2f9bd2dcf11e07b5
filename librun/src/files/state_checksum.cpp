// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files/state_checksum.h"

#include <span>

#include "files/checksum.h"

namespace vesiflow::run {
namespace {

void add_array(Checksum& sum, const auto& array) {
  sum.add(std::span(array.data(), static_cast<std::size_t>(array.size())));
}

void add_velocity(Checksum& sum, const fluid::FaceVector& u) {
  add_array(sum, u.x);
  add_array(sum, u.y);
  add_array(sum, u.z);
}

void add_membrane(Checksum& sum, const vesicle::MembraneState& m) {
  add_array(sum, m.positions);
  for (const auto* field : {&m.target_areas, &m.initial_areas, &m.lagged_strain, &m.integral_tension})
    add_array(sum, *field);
}

void add_surface(Checksum& sum, const vesicle::Coefficients& surface) {
  for (int field = 0; field < 3; ++field)
    for (int n = 0; n < surface.degrees(); ++n)
      for (int m = 0; m <= n; ++m) {
        sum.add(surface(field, n, m).real());
        sum.add(surface(field, n, m).imag());
      }
}

}  // namespace

std::int64_t checksum_of(const coupling::SimulationState& state) {
  Checksum sum;
  for (const double value : {state.clock.time, state.clock.previous_time, state.clock.time_step}) sum.add(value);
  sum.add(static_cast<std::int64_t>(state.clock.steps));
  add_velocity(sum, state.velocity);
  add_velocity(sum, state.previous_velocity);
  add_array(sum, state.pressure);
  add_array(sum, state.step_control);
  for (const fluid::FaceVector& velocity : state.outer_velocities) add_velocity(sum, velocity);
  for (const coupling::VesicleState& vesicle : state.vesicles) {
    add_membrane(sum, vesicle.membrane);
    add_array(sum, vesicle.motion_history);
    sum.add(vesicle.membrane.initial_volume);
    sum.add(vesicle.redistributions);
    // Other states are summed as they were before there was such a velocity.
    if (vesicle.interface_velocity.size() > 0) add_array(sum, vesicle.interface_velocity);
    if (vesicle.previous_interface_velocity.size() > 0) add_array(sum, vesicle.previous_interface_velocity);
    for (const std::vector<double>& row : vesicle.inner_velocities) add_array(sum, row);
  }
  for (const double other : {state.mean_flow[0], state.mean_flow[1], state.mean_flow[2], state.earlier_step})
    if (other != 0.0) sum.add(other);
  if (state.start) {
    sum.add(state.start->run);
    sum.add(state.start->time);
    sum.add(state.start->steps);
    for (const vesicle::MembraneState& membrane : state.start->membranes) {
      add_membrane(sum, membrane);
      sum.add(membrane.initial_volume);
    }
  }
  return sum.value();
}

std::int64_t checksum_of(const Scene& scene, const std::string& text) {
  Checksum sum;
  sum.add(text);
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
    if (const auto& surface = scene.vesicles[i].surface) {
      sum.add(static_cast<std::int64_t>(i));
      add_surface(sum, *surface);
    }
  return sum.value();
}

}  // namespace vesiflow::run
