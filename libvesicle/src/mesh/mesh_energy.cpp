// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/mesh_energy.h"

#include <algorithm>
#include <cmath>

#include "check.h"
#include "harmonics/check_grid.h"
#include "vesicle/scale_degrees.h"

namespace vesiflow::vesicle {

double mesh_energy_weight(int degree) {
  const double n = degree;
  return (n - 1.0) * n * (n + 1.0) * (n + 2.0);
}

double mesh_energy(const Coefficients& positions) {
  double sum = 0;
  for (int n = 2; n < positions.degrees(); ++n) sum += mesh_energy_weight(n) * positions.energy(n, n + 1);
  return sum / 2;
}

MeshEnergyDescent::MeshEnergyDescent(const Metric& metric) : metric_(metric) {
  check_argument(std::isfinite(metric.damping) && metric.damping >= 0, "damping", metric.damping, "finite and >= 0");
  check_argument(metric.damping > 0 || metric.lowest_degree >= 2, "lowest_degree", metric.lowest_degree,
                 ">= 2 without damping");
}

template <class Factor>
void MeshEnergyDescent::scale(const SphericalHarmonics& transform, const Surface& surface, const VectorField& field,
                              const Factor& factor, VectorField& result) {
  check_grid(transform.grid(), "transform", surface.grid());
  check_markers(field, "field", surface.grid().size());
  result.resize(surface.grid().size(), 3);
  transform.analysis(field, coefficients_);
  scale_degrees(coefficients_, factor);
  transform.synthesis(coefficients_, result);
}

void MeshEnergyDescent::make_tangential(const Surface& surface, VectorField& field) {
  const VectorField& n = surface.normal();
  normal_part_ = (field * n).rowwise().sum();
  for (int component = 0; component < 3; ++component) field.col(component) -= normal_part_ * n.col(component);
}

void MeshEnergyDescent::force(const SphericalHarmonics& transform, const Surface& surface, VectorField& result) {
  scale(
      transform, surface, surface.positions(), [](int n) { return -mesh_energy_weight(n); }, result);
  make_tangential(surface, result);
}

void MeshEnergyDescent::apply_second_derivative(const SphericalHarmonics& transform, const Surface& surface,
                                                const VectorField& field, VectorField& result) {
  scale(transform, surface, field, mesh_energy_weight, result);
  result += metric_.damping * field;
  make_tangential(surface, result);
}

void MeshEnergyDescent::precondition(const SphericalHarmonics& transform, const Surface& surface,
                                     const VectorField& field, VectorField& result) {
  const auto inverse = [this](int n) {
    return 1 / (mesh_energy_weight(std::max(metric_.lowest_degree, n)) + metric_.damping);
  };
  scale(transform, surface, field, inverse, result);
  make_tangential(surface, result);
}

void MeshEnergyDescent::direction(const SphericalHarmonics& transform, const Surface& surface, VectorField& result) {
  force(transform, surface, result);
  precondition(transform, surface, result, result);
}

}  // namespace vesiflow::vesicle
