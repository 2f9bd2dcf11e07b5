// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "coupling/flow.h"
#include "coupling/simulation.h"

namespace vesiflow::coupling::test {

/// Rate -d(ln a)/dt at which the mode a Y_n^m of a nearly spherical, inextensible vesicle of radius 1 without mean tension
/// relaxes in an unbounded fluid, for kappa = 1/(4 Ca) and viscosity ratio lambda (Seifert, Eur. Phys. J. B 8 (1999) 405; the
/// same numbers as independent reference data for n = 2 to 6):
///   Gamma_n = kappa (n-1) n^2 (n+1)^2 (n+2) / [lambda (2n^3 + 3n^2 - 5) + 2n^3 + 3n^2 + 4].
inline double relaxation_rate(int degree, double ratio, double capillary_number) {
  const double n = degree, resistance = ratio * (2 * n * n * n + 3 * n * n - 5) + 2 * n * n * n + 3 * n * n + 4;
  return (n - 1) * n * n * (n + 1) * (n + 1) * (n + 2) / (4 * capillary_number * resistance);
}

/// A sphere perturbed by Y_2^0, Y_3^0 and Y_4^0 in fluid at rest, without inertia, in a box [-half, half]^3: the amplitudes
/// are so small that the tension which keeps the excess area, of order sigma0 a^2, is nothing beside the bending force, and
/// that the modes do not see each other (with 1e-3 the rate of the first is 1.5 % lower).
inline SimulationParameters shape_modes(double half, int cells, int latitudes, double ratio) {
  constexpr double amplitude = 1e-4;
  SimulationParameters parameters;
  parameters.domain = {{-half, -half, -half}, {half, half, half}, {cells, cells, cells}};
  parameters.fluid.inertia = fluid::Inertia::none;
  parameters.fluid.viscosity_ratio = ratio;
  parameters.membrane.sigma0 =
      100.0;  // transients die as exp(-63 t) or faster; the rate is 2e-4 lower than with infinite sigma0
  parameters.mesh.latitudes = latitudes;
  parameters.time.markers = MarkerMotion::euler;
  parameters.time.step = 1.0 / 96.0;
  VesicleParameters vesicle;
  vesicle.shape = Shape::harmonics;
  vesicle.harmonics = {{2, 0, amplitude}, {3, 0, amplitude}, {4, 0, amplitude}};
  parameters.vesicles = {vesicle};
  return parameters;
}

/// The same, of which the quarter x > 0, y > 0 of the box is computed: the modes are symmetric about the z axis.
inline SimulationParameters quarter_of(SimulationParameters parameters) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    parameters.domain.lower[axis] = 0.0;
    parameters.domain.cells[axis] /= 2;
    parameters.domain.mirror[axis] = true;
  }
  return parameters;
}

using Amplitudes = std::array<double, 3>;  ///< of Y_2^0, Y_3^0 and Y_4^0

/// Rate with a concentric spherical wall of radius 3 or 6 over the rate without, at viscosity ratios 1 and 5: independent
/// reference data. The walls of a cube at this distance slow a little less.
inline std::optional<Amplitudes> wall_factors(double radius, double ratio) {
  if (radius == 3.0 && ratio == 1.0) return {{0.8246210444701843, 0.9669931697942172, 0.9944881422321079}};
  if (radius == 6.0 && ratio == 1.0) return {{0.9756371526021804, 0.9988283209391576, 0.9999503870885454}};
  if (radius == 3.0 && ratio == 5.0) return {{0.9262917317610593, 0.9883197853129777, 0.998123927461152}};
  if (radius == 6.0 && ratio == 5.0) return {{0.9907435106453186, 0.9995940108855167, 0.9999831742000889}};
  return std::nullopt;
}

/// From the radius about the origin.
inline Amplitudes amplitudes_of(const vesicle::Surface& surface) {
  const auto& x = surface.positions();
  const auto& n = surface.normal();
  Amplitudes a{};
  for (Eigen::Index m = 0; m < x.rows(); ++m) {
    const double r = std::sqrt(x(m, 0) * x(m, 0) + x(m, 1) * x(m, 1) + x(m, 2) * x(m, 2)), c = x(m, 2) / r;
    const double across = (x(m, 0) * n(m, 0) + x(m, 1) * n(m, 1) + x(m, 2) * n(m, 2)) / r;
    const double solid_angle = surface.area_weight()(m) * across / (r * r);
    for (unsigned degree = 2; degree <= 4; ++degree)
      a[degree - 2] += (r - 1.0) * std::sph_legendre(degree, 0, std::acos(c)) * solid_angle;
  }
  return a;
}

/// Rates at which the amplitudes decrease, from two steps once the transients of the tension are over. Markers move by Euler
/// steps, for which (a_k - a_{k+1})/(dt a_k) is the rate itself.
inline Amplitudes measured_rates(const SimulationParameters& parameters) {
  Flow flow = flow_at_rest();
  flow.start = FlowStart::rest;
  Simulation simulation(parameters, flow);
  const long settling = std::lround(14.0 / 96.0 / parameters.time.step);
  for (int i = 0; i < settling; ++i) simulation.step();
  const Amplitudes before = amplitudes_of(simulation.membrane(0).surface());
  simulation.step();
  const Amplitudes after = amplitudes_of(simulation.membrane(0).surface());
  Amplitudes rates{};
  for (std::size_t i = 0; i < rates.size(); ++i) rates[i] = (before[i] - after[i]) / (before[i] * parameters.time.step);
  return rates;
}

}  // namespace vesiflow::coupling::test
