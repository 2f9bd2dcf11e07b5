// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The velocity of the fluid where its solver has another one: sharp membranes between two viscosities.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "coupling/marker_transfer.h"
#include "coupling/simulation.h"
#include "step/immersed_vesicle.h"
#include "transfer/fine_surface.h"
#include "transfer/grid_band.h"
#include "vesicle/surface.h"
#include "viscosity/physical_velocity.h"

namespace vesiflow::coupling {
namespace {

void require_state_of(const SimulationParameters& parameters, const SimulationState& state) {
  if (state.vesicles.size() != parameters.vesicles.size())
    throw std::invalid_argument(
        fmt::format("the state has {} vesicles, the parameters {}", state.vesicles.size(), parameters.vesicles.size()));
  for (std::size_t i = 0; i < state.vesicles.size(); ++i) {
    if (parameters.viscosity_ratio(i) == 1.0) continue;
    const Eigen::Index latitudes = parameters.latitudes(i), markers = 2 * latitudes * latitudes;
    const VesicleState& vesicle = state.vesicles[i];
    if (vesicle.membrane.positions.rows() != markers || vesicle.interface_velocity.rows() != markers)
      throw std::invalid_argument(
          fmt::format("the state has {} markers and {} velocities of the membrane of vesicle {}, expected {}",
                      vesicle.membrane.positions.rows(), vesicle.interface_velocity.rows(), i, markers));
  }
}

/// The membrane of a vesicle of a state, and its points of the grid.
class Interface {
 public:
  Interface(const fluid::Grid& grid, const VesicleState& state, int latitudes, double ratio)
      : surface_(latitudes), fine_(0), ratio_(ratio) {
    surface_.update(state.membrane.positions);
    // A mesh that bands find the points next to it from.
    fine_.update(surface_, 0.9 * grid.min_spacing());
  }

  void divide(PhysicalVelocity& velocity, const fluid::Grid& grid) const {
    for (int component = 0; component < 3; ++component) {
      GridBand band(grid, fluid::face_centrings[static_cast<std::size_t>(component)],
                    mirrors_crossed(grid, surface_.positions()));
      band.update(fine_, 1.5 * std::max({grid.spacing(0), grid.spacing(1), grid.spacing(2)}));
      velocity.divide_inside(component, band, ratio_);
    }
  }

 private:
  vesicle::Surface surface_;
  FineSurface fine_;
  double ratio_;
};

}  // namespace

const fluid::FaceVector& Simulation::fluid_velocity() const {
  if (!physical_velocity_ || fluid_.steps() == 0) return fluid_.velocity();
  physical_velocity_->set(fluid_.velocity(), mean_flow_);
  for (const auto& v : vesicles_)
    for (int component = 0; v->two_phase && component < 3; ++component)
      physical_velocity_->divide_inside(component, v->sharp->band(component), v->two_phase->ratio());
  return physical_velocity_->value();
}

fluid::FaceVector fluid_velocity_of(const SimulationParameters& parameters, const SimulationState& state) {
  if (!parameters.has_scaled_velocity() || state.clock.steps == 0) return state.velocity.clone();
  require_state_of(parameters, state);
  const fluid::Grid grid = grid_of(parameters);
  std::vector<Interface> interfaces;
  for (std::size_t i = 0; i < state.vesicles.size(); ++i)
    if (const double ratio = parameters.viscosity_ratio(i); ratio != 1.0)
      interfaces.emplace_back(grid, state.vesicles[i], parameters.latitudes(i), ratio);
  PhysicalVelocity velocity(grid);
  velocity.set(state.velocity, state.mean_flow);
  for (const Interface& interface : interfaces) interface.divide(velocity, grid);
  return std::move(velocity).take();
}

}  // namespace vesiflow::coupling
