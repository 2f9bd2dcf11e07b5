// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_check.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "scene/accuracy.h"
#include "scene/scene_keys.h"
#include "scene/scene_mistakes.h"

namespace vesiflow::run {
namespace {

using coupling::ParameterError;

void check_tension_number(const Scene& scene) {
  if (!scene.g) return;
  const double meant = *scene.g * 4.0 * scene.finest_spacing() / scene.time.step;
  if (!std::isfinite(meant))
    throw ParameterError(fmt::format("membrane.g = {:g}: too large: sigma0 = 4 g h/time.step overflows", *scene.g));
  if (std::abs(meant - scene.membrane.sigma0) > 5e-3 * meant)
    throw ParameterError(
        fmt::format("membrane.g = {:g} and membrane.sigma0 = {:g} disagree: at this time step and spacing "
                    "g means sigma0 = {:g}; give one of them",
                    *scene.g, scene.membrane.sigma0, meant));
}

void check_ending(const Scene& scene) {
  if (scene.ending.on_blowup == OnBlowUp::stop) return;
  if (scene.time.adaptive)
    throw ParameterError(
        "limits.on_blowup = \"reduce_step\": is for equal steps; time.adaptive = true shortens its steps by itself");
  if (scene.output.checkpoint_every == 0.0)
    throw ParameterError(
        "limits.on_blowup = \"reduce_step\": goes back to a checkpoint, so output.checkpoint_every must be > 0");
}

void check_surface_file(const Scene& scene, std::size_t i) {
  const coupling::VesicleParameters& vesicle = scene.vesicles[i];
  const SurfaceFile& file = scene.surface_file(i);
  const std::string key = fmt::format("vesicles.{}", i);
  const bool from_file = vesicle.shape == coupling::Shape::coefficients || vesicle.shape == coupling::Shape::mesh;
  if (from_file != (file.file || vesicle.surface))
    throw ParameterError(
        fmt::format("{}: file = \"...\" goes with shape = \"coefficients\" or \"mesh\", and only with it", key));
  if (vesicle.shape != coupling::Shape::mesh && file.fit_degrees)
    throw ParameterError(fmt::format("{}: fit_degrees goes with shape = \"mesh\" only", key));
  if (from_file && !vesicle.surface)
    throw ParameterError(
        fmt::format("{}.file = \"{}\": has not been read; a program that fills a scene itself sets "
                    "VesicleParameters::surface",
                    key, *file.file));
  if (file.fit_degrees && *file.fit_degrees >= scene.latitudes(i))
    throw ParameterError(fmt::format("{}.fit_degrees = {}: must be below {} = {}", key, *file.fit_degrees,
                                     vesicle.latitudes ? key + ".latitudes" : "mesh.latitudes", scene.latitudes(i)));
}

}  // namespace

coupling::Mistakes mistakes_of_scene_keys(const Scene& scene) {
  coupling::Mistakes mistakes;
  check_ranges_of_scene(scene, mistakes);
  for (const auto check : {check_accuracy, check_tension_number, check_ending}) mistakes.gather([&] { check(scene); });
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) mistakes.gather([&] { check_surface_file(scene, i); });
  return mistakes;
}

void add_by_key(const ParameterError& found, const Scene& scene, coupling::Mistakes& mistakes) {
  for (std::string mistake : found.mistakes()) {
    bool is_said = false;
    for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
      const std::string key = fmt::format("vesicles.{}", i), surface = key + ".surface:";
      is_said |= mistake.starts_with(key + ": a surface");  // by check_surface_file, of the file that it comes from
      if (scene.surface_file(i).file && mistake.starts_with(surface))
        mistake.replace(0, surface.size(), key + ".file:");
    }
    if (!is_said) mistakes.add(std::move(mistake));
  }
}

void check_scene(const Scene& scene, const coupling::Flow& flow, const std::string& name) {
  coupling::Mistakes mistakes = mistakes_of_scene_keys(scene);
  try {
    coupling::check(scene, flow);
  } catch (const ParameterError& error) {
    add_by_key(error, scene, mistakes);
  }
  refuse_scene(mistakes, name);
}

coupling::Flow flow_to_check(const Scene& scene) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = scene.domain.upper[axis] - scene.domain.lower[axis];
    if (!(length > 0.0 && std::isfinite(length))) return coupling::flow_at_rest();
  }
  return flow_of(scene);
}

// A flow of a program's own is not known here, and may do anything.
void check_scene(const Scene& scene, const std::string& name) {
  check_scene(scene, scene.flow.type == FlowType::custom ? coupling::flow_at_rest() : flow_to_check(scene), name);
}

}  // namespace vesiflow::run
