// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/overlap.h"
#include "coupling/validity.h"
#include "plan/recommended_region.h"

namespace vesiflow::run {
namespace {

namespace validity = coupling::validity;
using validity::settling_steps;

constexpr std::array<double, RunQuality::quantities> limits{
    validity::warned_area_error,         validity::warned_volume_error,  validity::warned_local_area_error,
    validity::warned_surface_divergence, validity::warned_spectrum_tail, validity::warned_unresolved_bending,
    validity::warned_velocity_noise,     validity::warned_courant_number};

constexpr std::array<const char*, RunQuality::quantities> names{
    "the relative error of an area",
    "the relative error of a volume",
    "the largest local area error",
    "the largest surface divergence of the membrane's velocity",
    "the spectrum's tail",
    "the share of the bending force that the mesh does not resolve",
    "the share of noise in a membrane's velocity",
    "the Courant number of the membrane"};

// What to do, of what the scene does not do already.
std::string advice(RunQuality::Quantity quantity, const Scene& scene) {
  const bool projects = scene.membrane.volume == vesicle::VolumeControl::projection;
  switch (quantity) {
    case RunQuality::area:
      return scene.follows_shape()
                 ? "shapes near a sphere cannot keep it, others do: take more mesh.latitudes or a smaller time.step"
                 : "take time.markers = \"shape_following\", which keeps areas, or a larger membrane.sigma0";
    case RunQuality::volume:
      return fmt::format("take {}a smaller time.step", projects ? "" : "membrane.volume = \"projection\", or ");
    case RunQuality::local_area:
      return "the membrane is not inextensible: take a larger membrane.sigma0, or more mesh.latitudes";
    case RunQuality::surface_divergence:
      return scene.coupling.method == coupling::CouplingMethod::sharp
                 ? "the tension carries noise, or degrees that the grid does not resolve: take a smaller time.step or "
                   "more domain.cells"
                 : "the tension is too soft or carries noise: take a smaller time.step";
    case RunQuality::velocity_noise:
      return "results are averages over noise: take a smaller time.step";
    case RunQuality::spectrum_tail:
      return "take more mesh.latitudes";
    case RunQuality::unresolved_bending:
      return "take more mesh.latitudes (needed_latitudes says how many)";
    case RunQuality::courant_number:
    case RunQuality::quantities:
      break;
  }
  return "more than has been tried: compare with half the time.step";
}

std::string where(const RunQuality::Excess& excess) {
  if (excess.vesicles.size() < 2) return "";
  const auto count = std::ranges::count(excess.vesicles, true);
  if (count == 1) return fmt::format(", in vesicle {}", excess.worst_vesicle);
  return fmt::format(", in {} of {} vesicles, most in vesicle {}", count, excess.vesicles.size(), excess.worst_vesicle);
}

std::string when(const RunQuality::Excess& excess, long last_step) {
  if (excess.last_step >= last_step)
    return excess.first_step == excess.last_step ? fmt::format("at t = {:.3g}", excess.first_time)
                                                 : fmt::format("from t = {:.3g} on", excess.first_time);
  if (excess.last_step == 0) return "at the start only";
  if (excess.last_step <= settling_steps)
    return fmt::format("in the first {} steps only, until t = {:.3g}", excess.last_step, excess.last_time);
  if (excess.first_step == excess.last_step) return fmt::format("at t = {:.3g} only", excess.first_time);
  return fmt::format("from t = {:.3g} to {:.3g}, below since then", excess.first_time, excess.last_time);
}

}  // namespace

RunQuality::RunQuality(const Scene& scene) : scene_(scene) {
  for (Excess& excess : errors_.excesses) excess.vesicles.assign(scene.vesicles.size(), false);
}

void RunQuality::raise(Quantity quantity, std::size_t vesicle, double value, const SceneSimulation& simulation) {
  double& greatest = errors_.greatest[quantity];
  Excess& excess = errors_.excesses[quantity];
  if (!(std::abs(value) <= greatest)) {
    greatest = std::abs(value);
    excess.worst_vesicle = vesicle;
  }
  if (std::abs(value) <= limits[quantity]) return;
  if (excess.first_step < 0) {
    excess.first_step = simulation.steps();
    excess.first_time = simulation.time();
  }
  excess.last_step = simulation.steps();
  excess.last_time = simulation.time();
  excess.vesicles[vesicle] = true;
}

void RunQuality::observe_step(const SceneSimulation& simulation) {
  if (++steps_ <= settling_steps) return;
  for (std::size_t i = 0; i < simulation.vesicle_count(); ++i) {
    const double speed = simulation.membrane_speed(i);
    raise(velocity_noise, i, speed > 0.0 ? simulation.velocity_noise(i) / speed : 0.0, simulation);
    raise(courant_number, i, speed * simulation.time_step() / scene_.spacing(), simulation);
  }
}

void RunQuality::observe(SceneSimulation& simulation, std::span<const vesicle::Diagnostics> all,
                         std::span<const double> distances) {
  errors_.last_step = simulation.steps();
  if (const double div = simulation.max_divergence(); !(div <= errors_.divergence)) errors_.divergence = div;
  const fluid::Grid& grid = simulation.fluid().grid();
  for (std::size_t i = 0; i < all.size(); ++i) {
    errors_.membrane_gap = std::min(errors_.membrane_gap, distances[i] / scene_.spacing());
    errors_.wall_gap = std::min(
        errors_.wall_gap, coupling::distance_to_walls(grid, simulation.membrane(i).positions()) / scene_.spacing());
    const vesicle::Diagnostics& d = all[i];
    raise(area, i, d.area_error, simulation);
    raise(volume, i, d.volume_error, simulation);
    raise(spectrum_tail, i, d.spectrum_tail, simulation);
    if (std::isfinite(d.resolution.unresolved)) raise(unresolved_bending, i, d.resolution.unresolved, simulation);
    if (scene_.sigma0(i) == 0.0) continue;
    raise(local_area, i, d.max_local_area_error, simulation);
    if (simulation.steps() > settling_steps) raise(surface_divergence, i, d.surface_divergence_max, simulation);
  }
}

RunQuality::SceneNumbers RunQuality::scene_numbers() const {
  double smallest_radius = scene_.vesicles.front().radius;
  for (const auto& vesicle : scene_.vesicles) smallest_radius = std::min(smallest_radius, vesicle.radius);
  const double longest = scene_.time.adaptive ? scene_.time.largest_step : scene_.time.step;
  std::optional<double> grid_error;
  if (scene_.coupling.method == coupling::CouplingMethod::delta)
    grid_error =
        (scene_.coupling.thickness_correction ? validity::corrected_error_per_spacing : validity::error_per_spacing) *
        scene_.spacing() / smallest_radius;
  return {.tension_number = scene_.tension_number(),
          .stable_tension_number = scene_.stable_tension_number(),
          .convection_step_ratio = longest / stable_convection_step(scene_),
          .grid_error = grid_error};
}

std::vector<std::string> RunQuality::warnings() const {
  std::vector<std::string> all;
  for (int i = 0; i < quantities; ++i) {
    const auto quantity = static_cast<Quantity>(i);
    const Excess& excess = errors_.excesses[quantity];
    if (excess.first_step < 0) continue;
    const bool settled = excess.last_step <= settling_steps && excess.last_step < errors_.last_step;
    all.push_back(
        fmt::format("{} is {:.3g}, above {:g}{}, {}: {}", names[quantity], errors_.greatest[quantity], limits[quantity],
                    where(excess), when(excess, errors_.last_step),
                    settled ? "it is of the start, and what comes later does not have it" : advice(quantity, scene_)));
  }
  const auto warn_above = [&](double value, double limit, const char* what, const char* advice) {
    if (!(value <= limit)) all.push_back(fmt::format("{} is {:.3g}, above {:g}: {}", what, value, limit, advice));
  };
  const Errors& e = errors_;
  const SceneNumbers numbers = scene_numbers();
  warn_above(e.divergence, validity::warned_divergence, "the divergence of the fluid's velocity",
             "it should be round-off: please report it, with the scene");
  warn_above(numbers.tension_number, numbers.stable_tension_number, "g = time.step membrane.sigma0/(4 h)",
             "the explicit tension is beyond its stability: take a smaller time.step");
  warn_above(numbers.convection_step_ratio, 1.0, "time.step over the one at which the explicit convection is stable",
             "take a smaller time.step");
  warn_above(coupling::vesicle_reynolds_number(scene_), validity::largest_reynolds_number,
             "fluid.reynolds_number times the square of the largest radius",
             "more than has been compared with anything");
  const auto warn_below = [&](double gap, const char* what) {
    if (gap < validity::least_resolved_gap)
      all.push_back(
          fmt::format("a membrane came within {:.2g} spacings of {}, below {:g}: the fluid in between is not resolved, "
                      "take more domain.cells",
                      gap, what, validity::least_resolved_gap));
  };
  warn_below(e.membrane_gap, "another");
  warn_below(e.wall_gap, "a wall");
  return all;
}

}  // namespace vesiflow::run
