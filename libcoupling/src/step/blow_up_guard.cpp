// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "step/blow_up_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "coupling/flow.h"
#include "coupling/validity.h"

namespace vesiflow::coupling {
namespace {

constexpr int most_noisy_steps = 8;
constexpr double smallest_speed = 0.1;  // in radii per unit of time, below which noise is harmless
constexpr long fluid_interval = 8;
constexpr double largest_overshoot = 3.0;

struct Peak {
  double speed = 0.0;
  std::ptrdiff_t index = 0;
};

template <class Centring>
Peak peak_of(const fluid::Field<Centring>& component) {
  const double* values = component.data();
  const auto size = static_cast<std::ptrdiff_t>(component.size());
  double greatest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : greatest)
  for (std::ptrdiff_t i = 0; i < size; ++i) greatest = std::max(greatest, std::abs(values[i]));
  const auto is_peak = [greatest](double value) { return std::abs(value) == greatest; };
  return {greatest, std::find_if(values, values + size, is_peak) - values};
}

}  // namespace

BlowUpGuard::BlowUpGuard(const SimulationParameters& parameters, double wall_speed)
    : limit_(parameters.limits.velocity_noise),
      harmless_speed_(smallest_speed * largest_radius(parameters)),
      known_speed_(std::max(wall_speed, harmless_speed_)),
      too_noisy_(parameters.vesicles.size(), 0) {}

std::string BlowUpGuard::look_at(std::size_t vesicle, const VelocityNoise& noise,
                                 const vesicle::VectorField& positions) {
  known_speed_ = std::max(known_speed_, noise.greatest_speed());
  const double share = noise.value() / std::max(noise.greatest_speed(), harmless_speed_);
  int& count = too_noisy_[vesicle];
  count = share > limit_ ? count + 1 : 0;
  if (count < most_noisy_steps) return {};
  const auto x = positions.row(noise.marker());
  return fmt::format(
      "the velocity of the membrane of vesicle {} changes by {:.3g} from step to step and back, {:.2g} of its greatest "
      "speed, for {} steps "
      "on end (limits.velocity_noise = {:g}); most at marker {}, ({:.3g}, {:.3g}, {:.3g})",
      vesicle, noise.value(), share, count, limit_, noise.marker(), x[0], x[1], x[2]);
}

bool BlowUpGuard::watches_fluid(long step) const {
  return step % fluid_interval == 0 && std::isfinite(known_speed_);
}

std::string BlowUpGuard::look_at(const fluid::FaceVector& velocity, long step) {
  if (!watches_fluid(step)) return {};
  const auto beyond = [&](const auto& component, char axis) -> std::string {
    const Peak peak = peak_of(component);
    if (peak.speed <= largest_overshoot * known_speed_) return {};
    const std::ptrdiff_t row = component.stride(1), plane = component.stride(2);
    const fluid::Vector3 x =
        component.position(static_cast<int>(peak.index % row) - 1, static_cast<int>(peak.index % plane / row) - 1,
                           static_cast<int>(peak.index / plane) - 1);
    return fmt::format(
        "the fluid's velocity along {} is {:.3g} at ({:.3g}, {:.3g}, {:.3g}), where walls and membranes have had "
        "{:.3g} "
        "at most",
        axis, peak.speed, x[0], x[1], x[2], known_speed_);
  };
  for (std::string found : {beyond(velocity.x, 'x'), beyond(velocity.y, 'y'), beyond(velocity.z, 'z')})
    if (!found.empty()) return found;
  return {};
}

bool BlowUpGuard::suspects() const {
  return std::ranges::any_of(too_noisy_, [](int steps) { return steps > 0; });
}

std::string blow_up_advice(const SimulationParameters& parameters, const Flow& flow) {
  if (const double convection = stable_convection_step(parameters, flow);
      !parameters.time.adaptive && parameters.time.step > convection)
    return fmt::format("the explicit convection is unstable for time.step above about {:.3g} near the walls: reduce it",
                       convection);
  if (const double longest = stable_bending_step(parameters); parameters.time.step > longest)
    return fmt::format(
        "bending is too fast for the step: a shape far from rest relaxes at a rate of 1/Ca: take time.step <= {:.3g}{}",
        longest,
        longest > parameters.time.smallest_step && !parameters.time.adaptive ? " or time.adaptive = true"
                                                                             : "; is membrane.capillary_number meant?");
  const std::string mesh = "the mesh is too coarse for the shape (more mesh.latitudes) or the vesicle too deflated";
  const double limit = parameters.stable_tension_number();
  if (std::isfinite(limit))
    return fmt::format(
        "the explicit tension is unstable above g = dt sigma0/(4 mu h) of {:.3g}, and here g = {:.3g}: "
        "reduce time.step or membrane.sigma0; if g is well below that, {}",
        limit, parameters.tension_number(), mesh);
  if (const double quiet = quiet_tension_number(parameters); parameters.tension_number() > quiet)
    return fmt::format(
        "at this Reynolds number g = dt sigma0/(4 h) is quiet to about {:g}, and here g = {:.3g}: reduce "
        "time.step or membrane.sigma0, or take time.markers = \"implicit\"; or {}",
        quiet, parameters.tension_number(), mesh);
  return fmt::format("reduce time.step; or {}", mesh);
}

}  // namespace vesiflow::coupling
