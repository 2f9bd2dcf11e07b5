// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/start_from.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fluid/resampling.h"
#include "run/checkpoint.h"
#include "run/errors.h"
#include "vesicle/resampling.h"
#include "vesicle/sphere_grid.h"

namespace vesiflow::run {
namespace {

std::filesystem::path checkpoint_of(const std::filesystem::path& run) {
  if (!std::filesystem::is_directory(run)) {
    if (std::filesystem::exists(run)) return run;
    throw SceneError(
        fmt::format("--start-from {}: there is no such folder or file; it takes the folder of a run, or its "
                    "checkpoint.h5",
                    run.string()));
  }
  const std::filesystem::path file = run / "checkpoint.h5";
  if (std::filesystem::exists(file)) return file;
  throw SceneError(fmt::format(
      "--start-from {}: the folder has no checkpoint.h5: it is not that of a run, or of one that wrote none "
      "(output.checkpoint_every = 0)",
      run.string()));
}

void require_fit(const Scene& run, const Scene& scene, const std::filesystem::path& file) {
  if (run.vesicles.size() != scene.vesicles.size())
    throw SceneError(
        fmt::format("--start-from {}: the run has {} vesicles, this scene has {}: give the scene one [[vesicles]] for "
                    "each",
                    file.string(), run.vesicles.size(), scene.vesicles.size()));
  for (int axis = 0; axis < 3; ++axis) {
    const bool mirror = run.domain.mirror[axis];
    if (mirror != scene.domain.mirror[axis] || (mirror && run.domain.lower[axis] != scene.domain.lower[axis]))
      throw SceneError(
          fmt::format("--start-from {}: domain.mirror and domain.lower of axis {}: a plane of symmetry must be the "
                      "same in the run and in this scene",
                      file.string(), "xyz"[axis]));
  }
}

// The radius of the scene is the unit of its tolerances, and what its warnings and the search for a blow-up go by.
void require_size(const vesicle::MembraneState& membrane, std::size_t i, const Scene& scene,
                  const std::filesystem::path& file) {
  constexpr double tolerance = 0.01;
  const double radius = std::cbrt(0.75 * membrane.initial_volume / std::numbers::pi), given = scene.vesicles[i].radius;
  if (std::abs(radius - given) <= tolerance * radius) return;
  throw SceneError(
      fmt::format("--start-from {}: vesicles.{}.radius = {:g}: the vesicle of the run has the effective radius "
                  "{:.4g}, and tolerances go by this key: allowed is what is within 1 % of it\n"
                  "  set vesicles.{}.radius = {:.4g}, --set vesicles.{}.radius={:.4g}",
                  file.string(), i, given, radius, i, radius, i, radius));
}

// Strains by a factor; the areas that they are against then follow, with the membrane as it is.
void scale_strains(vesicle::MembraneState& membrane, int latitudes, double factor) {
  vesicle::Surface surface(latitudes);
  surface.update(membrane.positions);
  membrane.target_areas = surface.area_weight() * (membrane.target_areas / surface.area_weight()).pow(factor);
  membrane.lagged_strain *= factor;
  membrane.integral_tension *= factor;
}

// With the fields that the simulation's membrane has, which depend on its parameters.
void complete(vesicle::MembraneState& membrane, const vesicle::MembraneState& pattern, int latitudes) {
  if (pattern.lagged_strain.size() == 0) {
    membrane.lagged_strain.resize(0);
  } else if (membrane.lagged_strain.size() == 0) {  // relaxed until now
    vesicle::Surface surface(latitudes);
    surface.update(membrane.positions);
    membrane.lagged_strain = (surface.area_weight() / membrane.target_areas).log();
  }
  if (pattern.integral_tension.size() == 0)
    membrane.integral_tension.resize(0);
  else if (membrane.integral_tension.size() == 0)
    membrane.integral_tension = vesicle::ScalarField::Zero(pattern.integral_tension.size());
}

vesicle::MembraneState membrane_of(const CheckpointContents& run, const Scene& scene, std::size_t i,
                                   const vesicle::MembraneState& pattern) {
  const int latitudes = scene.latitudes(i);
  vesicle::MembraneState membrane = vesicle::resample(
      run.state.vesicles[i].membrane, vesicle::SphereGrid(run.scene.latitudes(i)), vesicle::SphereGrid(latitudes));
  const double before = run.scene.sigma0(i), now = scene.sigma0(i);
  if (before != now && before > 0.0 && now > 0.0) scale_strains(membrane, latitudes, before / now);
  complete(membrane, pattern, latitudes);
  return membrane;
}

void require_inside(const vesicle::VectorField& markers, std::size_t i, const Scene& scene,
                    const std::filesystem::path& file) {
  for (int axis = 0; axis < 3; ++axis) {
    if (scene.domain.periodic[axis]) continue;
    const double lowest = markers.col(axis).minCoeff(), highest = markers.col(axis).maxCoeff();
    const bool above = lowest > scene.domain.lower[axis] || scene.domain.mirror[axis];
    if (above && highest < scene.domain.upper[axis]) continue;
    throw SceneError(fmt::format(
        "--start-from {}: vesicle {} reaches from {:.4g} to {:.4g} along {}, this box from {:g} to {:g}: "
        "make the box larger",
        file.string(), i, lowest, highest, "xyz"[axis], scene.domain.lower[axis], scene.domain.upper[axis]));
  }
}

}  // namespace

void start_from(const std::filesystem::path& run, SceneSimulation& simulation) {
  const std::filesystem::path file = checkpoint_of(run);
  const CheckpointContents contents = read_checkpoint(file);
  const Scene& scene = simulation.scene();
  require_fit(contents.scene, scene, file);

  coupling::SimulationState pattern = simulation.state();
  auto start = std::make_shared<coupling::Start>();
  start->run = std::filesystem::absolute(file).lexically_normal().string();
  start->time = contents.state.clock.time;
  start->steps = contents.state.clock.steps;
  fluid::resample(coupling::fluid_velocity_of(contents.scene, contents.state), pattern.velocity);
  fluid::resample(contents.state.pressure, pattern.pressure);
  try {
    for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
      start->membranes.push_back(membrane_of(contents, scene, i, pattern.vesicles[i].membrane));
      require_inside(start->membranes[i].positions, i, scene, file);
      require_size(start->membranes[i], i, scene, file);
    }
    simulation.start(start, pattern.velocity, pattern.pressure);
  } catch (const std::logic_error& error) {  // a membrane without a geometry on the new mesh
    throw SceneError(fmt::format("--start-from {}: {}", file.string(), error.what()));
  } catch (const coupling::SimulationStopped& error) {  // a marker too near to a wall
    throw SceneError(fmt::format("--start-from {}: {}", file.string(), error.what()));
  }
}

}  // namespace vesiflow::run
