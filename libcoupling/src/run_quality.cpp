#include "run_quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/flow.h"
#include "coupling/overlap.h"

namespace vesiflow::coupling {
namespace {

constexpr long settling_steps = 10;  // of a start, in which velocities jump

// Relative error of inclination and frequency in tank-treading per spacing over radius, at ratio 1: 3.5 % at 0.1875, and 0.3 % with the
// correction (validation/thickening.md).
constexpr double error_per_spacing = 0.19, corrected_error_per_spacing = 0.016;

// What the studies cover.
constexpr double largest_area_error = 1e-2, largest_volume_error = 1e-3, largest_local_area_error = 5e-2,
                 largest_surface_divergence = 0.1, largest_spectrum_tail = 1e-4, largest_unresolved_bending = 0.05,
                 largest_velocity_noise = 0.05, largest_courant_number = 2.0, largest_reynolds_number = 10.0,
                 largest_divergence = 1e-8;

void raise(double& greatest, double value) {
  if (!(std::abs(value) <= greatest)) greatest = std::abs(value);
}

}  // namespace

RunQuality::RunQuality(const Scene& scene) : scene_(scene) {}

void RunQuality::observe_step(const Simulation& simulation) {
  if (++steps_ <= settling_steps) return;
  for (std::size_t i = 0; i < simulation.vesicle_count(); ++i) {
    const double speed = simulation.membrane_speed(i);
    raise(errors_.velocity_noise, speed > 0.0 ? simulation.velocity_noise(i) / speed : 0.0);
    raise(errors_.courant_number, speed * simulation.time_step() / scene_.spacing());
  }
}

void RunQuality::observe(Simulation& simulation, std::span<const vesicle::Diagnostics> all,
                         std::span<const double> distances) {
  raise(errors_.divergence, simulation.max_divergence());
  const fluid::Grid& grid = simulation.fluid().grid();
  for (std::size_t i = 0; i < all.size(); ++i) {
    errors_.membrane_gap = std::min(errors_.membrane_gap, distances[i] / scene_.spacing());
    errors_.wall_gap =
        std::min(errors_.wall_gap, wall_distance(grid, simulation.membrane(i).positions()) / scene_.spacing());
    const vesicle::Diagnostics& d = all[i];
    raise(errors_.area, d.area_error);
    raise(errors_.volume, d.volume_error);
    raise(errors_.spectrum_tail, d.spectrum_tail);
    if (std::isfinite(d.resolution.unresolved)) raise(errors_.unresolved_bending, d.resolution.unresolved);
    if (scene_.sigma0(i) == 0.0) continue;
    raise(errors_.local_area, d.max_local_area_error);
    if (simulation.steps() > settling_steps) raise(errors_.surface_divergence, d.surface_divergence_max);
  }
}

RunQuality::SceneNumbers RunQuality::scene_numbers() const {
  double smallest_radius = scene_.vesicles.front().radius;
  for (const auto& vesicle : scene_.vesicles) smallest_radius = std::min(smallest_radius, vesicle.radius);
  const double longest = scene_.time.adaptive ? scene_.time.largest_step : scene_.time.step;
  return {.tension_number = scene_.tension_number(),
          .stable_tension_number = scene_.stable_tension_number(),
          .convection_step_ratio = longest / stable_convection_step(scene_),
          .grid_error = (scene_.coupling.thickness_correction ? corrected_error_per_spacing : error_per_spacing) *
                        scene_.spacing() / smallest_radius};
}

std::vector<std::string> RunQuality::warnings() const {
  std::vector<std::string> all;
  const auto warn_above = [&](double value, double limit, const char* what, const char* advice) {
    if (!(value <= limit)) all.push_back(fmt::format("{} is {:.3g}, above {:g}: {}", what, value, limit, advice));
  };
  const Errors& e = errors_;
  const SceneNumbers numbers = scene_numbers();
  warn_above(e.area, largest_area_error, "the relative error of an area",
             "take time.markers = \"shape_following\", which keeps areas, or a larger membrane.sigma0");
  warn_above(e.volume, largest_volume_error, "the relative error of a volume",
             "take membrane.volume = \"projection\", or a smaller time.step");
  warn_above(e.local_area, largest_local_area_error, "the largest local area error",
             "the membrane is not inextensible: take a larger membrane.sigma0, or more mesh.latitudes");
  warn_above(e.surface_divergence, largest_surface_divergence,
             "the largest surface divergence of the membrane's velocity",
             "the tension is too soft or carries noise: take a smaller time.step, or another membrane.sigma0");
  warn_above(e.velocity_noise, largest_velocity_noise, "the share of noise in a membrane's velocity",
             "results are averages over noise: take a smaller time.step");
  warn_above(e.spectrum_tail, largest_spectrum_tail, "the spectrum's tail", "take more mesh.latitudes");
  warn_above(e.unresolved_bending, largest_unresolved_bending,
             "the share of the bending force that the mesh does not resolve",
             "take more mesh.latitudes (needed_latitudes says how many)");
  warn_above(e.courant_number, largest_courant_number, "the Courant number of the membrane",
             "more than has been tried: compare with half the time.step");
  warn_above(e.divergence, largest_divergence, "the divergence of the fluid's velocity",
             "it should be round-off: please report it, with the scene");
  warn_above(numbers.tension_number, numbers.stable_tension_number, "g = time.step membrane.sigma0/(4 h)",
             "the explicit tension is beyond its stability: take a smaller time.step");
  warn_above(numbers.convection_step_ratio, 1.0, "time.step over the one at which the explicit convection is stable",
             "take a smaller time.step");
  warn_above(scene_.fluid.inertia == fluid::Inertia::none ? 0.0 : scene_.fluid.reynolds_number, largest_reynolds_number,
             "fluid.reynolds_number", "more than has been compared with anything");
  const auto warn_below = [&](double gap, const char* what) {
    if (gap < least_resolved_gap)
      all.push_back(
          fmt::format("a membrane came within {:.2g} spacings of {}, below {:g}: the fluid in between is not resolved, "
                      "take more domain.cells",
                      gap, what, least_resolved_gap));
  };
  warn_below(e.membrane_gap, "another");
  warn_below(e.wall_gap, "a wall");
  return all;
}

}  // namespace vesiflow::coupling
