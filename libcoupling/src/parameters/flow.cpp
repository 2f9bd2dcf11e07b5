// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fluid/duct_series.h"

namespace vesiflow::coupling {
namespace {

constexpr std::array<bool, 3> along_all{true, true, true}, along_x_and_y{true, true, false},
    along_x{true, false, false};
constexpr std::array<bool, 3> about_all{true, true, true}, about_y{false, true, false},
    about_y_and_z{false, true, true};

using Domain = SimulationParameters::Domain;

struct Centre {
  double middle, half;
};
Centre centre_of(const Domain& domain, std::size_t axis) {
  const double low = domain.lower[axis], high = domain.upper[axis];
  if (domain.mirror[axis]) return {low, high - low};
  return {0.5 * (low + high), 0.5 * (high - low)};
}

// Distance of the box's farthest point from the origin along an axis.
double reach(const Domain& domain, std::size_t axis) {
  return std::max(std::abs(domain.lower[axis]), std::abs(domain.upper[axis]));
}

// The series costs a microsecond or more. Grids are walked along x, on which it does not depend: one value is remembered.
class DuctVelocity {
 public:
  DuctVelocity(double peak, const Centre& y, const Centre& z)
      : series_(y.half, z.half), peak_(peak), y_(y), z_(z), last_y_(y.middle), last_z_(z.middle), last_(peak) {}
  fluid::Vector3 operator()(const fluid::Vector3& x, double) {
    if (x[1] != last_y_ || x[2] != last_z_) {
      last_y_ = x[1];
      last_z_ = x[2];
      last_ = peak_ * series_.velocity(x[1] - y_.middle, x[2] - z_.middle);
    }
    return {last_, 0.0, 0.0};
  }

 private:
  fluid::DuctSeries series_;
  double peak_;
  Centre y_, z_;
  double last_y_, last_z_, last_;
};

}  // namespace

Flow flow_at_rest() {
  return {.velocity = [](const fluid::Vector3&, double) { return fluid::Vector3{}; },
          .may_be_periodic = along_all,
          .may_be_mirrored = about_all,
          .greatest_speed = 0.0,
          .description = "none: the walls are at rest"};
}

Flow shear_flow(double rate, const Domain& domain) {
  return {.velocity =
              [rate](const fluid::Vector3& x, double) {
                return fluid::Vector3{rate * x[2], 0.0, 0.0};
              },
          .may_be_periodic = along_x_and_y,
          .may_be_mirrored = about_y,
          .greatest_gradient = std::abs(rate),
          .greatest_speed = std::abs(rate) * reach(domain, 2),
          .description = "steady shear, evaluated once"};
}

Flow oscillating_shear_flow(double rate, double omega, const Domain& domain) {
  return {.velocity =
              [rate, omega](const fluid::Vector3& x, double t) {
                return fluid::Vector3{rate * std::cos(omega * t) * x[2], 0.0, 0.0};
              },
          .motion = fluid::WallMotion::unsteady,
          .may_be_periodic = along_x_and_y,
          .may_be_mirrored = about_y,
          .greatest_gradient = std::abs(rate),
          .greatest_speed = std::abs(rate) * reach(domain, 2),
          .angular_frequency = omega,
          .description = fmt::format("shear oscillating with angular frequency {:g}", omega)};
}

Flow extension_flow(double rate, Extension kind, const Domain& domain) {
  const bool planar = kind == Extension::planar;
  const fluid::Vector3 rates = planar ? fluid::Vector3{rate, 0.0, -rate} : fluid::Vector3{rate, -rate / 2, -rate / 2};
  const fluid::Vector3& lower = domain.lower;
  return {.velocity =
              [rates](const fluid::Vector3& x, double) {
                return fluid::Vector3{rates[0] * x[0], rates[1] * x[1], rates[2] * x[2]};
              },
          .may_be_mirrored = {lower[0] == 0.0, lower[1] == 0.0, lower[2] == 0.0},
          .greatest_gradient = std::abs(rate),
          .greatest_speed =
              std::abs(rate) * (planar ? std::max(reach(domain, 0), reach(domain, 2))
                                       : std::max({reach(domain, 0), reach(domain, 1) / 2, reach(domain, 2) / 2})),
          .description = fmt::format("steady {} extension, evaluated once", planar ? "planar" : "uniaxial")};
}

Flow plane_poiseuille_flow(double peak, const Domain& domain) {
  const Centre z = centre_of(domain, 2);
  return {.velocity =
              [peak, z](const fluid::Vector3& x, double) {
                const double s = (x[2] - z.middle) / z.half;
                return fluid::Vector3{peak * (1.0 - s * s), 0.0, 0.0};
              },
          .may_be_periodic = along_x_and_y,
          .may_be_mirrored = about_y_and_z,
          .driving_force = 2.0 * peak / (z.half * z.half),
          .greatest_gradient = 2.0 * std::abs(peak) / z.half,
          .greatest_speed = std::abs(peak),
          .description = "steady plane Poiseuille, evaluated once"};
}

Flow duct_flow(double peak, const Domain& domain) {
  const Centre y = centre_of(domain, 1), z = centre_of(domain, 2);
  const fluid::DuctSeries series(y.half, z.half);
  // Steepest in the middle of a wall.
  constexpr double near = 1e-3;
  const double slope = std::max(series.velocity(y.half * (1.0 - near), 0.0) / (near * y.half),
                                series.velocity(0.0, z.half * (1.0 - near)) / (near * z.half));
  return {.velocity = DuctVelocity(peak, y, z),
          .may_be_periodic = along_x,
          .may_be_mirrored = about_y_and_z,
          .driving_force = peak * series.pressure_gradient(),
          .greatest_gradient = std::abs(peak) * slope,
          .greatest_speed = std::abs(peak),
          .description = "steady duct flow, evaluated once"};
}

Flow custom_flow(const fluid::BoundaryVelocity& velocity, fluid::WallMotion motion) {
  return {
      .velocity = velocity,
      .motion = motion,
      .may_be_periodic = along_all,
      .may_be_mirrored = about_all,
      .description = motion == fluid::WallMotion::steady ? "custom, evaluated once" : "custom, evaluated in each step"};
}

}  // namespace vesiflow::coupling
