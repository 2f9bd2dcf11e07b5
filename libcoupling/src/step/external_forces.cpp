// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "step/external_forces.h"

#include <algorithm>

#include "coupling/buoyancy.h"

namespace vesiflow::coupling {

ExternalForces::ExternalForces(const SimulationParameters& parameters, const fluid::Grid& grid,
                               std::span<const std::unique_ptr<ImmersedVesicle>> vesicles,
                               std::span<const MembraneForce> own)
    : vesicles_(vesicles), own_(own) {
  const vesicle::Vector3 gravity(parameters.gravity.acceleration.data());
  for (const VesicleParameters& vesicle : parameters.vesicles) weights_.push_back(vesicle.density_difference * gravity);
  if (std::ranges::all_of(weights_, [](const vesicle::Vector3& weight) { return weight.isZero(0.0); }))
    weights_.clear();

  const auto& periodic = parameters.domain.periodic;
  const auto& mirror = parameters.domain.mirror;
  const bool has_images = periodic[0] || periodic[1] || periodic[2] || mirror[0] || mirror[1] || mirror[2];
  const bool can_meet = vesicles_.size() > 1 || has_images || parameters.repulsion.walls;
  if (parameters.repulsion.range > 0.0 && can_meet) {
    Eigen::Index largest = 0;
    for (const auto& v : vesicles_) largest = std::max(largest, v->membrane.positions().rows());
    repulsion_.emplace(
        grid,
        RepulsionParameters{parameters.repulsion.range, parameters.repulsion.strength, parameters.repulsion.walls},
        largest);
  }
  if (weights_.empty() && !repulsion_ && own_.empty()) return;
  for (const auto& v : vesicles_) {
    v->total_force.emplace(vesicle::VectorField::Zero(v->membrane.positions().rows(), 3));
    repelled_.push_back({&v->membrane.positions(), &v->membrane.surface().area_weight(), &*v->total_force});
  }
}

void ExternalForces::compute(double time) {
  for (std::size_t i = 0; i < repelled_.size(); ++i) {
    ImmersedVesicle& v = *vesicles_[i];
    *v.total_force = v.membrane.force();
    if (!weights_.empty()) add_buoyancy(v.membrane.surface(), weights_[i], *v.total_force);
    for (const MembraneForce& force : own_) force(time, i, v.membrane.surface(), *v.total_force);
  }
  if (repulsion_) repulsion_->add_forces(repelled_);
}

fluid::Vector3 ExternalForces::total() const {
  fluid::Vector3 sum{};
  for (const auto& v : vesicles_) {
    const vesicle::ScalarField& weight = v->membrane.surface().area_weight();
    const vesicle::VectorField* owed = v->motion->owed_force();
    for (int axis = 0; axis < 3; ++axis) {
      sum[axis] += (v->force().col(axis) * weight).sum();
      if (owed != nullptr) sum[axis] += (owed->col(axis) * weight).sum();
    }
  }
  return sum;
}

}  // namespace vesiflow::coupling
