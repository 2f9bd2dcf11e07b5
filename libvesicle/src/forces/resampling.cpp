// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/resampling.h"

#include <algorithm>

#include "check.h"
#include "vesicle/surface.h"

namespace vesiflow::vesicle {

Resampling::Resampling(const SphereGrid& from, const SphereGrid& to, int max_fields)
    : analysis_(std::min(from.latitudes(), to.latitudes()), from, max_fields),
      synthesis_(analysis_.degrees(), to, max_fields),
      coefficients_(analysis_.degrees(), max_fields) {}

void Resampling::apply(const SphericalHarmonics::Input& values, SphericalHarmonics::Output result) const {
  analysis_.analysis(values, coefficients_);
  synthesis_.synthesis(coefficients_, result);
}

MembraneState resample(const MembraneState& state, const SphereGrid& from, const SphereGrid& to) {
  check_markers(state.positions, "positions", from.size());
  check_markers(state.target_areas, "target_areas", from.size());
  check_markers(state.initial_areas, "initial_areas", from.size());
  if (state.lagged_strain.size() > 0) check_markers(state.lagged_strain, "lagged_strain", from.size());
  if (state.integral_tension.size() > 0) check_markers(state.integral_tension, "integral_tension", from.size());
  if (from == to) return state;
  const Resampling resampling(from, to);
  MembraneState result;
  result.positions.resize(to.size(), 3);
  resampling.apply(state.positions, result.positions);
  Surface before(from), after(to);
  before.update(state.positions);
  after.update(result.positions);
  const auto carry = [&](const ScalarField& field) {
    ScalarField carried(field.size() > 0 ? to.size() : 0);
    if (field.size() > 0) resampling.apply(field, carried);
    return carried;
  };
  const auto carry_areas = [&](const ScalarField& areas) {
    const ScalarField strain = carry((before.area_weight() / areas).log());
    const ScalarField carried = after.area_weight() * (-strain).exp();
    return ScalarField(carried * (areas.sum() / carried.sum()));
  };
  result.target_areas = carry_areas(state.target_areas);
  result.initial_areas = carry_areas(state.initial_areas);
  result.initial_volume = state.initial_volume;
  result.lagged_strain = carry(state.lagged_strain);
  result.integral_tension = carry(state.integral_tension);
  return result;
}

}  // namespace vesiflow::vesicle
